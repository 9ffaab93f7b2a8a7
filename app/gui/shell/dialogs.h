// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QMessageBox>
#include <QString>
#include <QStringList>

#include <filesystem>
#include <functional>

class QWidget;

namespace episcope {

class Jobs;
class Messages;
class Progress;
struct Workbench;

/// Question of a file dialog. One that opens begins in the folder used last, else at home. Dialogs
/// do not block: they call `answer` with the chosen path, or never.
struct FileQuestion {
  QString name;  ///< Object name of the dialog.
  QString title;
  QString filter{};  ///< As in QFileDialog.
  QString
      proposal{};  ///< When saving: the path or name to begin with, whose suffix is the default.
  bool confirms_overwrite = true;
  bool makes_folder = false;  ///< Of ask_for_folder: a name that is typed becomes a new folder.
};
using Answer = std::function<void(const QString& path)>;

/// Converts the path of a dialog.
[[nodiscard]] std::filesystem::path path_of(const QString& path);

/// Lets the next dialogs begin beside a file or folder.
void begin_dialogs_beside(const QString& path);

void ask_for_file(QWidget* window, const FileQuestion& question, Answer answer);
/// Asks for a file, or for the folder that is marked or typed, else shown, which has a button.
void ask_for_file_or_folder(QWidget* window, const FileQuestion& question, Answer answer);
/// Asks for one or more files.
void ask_for_files(QWidget* window, const FileQuestion& question,
                   std::function<void(const QStringList& paths)> answer);
/// Likewise, or for a folder as ask_for_file_or_folder.
void ask_for_files_or_folder(QWidget* window, const FileQuestion& question,
                             std::function<void(const QStringList& paths)> answer);
void ask_for_folder(QWidget* window, const FileQuestion& question, Answer answer);
/// Begins in the folder of the proposal; if it is only a name, in the first of these where files
/// can be made: beside the light field in front, where a file was saved last, at home.
void ask_where_to_save(const Workbench& bench, const FileQuestion& question, Answer answer);

/// A name to propose: the name of the light field in front, then `name`: "still_life_metrics.csv".
[[nodiscard]] QString named_after_front(const Workbench& bench, const QString& name);

/// Asks whether to replace what `text` names, and calls `go_on` on Yes.
void confirm_replacing(QWidget* window, const QString& text, std::function<void()> go_on);
/// Calls `go_on` at once if there are no such files; else asks whether to replace them, and calls
/// it on Yes. For exports into folders; dialogs for files ask by themselves.
void confirm_replacing(QWidget* window, const QStringList& existing, std::function<void()> go_on);

/// Asks whether work that a crash left may be deleted, as `text` says; calls `discard` on Discard,
/// else `keep`.
void confirm_discarding(QWidget* window, const QString& text, std::function<void()> discard,
                        std::function<void()> keep);

/// Whether `path` has one of the suffixes; tells the user if not.
[[nodiscard]] bool has_suffix(const QString& path, const QStringList& suffixes, Messages& messages);

/// Writes in a job, tells the user, then calls `written`.
void write_in_background(Jobs& jobs, Messages& messages, const QString& path,
                         std::function<void(const Progress&)> write,
                         std::function<void()> written = nullptr);

/// Asks for a file, then writes UTF-8 text to it as `write_in_background` does.
void ask_where_to_save_text(const Workbench& bench, const FileQuestion& question,
                            const QString& text, const std::function<void()>& written = nullptr);

struct BoxQuestion {
  QString name;  ///< Object name of the box.
  QMessageBox::Icon icon = QMessageBox::Question;
  QString title;
  QString text;  ///< Plain; its long words, as paths and names of results, are broken.
  QMessageBox::StandardButtons buttons = QMessageBox::Cancel;
};

/// Message box over the window that deletes itself when closed. The caller completes and opens it.
[[nodiscard]] QMessageBox* new_question_box(QWidget* window, const BoxQuestion& question);

/// Names joined by commas; of many names, the first few and the number of the others.
[[nodiscard]] QString listed(const QStringList& names);

/// Answers for a file that another program has changed since it was read.
struct ChangedFileAnswers {
  std::function<void()> overwrite;
  std::function<void()> elsewhere;  ///< Save to another file.
  std::function<void()> reload;     ///< Take the content of the file; empty = not offered.
  QString of_reloading;             ///< A sentence: the effect of reloading.
};

/// Asks without blocking; calls one of the answers or none.
void ask_about_changed_file(QWidget* window, const QString& path,
                            const ChangedFileAnswers& answers);

/// Modification time as local date and time in the short form of the user's language.
[[nodiscard]] QString short_text(std::filesystem::file_time_type time);

}  // namespace episcope
