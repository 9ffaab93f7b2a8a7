// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/main_window.h"

#include "app/gui/document/document_controller.h"
#include "app/gui/document/label_choice.h"
#include "app/gui/features.h"
#include "app/gui/frame/cancels.h"
#include "app/gui/frame/commands.h"
#include "app/gui/frame/frame.h"
#include "app/gui/frame/job_view.h"
#include "app/gui/frame/jobs.h"
#include "app/gui/frame/keyboard_home.h"
#include "app/gui/frame/leave_guards.h"
#include "app/gui/frame/messages.h"
#include "app/gui/frame/queued_post.h"
#include "app/gui/opening/result_opener.h"
#include "app/gui/opening/scene_opener.h"
#include "app/gui/opening/scene_switcher.h"
#include "app/gui/stage/overlay.h"
#include "app/gui/stage/stage.h"
#include "app/session/session.h"
#include "widgets/canvas/view_canvas.h"

#include <QCloseEvent>
#include <QDialog>
#include <QMenuBar>
#include <QScreen>
#include <QSettings>
#include <QToolBar>

namespace episcope {
namespace {

constexpr QSize kFirstSize(1280, 800);
constexpr QSize kDecorations(4, 40);

}  // namespace

/// What features share, in order of construction. Destroyed in reverse, so that workers end before
/// the session they refer to. Widgets belong to the window; controllers of features can be found in
/// it, as children.
struct MainWindow::Core {
  explicit Core(MainWindow& window)
      : session(queued_post(&window)),
        frame(new Frame(&window)),
        messages(*frame),
        stage(new Stage(frame)),
        commands(&window, frame->viewer()),
        keyboard(window, [this] { return stage->activeCanvas(); }),
        overlay(session, *stage, nullptr),
        document(session, nullptr),
        labels(document, nullptr),
        scenes(session, jobs, messages, nullptr),
        opener(session, jobs, *stage, guards, scenes, nullptr),
        results(session, jobs, messages, nullptr),
        features(&window),
        bench{window, features, session, jobs,     messages, commands, cancels, guards,
              *frame, *stage,   overlay, document, labels,   scenes,   opener,  results} {}

  Session session;
  Cancels cancels;
  LeaveGuards guards;
  Jobs jobs;
  Frame* frame;
  Messages messages;
  Stage* stage;
  Commands commands;
  KeyboardHome keyboard;
  Overlay overlay;
  DocumentController document;
  LabelChoice labels;
  SceneSwitcher scenes;
  SceneOpener opener;
  ResultOpener results;
  QObject features;
  Workbench bench;
};

MainWindow::MainWindow(QWidget* parent)
    : QMainWindow(parent), core_(std::make_unique<Core>(*this)) {
  const Workbench& bench = core_->bench;
  setCentralWidget(&bench.frame);
  bench.frame.setStage(&bench.stage);
  show_jobs(bench.jobs, bench.frame, bench.messages);
  connect(&bench.document, &DocumentController::problem, &bench.messages, &Messages::warn);
  bench.cancels.add(CancelRank::Job, [&jobs = bench.jobs] { return jobs.cancelNewest(); });
  bench.cancels.add(CancelRank::Message, [&messages = bench.messages] {
    messages.dismiss();
    return true;
  });
  for (const Feature& feature : features()) feature.add(bench);
  addTabCommands();
  addLayoutCommands();
  connect(&bench.frame, &Frame::tabShown, &core_->keyboard, &KeyboardHome::goHomeFromControls);
  buildBars();
  bench.session.on_changed([&commands = bench.commands](Parts parts) {
    if (parts != Part::CrossHair) commands.refresh();
  });
  bench.commands.refresh();
  restoreLayout();
}

MainWindow::~MainWindow() = default;

const Workbench& MainWindow::bench() const {
  return core_->bench;
}

void MainWindow::start(const QString& input) {
  core_->opener.open(input);
  core_->frame->start();
}

void MainWindow::addTabCommands() {
  int number = 0;
  for (const Tab& tab : core_->frame->tabs()) {
    core_->commands.add({.id = "tab." + tab.id,
                         .menu = Menu::View,
                         .text = tab.command_text,
                         .tip = tab.command_tip,
                         .icon = tab.icon,
                         .keys = {tr("Ctrl+%1").arg(++number)},
                         .run = [frame = core_->frame, id = tab.id] { frame->showTab(id); },
                         .section = section::kTabs});
  }
}

void MainWindow::addLayoutCommands() {
  core_->commands.add({.id = "view.full_screen",
                       .menu = Menu::View,
                       .text = tr("Full screen"),
                       .tip = tr("Fills the screen with the window, or gives it back"),
                       .keys = {Qt::Key_F11},
                       .run =
                           [this] {
                             setWindowState(windowState() ^ Qt::WindowFullScreen);
                             core_->commands.refresh();
                           },
                       .section = section::kTabs,
                       .checked = [this] { return isFullScreen(); }});
  core_->commands.add({.id = "view.panels",
                       .menu = Menu::View,
                       .text = tr("Side panels"),
                       .tip = tr("Shows the views at the left and the tabs at the right; without "
                                 "them, the view has all the room"),
                       .keys = {tr("Shift+F11")},
                       .run =
                           [this] {
                             Frame& frame = *core_->frame;
                             frame.setPanelsShown(!frame.arePanelsShown());
                             core_->commands.refresh();
                           },
                       .section = section::kTabs,
                       .checked = [this] { return core_->frame->arePanelsShown(); }});
}

void MainWindow::buildBars() {
  core_->commands.fillMenus(*menuBar());
  auto* bar = new QToolBar(tr("Main tool bar"), this);
  bar->setObjectName("tool_bar");
  bar->setMovable(false);
  bar->setContextMenuPolicy(Qt::PreventContextMenu);
  core_->commands.fillBar(*bar);
  addToolBar(bar);
}

void MainWindow::restoreLayout() {
  const QByteArray geometry = QSettings().value("geometry").toByteArray();
  if (geometry.isEmpty() || !restoreGeometry(geometry)) {
    // The title bar, which the desktop adds, needs its room too.
    resize(kFirstSize.boundedTo(screen()->availableSize() - kDecorations));
  }
  core_->stage->canvas()->setFocus();
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (!core_->guards.may_leave(Leaving::Session)) {
    event->ignore();
    core_->guards.leave(Leaving::Session, [this] { close(); });
    return;
  }
  QSettings().setValue("geometry", saveGeometry());
  for (auto* dialog : findChildren<QDialog*>()) dialog->close();
  core_->frame->end();
  event->accept();
}

}  // namespace episcope

#include "moc_main_window.cpp"
