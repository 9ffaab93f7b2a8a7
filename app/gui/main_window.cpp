// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/main_window.h"

#include "app/gui/files/file_controller.h"
#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/overlay.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/scene/scene_switcher.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/features.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/gui/shell/panes.h"
#include "app/session/session.h"
#include "engine/core/parallel.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/layout.h"

#include <QByteArray>
#include <QCloseEvent>
#include <QDialog>
#include <QMenuBar>
#include <QObject>
#include <QPointer>
#include <QScreen>
#include <QSettings>
#include <QSplitter>
#include <QThreadPool>
#include <QToolBar>

#include <algorithm>
#include <latch>
#include <vector>

namespace episcope {
namespace {

constexpr const char* kPanelsHidden = "layout/panels_hidden";
constexpr QSize kFirstSize(1280, 800);
constexpr QSize kDecorations(4, 40);
constexpr int kMostThreads = 4;  // a picture of a window has too few rows for more

QString key_of(const QSplitter& splitter) {
  return "layout/" + splitter.objectName();
}

// Starts the threads among which Qt divides the drawing of pictures, and keeps them. Qt would make
// them when they are needed and end them after a while; made by a lowered thread that happens to
// draw (lower_thread_priority), they would stay behind every job, and the window waits for them.
void keep_painting_threads() {
  QThreadPool& pool = *QThreadPool::globalInstance();
  if (pool.expiryTimeout() < 0) return;
  const int count = std::min(pool.maxThreadCount(), kMostThreads);
  pool.setMaxThreadCount(count);
  pool.setExpiryTimeout(-1);
  // Each waits for the others, so that each gets a thread of its own.
  const auto all = std::make_shared<std::latch>(count);
  for (int i = 0; i < count; ++i) {
    pool.start([all] {
      request_low_latency();
      all->arrive_and_wait();
    });
  }
}

}  // namespace

/// How the user has divided the window: sizes on both sides of splitters, kept in the settings.
class LayoutMemory {
 public:
  /// All splitters in `window` that have an object name of the form "split.NAME"; as they are now
  /// is how `reset` leaves them.
  explicit LayoutMemory(const QWidget& window);

  void save() const;
  void restore() const;
  /// As at first, and forgets what was saved.
  void reset() const;

 private:
  struct Kept {
    QPointer<QSplitter> splitter;
    QByteArray first_state;
    bool is_by_itself = false;
  };
  std::vector<Kept> kept_;
};

LayoutMemory::LayoutMemory(const QWidget& window) {
  for (auto* splitter : window.findChildren<QSplitter*>()) {
    if (splitter->objectName().startsWith("split.")) {
      kept_.push_back({splitter, splitter->saveState(), is_divided_by_itself(*splitter)});
    }
  }
}

void LayoutMemory::save() const {
  for (const Kept& each : kept_) {
    if (!each.splitter || is_divided_by_itself(*each.splitter)) continue;
    QSettings().setValue(key_of(*each.splitter), each.splitter->saveState());
  }
}

void LayoutMemory::restore() const {
  for (const Kept& each : kept_) {
    if (!each.splitter) continue;
    const QByteArray state = QSettings().value(key_of(*each.splitter)).toByteArray();
    if (each.splitter->restoreState(state)) set_divided_by_itself(*each.splitter, false);
  }
}

void LayoutMemory::reset() const {
  for (const Kept& each : kept_) {
    if (!each.splitter) continue;
    each.splitter->restoreState(each.first_state);
    set_divided_by_itself(*each.splitter, each.is_by_itself);
    QSettings().remove(key_of(*each.splitter));
  }
}

/// How the window is divided: full screen, side panels, panes in windows of their own, sizes; with
/// the commands for that, and kept in the settings.
class Layout : public QObject {
  Q_OBJECT

 public:
  /// After all tabs were added.
  Layout(const Workbench& bench, QMainWindow& window);

  void save() const;
  void restoreSizes() const { sizes_.restore(); }

 private:
  void addScreenCommands();
  void addPaneCommands();
  void addStackCommands();
  void reset();
  void toggleFullScreen();

