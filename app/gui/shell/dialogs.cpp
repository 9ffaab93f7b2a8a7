// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/dialogs.h"

#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/load_scene.h"
#include "app/session/session.h"
#include "engine/io/base/atomic_file.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/text.h"

#include <QCoreApplication>
#include <QDateTime>
#include <QDialogButtonBox>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QLineEdit>
#include <QLocale>
#include <QPushButton>
#include <QSettings>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <memory>
#include <thread>
#include <utility>

namespace episcope {
namespace {

// Keys of the settings.
constexpr const char* kOpenFolder = "last_folder";
constexpr const char* kSaveFolder = "save_folder";

constexpr std::chrono::milliseconds kAnswerTime{300};

struct DialogsText {
  Q_DECLARE_TR_FUNCTIONS(episcope::Dialogs)
};

/// Whether a folder is there and permits what `mode` asks of access(2). A network disk that is gone
/// may never answer: a thread of its own asks, so that the window does not wait for it.
bool permits(const QString& folder, int mode) {
  const auto asked = std::make_shared<std::promise<bool>>();
  std::future<bool> answer = asked->get_future();
  std::thread([asked, mode, path = folder.toStdString() + "/."] {
    asked->set_value(::access(path.c_str(), mode) == 0);
  }).detach();
  return answer.wait_for(kAnswerTime) == std::future_status::ready && answer.get();
}

/// The first folder that permits it, else home.
QString first_of(const QStringList& folders, int mode) {
  const auto found = std::ranges::find_if(folders, [mode](const QString& folder) {
    return !folder.isEmpty() && permits(folder, mode);
  });
  return found == folders.end() ? QDir::homePath() : *found;
}

QString remembered(const char* key) {
  return QSettings().value(key).toString();
}

/// Empty for built-in scenes, and without a light field.
QString folder_of_front(const Session& session) {
  const std::string& input = session.input();
  if (input.empty() || !builtin_scene_id(input).empty()) return {};
  return QFileInfo(QString::fromStdString(input)).absolutePath();
}

// Qt's dialog refuses a name of no folder.
class NewFolderDialog : public QFileDialog {
 public:
  using QFileDialog::QFileDialog;

 protected:
  void accept() override {
    const QString typed = selectedFiles().value(0);
    if (!typed.isEmpty()) QDir().mkdir(typed);
    QFileDialog::accept();
  }
};

// Qt's dialog looks into a folder whose name is typed, instead of taking it.
class FileOrFolderDialog : public QFileDialog {
 public:
  using QFileDialog::QFileDialog;

  void takeFolder(const QString& folder) {
    emit fileSelected(folder);
    emit filesSelected({folder});
    reject();
  }

