// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QMessageBox>
#include <QString>
#include <QStringList>

#include <filesystem>
#include <functional>

class QString;
class QWidget;

namespace episcope {

class Jobs;
class Messages;
class Progress;

/// What a file dialog asks. It begins in the folder of what was chosen or opened last. Dialogs
/// block nothing: `answer` is called with the path that was chosen, or never.
struct FileQuestion {
  QString name;  ///< Of the dialog, as an object.
  QString title;
  QString filter{};  ///< As in QFileDialog.
  QString
      proposal{};  ///< When saving: the path or name to begin with, whose suffix is the default.
  bool confirms_overwrite = true;
};
using Answer = std::function<void(const QString& path)>;

/// The path that a dialog answered.
[[nodiscard]] std::filesystem::path path_of(const QString& path);

/// The next dialogs begin beside a file or folder.
void begin_dialogs_beside(const QString& path);

void ask_for_file(QWidget* window, const FileQuestion& question, Answer answer);
/// One file or several.
void ask_for_files(QWidget* window, const FileQuestion& question,
                   std::function<void(const QStringList& paths)> answer);
void ask_for_folder(QWidget* window, const FileQuestion& question, Answer answer);
void ask_where_to_save(QWidget* window, const FileQuestion& question, Answer answer);

/// Whether `path` has one of the suffixes; if not, the user is told and nothing is written.
[[nodiscard]] bool has_suffix(const QString& path, const QStringList& suffixes, Messages& messages);

/// Writes as a job, tells the user, then calls `written`.
void write_in_background(Jobs& jobs, Messages& messages, const QString& path,
                         std::function<void(const Progress&)> write,
                         std::function<void()> written = nullptr);

struct BoxQuestion {
  QString name;  ///< Of the box, as an object.
  QMessageBox::Icon icon = QMessageBox::Question;
  QString title;
  QString text;  ///< Plain; its long words, as paths and names of results, are broken.
  QMessageBox::StandardButtons buttons = QMessageBox::Cancel;
};

/// A box over the window that deletes itself when it is closed. The caller adds what is missing and
/// opens it.
[[nodiscard]] QMessageBox* new_question_box(QWidget* window, const BoxQuestion& question);

/// The names with commas between them; of many the first few, and how many more there are.
[[nodiscard]] QString listed(const QStringList& names);

/// What to do with a file that another program wrote since it was read.
struct ChangedFileAnswers {
  std::function<void()> overwrite;
  std::function<void()> elsewhere;  ///< Save to another file.
  std::function<void()> reload;     ///< Take what is in the file; not offered if empty.
  QString of_reloading;             ///< A sentence: what reloading does to what is open.
};

/// Asks; one of the answers is called, or none. Blocks nothing.
void ask_about_changed_file(QWidget* window, const QString& path,
                            const ChangedFileAnswers& answers);

/// Writes UTF-8 text. Atomic. Throws IoError.
void write_text_file(const QString& path, const QString& text);

/// When a file was changed, as local date and time in the short form of the user's language.
[[nodiscard]] QString short_text(std::filesystem::file_time_type time);

}  // namespace episcope
