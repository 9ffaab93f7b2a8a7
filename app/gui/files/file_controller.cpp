// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/files/file_controller.h"

#include "app/gui/files/builtin_dialog.h"
#include "app/gui/files/recent_inputs.h"
#include "app/gui/files/save_forms.h"
#include "app/gui/frame/commands.h"
#include "app/gui/frame/dialogs.h"
#include "app/gui/frame/messages.h"
#include "app/gui/opening/result_opener.h"
#include "app/gui/opening/scene_opener.h"
#include "app/gui/stage/stage.h"
#include "app/session/session.h"
#include "widgets/canvas/view_canvas.h"

#include <QAction>
#include <QDropEvent>
#include <QMenu>
#include <QMimeData>
#include <QUrl>

#include <algorithm>

namespace episcope {

FileController::FileController(const Workbench& bench)
    : QObject(&bench.owner), bench_(bench), recent_menu_(new QMenu(&bench.window)) {
  addOpenCommands();
  addSaveCommand();
  addLeaveCommands();
  fillRecentMenu();
  bench.window.setAcceptDrops(true);
  bench.window.installEventFilter(this);
  for (const auto what :
       {&SceneOpener::opened, &SceneOpener::isCollection, &SceneOpener::isProject}) {
    connect(&bench.opener, what, this, &FileController::remember);
  }
  connect(&bench.commands, &Commands::keysChanged, this, &FileController::showInvitation);
  bench.session.on_changed([this](Parts parts) {
    if (parts.has(Part::Scenes)) showInvitation();
  });
  showInvitation();
}

void FileController::remember(const QString& input) {
  if (is_builtin(input)) return;
  remember_recent(input);
  begin_dialogs_beside(input);
  fillRecentMenu();
}

void FileController::addOpenCommands() {
  const auto add = [this](const QString& id, const QString& text, const QString& tip,
                          const QList<QKeySequence>& keys, void (FileController::*run)()) {
    return Command{.id = id,
                   .menu = Menu::File,
                   .text = text,
                   .tip = tip,
                   .keys = keys,
                   .run = [this, run] { (this->*run)(); },
                   .section = section::kOpen};
  };
  Command open =
      add("file.open", tr("Open file…"), tr("Opens a light field, a result or a project"),
          {QKeySequence::Open}, &FileController::askForFile);
  open.icon = "open";
  open.bar = BarSection::Files;
  bench_.commands.add(std::move(open));
  Command folder =
      add("file.open_folder", tr("Open folder…"),
          tr("Opens a folder: an archive scene, a benchmark scene, an image grid, or a "
             "folder of several"),
          {tr("Ctrl+Shift+O")}, &FileController::askForFolder);
  folder.icon = "open";
  bench_.commands.add(std::move(folder));
  Command again = add("file.read_again", tr("Read again"),
                      tr("Reads what is open again, as a program that is still writing it has left "
                         "it by now"),
                      {tr("Ctrl+F5")}, &FileController::readAgain);
  again.enabled = [this] { return !bench_.opener.reopenable().isEmpty(); };
  bench_.commands.add(std::move(again));
  Command result =
      add("file.open_result", tr("Open result…"), tr("Adds a result from a file to the list"),
          {tr("Ctrl+R")}, &FileController::askForResult);
  result.enabled = [this] { return bench_.session.scene() != nullptr; };
  bench_.commands.add(std::move(result));
  bench_.commands.add({.id = "file.recent",
                       .menu = Menu::File,
                       .text = tr("Open recent"),
                       .tip = tr("Reopens a recent light field"),
                       .section = section::kOpen,
                       .enabled = [this] { return !recent_menu_->isEmpty(); },
                       .submenu = recent_menu_});
  bench_.commands.add({.id = "file.demo",
                       .menu = Menu::File,
                       .text = tr("Open demo"),
                       .tip = tr("Opens the built-in demo scene"),
                       .run = [this] { bench_.opener.open("demo"); },
                       .section = section::kOpen});
  bench_.commands.add(add("file.builtin", tr("Built-in scenes…"),
                          tr("Opens one of the built-in scenes, or a random one of a seed"), {},
                          &FileController::askForBuiltin));
}

void FileController::addSaveCommand() {
  bench_.commands.add(
      {.id = "file.save_as",
       .menu = Menu::File,
       .text = tr("Save light field as"),
       .tip = tr("Writes the light field, its truth and its labels in another form"),
       .section = section::kExport,
       .enabled = [this] { return bench_.session.scene() != nullptr; },
       .submenu = make_save_menu(bench_)});
}

void FileController::addLeaveCommands() {
  bench_.commands.add({.id = "file.close",
                       .menu = Menu::File,
                       .text = tr("Close"),
                       .tip = tr("Closes the light field"),
                       .keys = {tr("Ctrl+W")},
                       .run = [this] { bench_.opener.close(); },
                       .section = section::kLeave,
                       .enabled = [this] { return bench_.session.scene() != nullptr; }});
  bench_.commands.add({.id = "file.quit",
                       .menu = Menu::File,
                       .text = tr("Quit"),
                       .tip = tr("Quits Episcope"),
                       .keys = {tr("Ctrl+Q")},
                       .run = [this] { bench_.window.close(); },
                       .section = section::kLeave});
}

void FileController::askForFile() {
  ask_for_file(&bench_.window,
               {.name = "open_file",
                .title = tr("Open a light field"),
                .filter = tr("Light fields, results and projects (*.h5 *.hdf5 *.pfm *.tif *.tiff "
                             "*.episcope);;All files (*)")},
               [this](const QString& path) { openAny(path); });
}

void FileController::askForFolder() {
  ask_for_folder(&bench_.window,
                 {.name = "open_folder", .title = tr("Open the folder of a light field")},
                 [this](const QString& path) { bench_.opener.open(path); });
}

void FileController::readAgain() {
  bench_.opener.reopen();
}

void FileController::askForResult() {
  ask_for_file(&bench_.window,
               {.name = "open_result",
                .title = tr("Open a result"),
                .filter = tr("Results (*.h5 *.hdf5 *.pfm *.tif *.tiff);;All files (*)")},
               [this](const QString& path) {
                 bench_.session.scene() ? bench_.results.open(path) : bench_.opener.open(path);
               });
}

void FileController::askForBuiltin() {
  auto* dialog = new BuiltinDialog(&bench_.window);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &QDialog::accepted, this,
          [this, dialog] { bench_.opener.open(dialog->input()); });
  dialog->open();
}

