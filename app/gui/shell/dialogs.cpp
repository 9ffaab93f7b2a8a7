// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/dialogs.h"

#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "engine/core/error.h"
#include "widgets/controls/text.h"

#include <QCoreApplication>
#include <QDateTime>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QLocale>
#include <QPushButton>
#include <QSaveFile>
#include <QSettings>

#include <chrono>
#include <utility>

namespace episcope {
namespace {

constexpr const char* kLastFolder = "last_folder";  // key of the settings

struct DialogsText {
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

std::filesystem::path path_of(const QString& path) {
  return path.toStdString();
}

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
  messages.warn(DialogsText::tr("%1 was not written: its name must end in .%2.")
                    .arg(QFileInfo(path).fileName(), suffixes.join(DialogsText::tr(" or ."))));
  return false;
}

void write_in_background(Jobs& jobs, Messages& messages, const QString& path,
                         std::function<void(const Progress&)> write,
                         std::function<void()> written) {
  jobs.start<bool>(
      Lane::Export, DialogsText::tr("Writing %1").arg(QFileInfo(path).fileName()),
      [write = std::move(write)](const Progress& progress) {
        write(progress);
        return true;
      },
      [&messages, path, written = std::move(written)](bool) {
        messages.written(path);
        if (written) written();
      });
}

namespace {

constexpr int kMostNames = 5;

struct QuestionBoxText {
  Q_DECLARE_TR_FUNCTIONS(episcope::QuestionBox)
};

}  // namespace

QMessageBox* new_question_box(QWidget* window, const BoxQuestion& question) {
  auto* box = new QMessageBox(question.icon, question.title, breakable(question.text),
                              question.buttons, window);
  box->setObjectName(question.name);
  box->setTextFormat(Qt::PlainText);
  box->setAttribute(Qt::WA_DeleteOnClose);
  return box;
}

QString listed(const QStringList& names) {
  const QString separator = QStringLiteral(", ");
  // One name takes no more room than "and 1 more".
  if (names.size() <= kMostNames + 1) return names.join(separator);
  return QuestionBoxText::tr("%1 and %2 more")
      .arg(names.mid(0, kMostNames).join(separator))
      .arg(names.size() - kMostNames);
}

void confirm_replacing(QWidget* window, const QStringList& existing, std::function<void()> go_on) {
  if (existing.isEmpty()) return go_on();
  auto* box = new_question_box(
      window,
      {.name = "replace_files",
       .icon = QMessageBox::Warning,
       .title = QuestionBoxText::tr("Replace files"),
       .text =
           QuestionBoxText::tr("The folder already holds %1. Replace it?").arg(listed(existing)),
       .buttons = QMessageBox::Yes | QMessageBox::Cancel});
  box->setDefaultButton(QMessageBox::Cancel);
  QObject::connect(box->button(QMessageBox::Yes), &QAbstractButton::clicked, box, std::move(go_on));
  box->open();
}

void confirm_discarding(QWidget* window, const QString& text, std::function<void()> discard,
                        std::function<void()> keep) {
  auto* box = new_question_box(window, {.name = "discard_work",
                                        .icon = QMessageBox::Warning,
                                        .title = QuestionBoxText::tr("Discard earlier work"),
                                        .text = text,
                                        .buttons = QMessageBox::Discard | QMessageBox::Cancel});
  box->setDefaultButton(QMessageBox::Cancel);
  QObject::connect(box, &QDialog::finished, box,
                   [discard = std::move(discard), keep = std::move(keep)](int answer) {
                     answer == QMessageBox::Discard ? discard() : keep();
                   });
  box->open();
}

namespace {

struct ChangedFileText {
  Q_DECLARE_TR_FUNCTIONS(episcope::ChangedFile)
};

}  // namespace

void ask_about_changed_file(QWidget* window, const QString& path,
                            const ChangedFileAnswers& answers) {
  auto* box = new_question_box(
      window, {.name = "changed_file",
               .icon = QMessageBox::Warning,
               .title = ChangedFileText::tr("The file has changed"),
               .text = ChangedFileText::tr("Another program has written %1 since it was read or "
                                           "saved here. Saving replaces those changes.")
                           .arg(path) +
                       ' ' + answers.of_reloading});
  const auto add = [box](const char* name, const QString& text, QMessageBox::ButtonRole role,
                         const std::function<void()>& run) {
    QPushButton* button = box->addButton(text, role);
    button->setObjectName(name);
    QObject::connect(button, &QPushButton::clicked, box, run);
  };
  add("changed_file.elsewhere", ChangedFileText::tr("Save to another file…"),
      QMessageBox::AcceptRole, answers.elsewhere);
  add("changed_file.overwrite", ChangedFileText::tr("Overwrite"), QMessageBox::DestructiveRole,
      answers.overwrite);
  if (answers.reload) {
    add("changed_file.reload", ChangedFileText::tr("Reload"), QMessageBox::DestructiveRole,
        answers.reload);
  }
  box->setDefaultButton(QMessageBox::Cancel);
  box->open();
}

void write_text_file(const QString& path, const QString& text) {
  QSaveFile file(path);
  const bool is_written =
      file.open(QIODevice::WriteOnly) && file.write(text.toUtf8()) >= 0 && file.commit();
  if (!is_written) {
    throw IoError(path.toStdString(), "the file could not be written (" +
                                          file.errorString().toStdString() +
                                          "); choose another folder");
  }
}

QString short_text(std::filesystem::file_time_type time) {
  const auto since_1970 = std::chrono::file_clock::to_sys(time).time_since_epoch();
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(since_1970);
  return QLocale().toString(QDateTime::fromMSecsSinceEpoch(ms.count()), QLocale::ShortFormat);
}

}  // namespace episcope
