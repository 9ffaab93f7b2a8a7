// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/main_window.h"

#include "app/gui/document/document_controller.h"
#include "app/gui/document/label_choice.h"
#include "app/gui/features.h"
#include "app/gui/frame/cancels.h"
#include "app/gui/frame/commands.h"
#include "app/gui/frame/frame.h"
#include "app/gui/frame/job_cancel.h"
#include "app/gui/frame/job_view.h"
#include "app/gui/frame/jobs.h"
#include "app/gui/frame/keyboard_home.h"
#include "app/gui/frame/leave_guards.h"
#include "app/gui/frame/messages.h"
#include "app/gui/frame/painting_threads.h"
#include "app/gui/frame/queued_post.h"
#include "app/gui/layout.h"
#include "app/gui/opening/result_opener.h"
#include "app/gui/opening/scene_opener.h"
#include "app/gui/opening/scene_switcher.h"
#include "app/gui/stage/overlay.h"
#include "app/gui/stage/stage.h"
#include "app/session/run/turns.h"
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
        job_cancel(session, jobs, messages, nullptr),
        stage(new Stage(frame)),
        commands(&window, frame->viewer()),
        keyboard(window, [this] { return stage->keyboardHome(); }),
        overlay(session, *stage, nullptr),
        document(session, nullptr),
        labels(document, nullptr),
        scenes(session, jobs, messages, nullptr),
        opener(session, jobs, *stage, guards, scenes, nullptr),
        results(session, jobs, messages, nullptr),
        features(&window),
        bench{window, features, session, jobs,     messages, job_cancel, commands, cancels, guards,
              *frame, *stage,   overlay, document, labels,   scenes,     opener,   results} {}

  Session session;
  Cancels cancels;
  LeaveGuards guards;
  Jobs jobs;
  Frame* frame;
  Messages messages;
  JobCancel job_cancel;
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
  ask_for_short_turns();
  keep_painting_threads();
  setCentralWidget(&bench.frame);
  bench.frame.setStage(&bench.stage);
  show_jobs(bench.jobs, bench.job_cancel, bench.frame, bench.messages);
  connect(&bench.document, &DocumentController::problem, &bench.messages, &Messages::warn);
  connect(&bench.opener, &SceneOpener::failureIsOver, &bench.messages, &Messages::retract);
  bench.cancels.add(CancelRank::Job,
                    [&cancel = bench.job_cancel] { return cancel.cancelNewest(); });
  bench.cancels.add(CancelRank::Message, [&messages = bench.messages] {
    messages.dismiss();
    return true;
  });
  for (const Feature& feature : features()) feature.add(bench);
  addTabCommands();
  connect(&bench.frame, &Frame::tabShown, &core_->keyboard, &KeyboardHome::goHomeFromControls);
  layout_ = std::make_unique<Layout>(bench, *this);
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
    const QKeySequence key = tab.key ? *tab.key : QKeySequence(tr("Ctrl+%1").arg(++number));
    core_->commands.add({.id = "tab." + tab.id,
                         .menu = Menu::Tabs,
                         .text = tab.command_text,
                         .tip = tab.command_tip,
                         .icon = tab.icon,
                         .keys = key.isEmpty() ? QList<QKeySequence>() : QList{key},
                         .run = [frame = core_->frame, id = tab.id] { frame->showTab(id); }});
  }
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
  layout_->restoreSizes();
  core_->stage->canvas()->setFocus();
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (!core_->guards.may_leave(Leaving::Session)) {
    event->ignore();
    core_->guards.leave(Leaving::Session, [this] { close(); });
    return;
  }
  QSettings().setValue("geometry", saveGeometry());
  layout_->save();
  for (auto* dialog : findChildren<QDialog*>()) dialog->close();
  core_->frame->end();
  event->accept();
}

}  // namespace episcope

#include "moc_main_window.cpp"