 protected:
  void accept() override {
    const auto* edit = findChild<QLineEdit*>("fileNameEdit");
    const QString name = edit ? QFileInfo(edit->text()).fileName() : QString();
    const bool is_named = !name.isEmpty() && name != "." && name != "..";
    const QString folder = selectedFiles().value(0);
    if (is_named && QFileInfo(folder).isDir()) return takeFolder(folder);
    QFileDialog::accept();
  }
};

// The folder is given at once, since the dialog would else look into the one it remembers itself.
template <class Dialog>
Dialog* make_dialog(QWidget* window, const FileQuestion& question, const QString& folder) {
  auto* dialog = new Dialog(window, question.title, folder, question.filter);
  dialog->setObjectName(question.name);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  return dialog;
}

template <class Dialog = QFileDialog>
Dialog* make_open_dialog(QWidget* window, const FileQuestion& question) {
  auto* dialog =
      make_dialog<Dialog>(window, question, first_of({remembered(kOpenFolder)}, R_OK | X_OK));
  QObject::connect(dialog, &QFileDialog::fileSelected, dialog, &begin_dialogs_beside);
  return dialog;
}

template <class Dialog = QFileDialog>
Dialog* make_open_dialog(QWidget* window, const FileQuestion& question, Answer answer) {
  auto* dialog = make_open_dialog<Dialog>(window, question);
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
  QSettings().setValue(kOpenFolder, QFileInfo(path).absolutePath());
}

void ask_for_file(QWidget* window, const FileQuestion& question, Answer answer) {
  QFileDialog* dialog = make_open_dialog(window, question, std::move(answer));
  dialog->setFileMode(QFileDialog::ExistingFile);
  dialog->open();
}

namespace {

FileOrFolderDialog* make_file_or_folder_dialog(QWidget* window, const FileQuestion& question) {
  auto* dialog = make_open_dialog<FileOrFolderDialog>(window, question);
  dialog->setOption(QFileDialog::DontUseNativeDialog);  // those take either files or folders
  dialog->setFileMode(QFileDialog::ExistingFile);
  auto* buttons = dialog->findChild<QDialogButtonBox*>();
  QPushButton* button =
      buttons->addButton(DialogsText::tr("Open this folder"), QDialogButtonBox::ActionRole);
  button->setObjectName(question.name + ".folder");
  button->setAutoDefault(false);
  QObject::connect(button, &QPushButton::clicked, dialog, [dialog] {
    const QString marked = dialog->selectedFiles().value(0);
    dialog->takeFolder(QFileInfo(marked).isDir() ? marked : dialog->directory().absolutePath());
  });
  return dialog;
}

}  // namespace

void ask_for_file_or_folder(QWidget* window, const FileQuestion& question, Answer answer) {
  FileOrFolderDialog* dialog = make_file_or_folder_dialog(window, question);
  QObject::connect(dialog, &QFileDialog::fileSelected, window, std::move(answer));
  dialog->open();
}

void ask_for_files_or_folder(QWidget* window, const FileQuestion& question,
                             std::function<void(const QStringList&)> answer) {
  FileOrFolderDialog* dialog = make_file_or_folder_dialog(window, question);
  QObject::connect(dialog, &QFileDialog::filesSelected, window, std::move(answer));
  dialog->setFileMode(QFileDialog::ExistingFiles);
  dialog->open();
}

void ask_for_files(QWidget* window, const FileQuestion& question,
                   std::function<void(const QStringList&)> answer) {
  QFileDialog* dialog = make_open_dialog(window, question);
  QObject::connect(dialog, &QFileDialog::filesSelected, window, std::move(answer));
  dialog->setFileMode(QFileDialog::ExistingFiles);
  dialog->open();
}

void ask_for_folder(QWidget* window, const FileQuestion& question, Answer answer) {
  QFileDialog* dialog = question.makes_folder
                            ? make_open_dialog<NewFolderDialog>(window, question, std::move(answer))
                            : make_open_dialog(window, question, std::move(answer));
  dialog->setFileMode(QFileDialog::Directory);
  dialog->setOption(QFileDialog::ShowDirsOnly);
  dialog->open();
}

void ask_where_to_save(const Workbench& bench, const FileQuestion& question, Answer answer) {
  const QFileInfo proposal(question.proposal);
  const QString proposed = proposal.isAbsolute() ? proposal.absolutePath() : QString();
  auto* dialog = make_dialog<QFileDialog>(
      &bench.window, question,
      first_of({proposed, folder_of_front(bench.session), remembered(kSaveFolder)}, W_OK | X_OK));
  QObject::connect(dialog, &QFileDialog::fileSelected, dialog, [](const QString& path) {
    QSettings().setValue(kSaveFolder, QFileInfo(path).absolutePath());
  });
  QObject::connect(dialog, &QFileDialog::fileSelected, &bench.window, std::move(answer));
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setOption(QFileDialog::DontConfirmOverwrite, !question.confirms_overwrite);
  dialog->setDefaultSuffix(proposal.suffix());
  dialog->selectFile(proposal.fileName());
  QObject::connect(dialog, &QFileDialog::filterSelected, dialog,
                   [dialog](const QString& chosen) { follow_filter(dialog, chosen); });
  dialog->open();
}

QString named_after_front(const Workbench& bench, const QString& name) {
  const LightFieldPtr light_field = bench.session.light_field();
  return light_field ? QString::fromStdString(light_field->info().name) + '_' + name : name;
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

void ask_where_to_save_text(const Workbench& bench, const FileQuestion& question,
                            const QString& text, const std::function<void()>& written) {
  ask_where_to_save(bench, question, [bench, text, written](const QString& path) {
    write_in_background(
        bench.jobs, bench.messages, path,
        [path, text](const Progress&) { io::write_atomically(path_of(path), text.toStdString()); },
        written);
  });
}

namespace {

constexpr int kMostNames = 5;

struct QuestionBoxText {
  Q_DECLARE_TR_FUNCTIONS(episcope::QuestionBox)
};

// Asks whether to do what cannot be undone.
void confirm(QWidget* window, BoxQuestion question, QMessageBox::StandardButton yes,
             std::function<void()> go_on, std::function<void()> otherwise) {
  question.icon = QMessageBox::Warning;
  question.buttons = yes | QMessageBox::Cancel;
  auto* box = new_question_box(window, question);
  box->setDefaultButton(QMessageBox::Cancel);
  QObject::connect(box, &QDialog::finished, box,
                   [=, go_on = std::move(go_on), otherwise = std::move(otherwise)](int answer) {
                     answer == yes ? go_on() : otherwise();
                   });
  box->open();
}

}  // namespace

QMessageBox* new_question_box(QWidget* window, const BoxQuestion& question) {
  auto* box =
      named(question.name, new QMessageBox(question.icon, question.title, breakable(question.text),
                                           question.buttons, window));
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
  confirm_replacing(
      window, QuestionBoxText::tr("The folder already holds %1. Replace it?").arg(listed(existing)),
      std::move(go_on));
}

void confirm_replacing(QWidget* window, const QString& text, std::function<void()> go_on) {
  confirm(window,
          {.name = "replace_files", .title = QuestionBoxText::tr("Replace files"), .text = text},
          QMessageBox::Yes, std::move(go_on), [] {});
}

void confirm_discarding(QWidget* window, const QString& text, std::function<void()> discard,
                        std::function<void()> keep) {
  confirm(
      window,
      {.name = "discard_work", .title = QuestionBoxText::tr("Discard earlier work"), .text = text},
      QMessageBox::Discard, std::move(discard), std::move(keep));
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

QString short_text(std::filesystem::file_time_type time) {
  const auto since_1970 = std::chrono::file_clock::to_sys(time).time_since_epoch();
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(since_1970);
  return QLocale().toString(QDateTime::fromMSecsSinceEpoch(ms.count()), QLocale::ShortFormat);
}

}  // namespace episcope
