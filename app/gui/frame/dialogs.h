// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>
#include <QStringList>

#include <functional>

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

}  // namespace episcope