void FileController::openAny(const QString& path) {
  if (bench_.session.scene() && is_result(path)) {
    bench_.results.open(path);
  } else {
    bench_.opener.open(path);  // says what is wrong with a result that nothing is open for
  }
}

// One after the other, for each takes the place of what is still being opened; results last, as
// they belong to a light field.
void FileController::openAll(QStringList paths, const QStringList& failures) {
  std::stable_partition(paths.begin(), paths.end(),
                        [](const QString& path) { return !is_result(path); });
  if (paths.isEmpty()) {
    if (!failures.isEmpty()) bench_.messages.fail(failures.join('\n'));
    return;
  }
  const QString path = paths.takeFirst();
  if (bench_.session.scene() && is_result(path)) {
    openAny(path);
    openAll(paths, failures);
  } else {
    const auto go_on = [this, paths, failures](const QString& failure) {
      openAll(paths, failure.isEmpty() ? failures : QStringList(failures) << failure);
    };
    bench_.opener.open(
        path, [go_on] { go_on({}); }, go_on);
  }
}

void FileController::fillRecentMenu() {
  recent_menu_->clear();
  for (const QString& input : recent_inputs()) {
    recent_menu_->addAction(input, this, [this, input] { bench_.opener.open(input); });
  }
  if (!recent_menu_->isEmpty()) {
    recent_menu_->addSeparator();
    recent_menu_->addAction(tr("Clear list"), this, [this] {
      forget_recent();
      fillRecentMenu();
    });
  }
  bench_.commands.refresh();
}

void FileController::showInvitation() {
  const QString key = bench_.commands.keyText("file.open");
  bench_.stage.canvas()->setEmptyHint(
      !bench_.session.scenes().empty() ? tr("Choose one in the list at the upper left.")
      : key.isEmpty()
          ? tr("Open a light field, or drop a file or a folder here.")
          : tr("Open a light field with %1, or drop a file or a folder here.").arg(key));
}

bool FileController::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::DragEnter && event->type() != QEvent::Drop) {
    return QObject::eventFilter(watched, event);
  }
  auto* drop = static_cast<QDropEvent*>(event);
  const QList<QUrl> urls = drop->mimeData()->urls();
  if (urls.isEmpty() || !urls.front().isLocalFile()) return false;
  drop->acceptProposedAction();
  if (event->type() != QEvent::Drop) return true;
  QStringList paths;
  for (const QUrl& url : urls) {
    if (url.isLocalFile()) paths << url.toLocalFile();
  }
  openAll(paths, {});
  return true;
}

}  // namespace episcope

#include "moc_file_controller.cpp"
