// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/frame/dialogs.h"

#include "app/gui/frame/jobs.h"
#include "app/gui/frame/messages.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QSettings>

#include <utility>

namespace episcope {
namespace {

constexpr const char* kLastFolder = "last_folder";  // key of the settings

struct Text {
  Q_DECLARE_TR_FUNCTIONS(episcope::Dialogs)
};

QFileDialog* make_dialog(QWidget* window, const FileQuestion& question) {
  auto* dialog = new QFileDialog(window, question.title, QString(), question.filter);
  dialog->setObjectName(question.name);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setDirectory(QSettings().value(kLastFolder, QDir::homePath()).toString());
  QObject::connect(dialog, &QFileDialog::fileSelected, dialog, &begin_dialogs_beside);
  return dialog;
}

QFileDialog* make_dialog(QWidget* window, const FileQuestion& question, Answer answer) {
  QFileDialog* dialog = make_dialog(window, question);
  QObject::connect(dialog, &QFileDialog::fileSelected, window, std::move(answer));
  return dialog;
}

// The suffix follows the form that is chosen.
void follow_filter(QFileDialog* dialog, const QString& chosen) {
  const QString suffix = chosen.section("*.", 1).section(')', 0, 0);
  const QString old_name = dialog->selectedFiles().value(0);
  dialog->setDefaultSuffix(suffix);
  dialog->selectFile(QFileInfo(old_name).completeBaseName() + '.' + suffix);
}

}  // namespace

void begin_dialogs_beside(const QString& path) {
  QSettings().setValue(kLastFolder, QFileInfo(path).absolutePath());
}

void ask_for_file(QWidget* window, const FileQuestion& question, Answer answer) {
  QFileDialog* dialog = make_dialog(window, question, std::move(answer));
  dialog->setFileMode(QFileDialog::ExistingFile);
  dialog->open();
}

void ask_for_files(QWidget* window, const FileQuestion& question,
                   std::function<void(const QStringList&)> answer) {
  QFileDialog* dialog = make_dialog(window, question);
  QObject::connect(dialog, &QFileDialog::filesSelected, window, std::move(answer));
  dialog->setFileMode(QFileDialog::ExistingFiles);
  dialog->open();
}

void ask_for_folder(QWidget* window, const FileQuestion& question, Answer answer) {
  QFileDialog* dialog = make_dialog(window, question, std::move(answer));
  dialog->setFileMode(QFileDialog::Directory);
  dialog->setOption(QFileDialog::ShowDirsOnly);
  dialog->open();
}

void ask_where_to_save(QWidget* window, const FileQuestion& question, Answer answer) {
  QFileDialog* dialog = make_dialog(window, question, std::move(answer));
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setOption(QFileDialog::DontConfirmOverwrite, !question.confirms_overwrite);
  dialog->setDefaultSuffix(QFileInfo(question.proposal).suffix());
  const QFileInfo proposal(question.proposal);
  if (proposal.isAbsolute()) dialog->setDirectory(proposal.absolutePath());
  dialog->selectFile(question.proposal);
  QObject::connect(dialog, &QFileDialog::filterSelected, dialog,
                   [dialog](const QString& chosen) { follow_filter(dialog, chosen); });
  dialog->open();
}

bool has_suffix(const QString& path, const QStringList& suffixes, Messages& messages) {
  if (suffixes.contains(QFileInfo(path).suffix(), Qt::CaseInsensitive)) return true;
  messages.warn(Text::tr("%1 was not written: its name must end in .%2.")
                    .arg(QFileInfo(path).fileName(), suffixes.join(Text::tr(" or ."))));
  return false;
}

void write_in_background(Jobs& jobs, Messages& messages, const QString& path,
                         std::function<void(const Progress&)> write,
                         std::function<void()> written) {
  jobs.start<bool>(
      Lane::Export, Text::tr("Writing %1").arg(QFileInfo(path).fileName()),
      [write = std::move(write)](const Progress& progress) {
        write(progress);
        return true;
      },
      [&messages, path, written = std::move(written)](bool) {
        messages.written(path);
        if (written) written();
      });
}

}  // namespace episcope