  Workbench bench_;
  QMainWindow& window_;
  LayoutMemory sizes_;
};

Layout::Layout(const Workbench& bench, QMainWindow& window)
    : QObject(&window), bench_(bench), window_(window), sizes_(window) {
  Panes& panes = bench.frame.panes();
  bench.viewer_area.addPanesTo(panes);
  addScreenCommands();
  addPaneCommands();
  addStackCommands();
  connect(&panes, &Panes::opened, &bench.commands, &Commands::hearViewerKeys);
  connect(&panes, &Panes::changed, &bench.commands, &Commands::refresh);
  connect(&bench.frame, &Frame::started, this, [this] {
    bench_.frame.setPanelsShown(!QSettings().value(kPanelsHidden).toBool());
    bench_.frame.panes().restore();
    bench_.commands.refresh();
  });
}

void Layout::save() const {
  sizes_.save();
  bench_.frame.panes().save();
  QSettings().setValue(kPanelsHidden, !bench_.frame.arePanelsShown());
}

void Layout::toggleFullScreen() {
  window_.setWindowState(window_.windowState() ^ Qt::WindowFullScreen);
  bench_.commands.refresh();
}

void Layout::addScreenCommands() {
  bench_.commands.add({.menu = Menu::View, .section = section::kTabs},
                      {{.id = "view.full_screen",
                        .text = tr("Full screen"),
                        .tip = tr("Turns full screen on or off"),
                        .keys = {Qt::Key_F11},
                        .run = [this] { toggleFullScreen(); },
                        .checked = [this] { return window_.isFullScreen(); }},
                       {.id = "view.panels",
                        .text = tr("Side panels"),
                        .tip = tr("Shows the views at the left and the tabs at the right; without "
                                  "them, the view has all the room"),
                        .keys = {tr("Shift+F11")},
                        .run =
                            [this] {
                              Frame& frame = bench_.frame;
                              frame.setPanelsShown(!frame.arePanelsShown());
                              bench_.commands.refresh();
                            },
                        .checked = [this] { return bench_.frame.arePanelsShown(); }}});
}

void Layout::addPaneCommands() {
  Panes& panes = bench_.frame.panes();
  bench_.commands.add({.id = "panes.tab",
                       .menu = Menu::Panes,
                       .text = tr("Tab in its own window"),
                       .tip = tr("Detaches the current tab, as a double click on it does; close "
                                 "its window to dock it again"),
                       .keys = {Qt::Key_F6},
                       .run = [&panes, this] { panes.tear("tab." + bench_.frame.shownTab()); }});
  const auto add_epi = [&panes, this](const QString& id, const QString& text, const QString& tip,
                                      Qt::Key key) {
    bench_.commands.add({.id = "panes." + id,
                         .menu = Menu::Panes,
                         .text = text,
                         .tip = tip,
                         .keys = {key},
                         .run = [&panes, id] { panes.toggle(id); },
                         .checked = [&panes, id] { return panes.isTorn(id); }});
  };
  add_epi("epi.horizontal", tr("Horizontal EPI in its own window"),
          tr("Detaches the horizontal EPI into its own window, or docks it again"), Qt::Key_F7);
  add_epi("epi.vertical", tr("Vertical EPI in its own window"),
          tr("Detaches the vertical EPI into its own window, or docks it again"), Qt::Key_F8);
  bench_.commands.add({.id = "panes.reset",
                       .menu = Menu::Panes,
                       .text = tr("Reset layout"),
                       .tip = tr("Docks all panes and restores the default layout"),
                       .keys = {tr("Ctrl+Shift+F11")},
                       .run = [this] { reset(); },
                       .section = 2});
}

void Layout::addStackCommands() {
  Panes& panes = bench_.frame.panes();
  bench_.commands.add({.id = "panes.stack_tab",
                       .menu = Menu::Panes,
                       .text = tr("Tab below the others"),
                       .tip = tr("Moves the current tab into a second set of tabs below the "
                                 "others; its cross moves it back"),
                       .keys = {tr("Shift+F6")},
                       .run =
                           [&panes, this] {
                             bench_.frame.setPanelsShown(true);
                             panes.stack("tab." + bench_.frame.shownTab());
                           },
                       .section = 1});
  const auto add_stacked = [this, &panes](const QString& id, const QString& text,
                                          const QString& tip, const QString& key) {
    bench_.commands.add({.id = "panes.stack." + id,
                         .menu = Menu::Panes,
                         .text = text,
                         .tip = tip,
                         .keys = {key},
                         .run =
                             [&panes, this, id] {
                               bench_.frame.setPanelsShown(true);
                               panes.toggleStacked(id);
                             },
                         .section = 1,
                         .checked = [&panes, id] { return panes.isStacked(id); }});
  };
  add_stacked("epi.horizontal", tr("Horizontal EPI below the tabs"),
              tr("Moves the horizontal EPI into the tabs below the others, or back"),
              tr("Shift+F7"));
  add_stacked("epi.vertical", tr("Vertical EPI below the tabs"),
              tr("Moves the vertical EPI into the tabs below the others, or back"), tr("Shift+F8"));
}

void Layout::reset() {
  if (window_.isFullScreen()) toggleFullScreen();
  bench_.frame.setPanelsShown(true);
  bench_.frame.panes().reset();
  sizes_.reset();
  bench_.viewer_area.fitEpis();
  bench_.frame.resetLayout();
  bench_.commands.refresh();
}

/// What features share, in order of construction. Destroyed in reverse, so that workers end before
/// the session they refer to. Widgets belong to the window; controllers of features can be found in
/// it, as children.
struct MainWindow::Core {
  explicit Core(MainWindow& window)
      : session(queued_post(&window)),
        frame(new Frame(&window)),
        messages(*frame, session),
        job_cancel(session, jobs, messages, nullptr),
        viewer_area(new ViewerArea(frame)),
        commands(&window, frame->viewer()),
        keyboard(window, [this] { return viewer_area->keyboardHome(); }),
        overlay(session, *viewer_area, nullptr),
        document(session, nullptr),
        labels(document, nullptr),
        scenes(session, jobs, messages, nullptr),
        opener(session, jobs, *viewer_area, guards, scenes, nullptr),
        results(session, jobs, messages, nullptr),
        features(&window),
        bench{window,   features, session, jobs,   messages,     job_cancel,
              commands, cancels,  guards,  *frame, *viewer_area, overlay,
              document, labels,   scenes,  opener, results} {}

  Session session;
  Cancels cancels;
  LeaveGuards guards;
  Jobs jobs;
  Frame* frame;
  Messages messages;
  JobCancel job_cancel;
  ViewerArea* viewer_area;
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
  std::unique_ptr<Layout> layout;
};

MainWindow::MainWindow(QWidget* parent)
    : QMainWindow(parent), core_(std::make_unique<Core>(*this)) {
  const Workbench& bench = core_->bench;
  request_low_latency();
  keep_painting_threads();
  setCentralWidget(&bench.frame);
  bench.frame.setViewerArea(&bench.viewer_area);
  show_jobs(bench.jobs, bench.job_cancel, bench.frame, bench.messages);
  connect(&bench.document, &DocumentController::problem, &bench.messages,
          qOverload<const QString&>(&Messages::warn));
  connect(&bench.document, &DocumentController::finding, &bench.messages,
          [&messages = bench.messages](const QString& sentence) {
            messages.warn(sentence);
            messages.endWithLightField();
          });
  connect(&bench.opener, &SceneOpener::failed, &bench.messages, &Messages::fail);
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
  core_->layout = std::make_unique<Layout>(bench, *this);
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

void MainWindow::start(const QStringList& inputs) {
  findChild<FileController*>()->open(inputs);
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
  auto* bar = named("tool_bar", new QToolBar(tr("Main tool bar"), this));
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
  core_->layout->restoreSizes();
  core_->viewer_area->canvas()->setFocus();
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (!core_->guards.may_leave(Leaving::Session)) {
    event->ignore();
    core_->guards.leave(Leaving::Session, [this] { close(); });
    return;
  }
  QSettings().setValue("geometry", saveGeometry());
  core_->layout->save();
  for (auto* dialog : findChildren<QDialog*>()) dialog->close();
  core_->frame->end();
  event->accept();
}

}  // namespace episcope

#include "main_window.moc"
#include "moc_main_window.cpp"
