// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/main_window.h"

#include "app/gui/actions.h"
#include "app/gui/annotate/annotate_controller.h"
#include "app/gui/annotate/annotation_files.h"
#include "app/gui/annotate/recovery_controller.h"
#include "app/gui/annotate/scribble_controller.h"
#include "app/gui/annotate_actions.h"
#include "app/gui/browse/browse_controller.h"
#include "app/gui/browse/value_controller.h"
#include "app/gui/cloud/cloud_controller.h"
#include "app/gui/compare/compare_controller.h"
#include "app/gui/compare/metric_controller.h"
#include "app/gui/compare/picture_export.h"
#include "app/gui/compare/statistics_controller.h"
#include "app/gui/compare_actions.h"
#include "app/gui/document/document_controller.h"
#include "app/gui/estimate/estimate_controller.h"
#include "app/gui/files/focus_controller.h"
#include "app/gui/files/scene_info.h"
#include "app/gui/frame/commands.h"
#include "app/gui/frame/jobs.h"
#include "app/gui/frame/queued_post.h"
#include "app/gui/help/command_palette.h"
#include "app/gui/help/shortcut_window.h"
#include "app/gui/opening/scene_opener.h"
#include "app/gui/segment/segment_controller.h"
#include "app/gui/segment_actions.h"
#include "app/gui/stage/overlay.h"
#include "app/session/scene/load_scene.h"
#include "app/session/session.h"
#include "engine/core/version.h"
#include "widgets/browse/info_panel.h"
#include "widgets/browse/value_bar.h"
#include "widgets/browse/view_grid.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/compare/color_bar.h"
#include "widgets/compare/compare_bar.h"
#include "widgets/compare/metric_table.h"
#include "widgets/compare/overlay_bar.h"
#include "widgets/controls/job_panel.h"
#include "widgets/controls/message_bar.h"
#include "widgets/estimate/method_panel.h"
#include "widgets/estimate/result_list.h"

#include <QAbstractItemView>
#include <QAction>
#include <QActionGroup>
#include <QCloseEvent>
#include <QKeyEvent>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QSettings>
#include <QToolBar>
#include <QToolButton>

namespace episcope {
namespace {

constexpr const char* kFirstMethod = "epi_l";
constexpr QSize kFirstSize(1280, 800);

}  // namespace

MainWindow::MainWindow(QWidget* parent)
    : QMainWindow(parent), session_(std::make_unique<Session>(queued_post(this))) {
  setWindowTitle("Episcope");
  setAcceptDrops(true);
  auto* body = new QWidget(this);
  panels_ = make_panels(body);
  setCentralWidget(body);
  jobs_ = new Jobs(this);
  browse_ = new BrowseController(*session_, panels_, this);
  overlay_ = new OverlayController(*session_, panels_, this);
  compare_ = new CompareController(*session_, *overlay_, panels_, this);
  statistics_ = new StatisticsController(*session_, *overlay_, panels_, this);
  values_ = new ValueController(*session_, *overlay_, panels_, this);
  document_ = new DocumentController(*session_, this);
  annotate_ = new AnnotateController(*session_, *document_, panels_, this);
  scribbles_ = new ScribbleController(*session_, *document_, panels_, this);
  segment_ = new SegmentController(*session_, *document_, *annotate_, *jobs_, panels_, this);
  estimate_ = new EstimateController(*session_, *jobs_, panels_, this);
  metrics_ = new MetricController(*session_, *jobs_, panels_, this);
  opener_ = new OpenController(*session_, *jobs_, *browse_, panels_, this);
  focus_ = new FocusController(*session_, *jobs_, *opener_, *document_, this);
  annotation_files_ = new AnnotationFiles(*session_, *jobs_, *document_, panels_, this);
  recovery_ = new RecoveryController(
      *session_, *document_, *panels_.recovery,
      [this](const QString& source, double focus_px) {
        if (focus_px == 0) return open(source);
        opener_->open(source, [this, focus_px] { opener_->reopenAt(focus_px, nullptr); });
      },
      [this](std::function<void()> go_on) { annotation_files_->leave(std::move(go_on)); }, this);
  exporter_ = new ExportController(*session_, *jobs_, *overlay_, panels_, this);
  cloud_ = new CloudController(*session_, *overlay_, panels_, this);
  actions_ = new ActionTable(this, panels_.viewer);
  add_actions(*actions_, *this);
  panels_.color_bar->followTips(actions_->find("compare.auto_range"),
                                actions_->find("compare.own_range"));
  panels_.method->followTips(actions_->find("estimate.cancel"),
                             actions_->find("estimate.copy_command"));
  panels_.overlay_bar->addFocusAction(actions_->find("view.focus_apply"));
  panels_.view_grid->followTip(actions_->find("view.play"));
  palette_ = new CommandPalette(*actions_, this);
  buildBars();
  connectJobs();
  connectControllers();
  connectAnnotation();
  connectFiles();
  installEventFilter(opener_);
  flippers_ = {panels_.canvas, panels_.results->findChild<QAbstractItemView*>(),
               panels_.metrics->findChild<QAbstractItemView*>()};
  for (QWidget* each : flippers_) each->installEventFilter(this);
  connect(actions_, &ActionTable::keysChanged, this, &MainWindow::showInvitation);
  showInvitation();
  session_->on_changed([this](Parts parts) {
    if (parts.has(Part::Scene)) showInfo();
    if (parts.has_any(Part::Scene | Part::Estimates | Part::Shown | Part::Focus)) updateActions();
  });
  showInfo();
  showStatus();
  updateActions();
  restoreLayout();
}

// Controllers and their workers end before the session that they speak of.
MainWindow::~MainWindow() {
  for (QObject* each : std::initializer_list<QObject*>{
           cloud_, exporter_, recovery_, annotation_files_, focus_, opener_, metrics_, estimate_,
           segment_, scribbles_, annotate_, document_, values_, statistics_, compare_, overlay_,
           browse_, jobs_}) {
    delete each;
  }
}

void MainWindow::open(const QString& input) {
  const bool is_builtin = !builtin_scene_id(input.toStdString()).empty();
  opener_->open(input, [this, is_builtin] {
    if (is_builtin) estimate_->run({kFirstMethod, {}, {}});
  });
}

void MainWindow::buildBars() {
  actions_->fillMenus(*menuBar());
  recent_menu_ = new QMenu(tr("Open recent"), this);
  menuBar()
      ->findChild<QMenu*>("menu." + tr("File"))
      ->insertMenu(actions_->find("file.demo"), recent_menu_);
  fillRecentMenu();

  QToolBar* bar = panels_.tool_bar;
  bar->setContextMenuPolicy(Qt::PreventContextMenu);
  bar->addAction(actions_->find("file.open"));
  bar->addAction(actions_->find("file.export"));
  bar->addAction(actions_->find("annotate.mode"));
  bar->addSeparator();
  auto* overlays = new QActionGroup(this);
  for (const auto& [id, quantity] : overlay_actions()) {
    overlays->addAction(actions_->find(id));
    if (render::info_of(quantity).has_button) bar->addAction(actions_->find(id));
  }
  for (const auto& [id, quantity] : segment_overlay_actions()) {
    overlays->addAction(actions_->find(id));
  }
  bar->addSeparator();
  for (const char* id :
       {"compare.wipe", "compare.sides", "compare.tiles", "compare.difference", "compare.swap"}) {
    panels_.compare->addAction(actions_->find(id), QString("button.%1").arg(id));
  }
  bar->addAction(actions_->find("compare.tiles"));
  bar->addAction(actions_->find("compare.difference"));
  bar->addSeparator();
  bar->addWidget(panels_.overlay_bar);
  bar->addAction(actions_->find("help.keys"));
  for (auto* button : bar->findChildren<QToolButton*>()) button->setFocusPolicy(Qt::NoFocus);
  addToolBar(bar);
}

void MainWindow::connectJobs() {
  connect(jobs_, &Jobs::added, panels_.jobs, &JobPanel::addJob);
  connect(jobs_, &Jobs::progressed, panels_.jobs, &JobPanel::setProgress);
  connect(jobs_, &Jobs::cancelling, panels_.jobs, &JobPanel::setCancelling);
  connect(jobs_, &Jobs::finishing, panels_.jobs, &JobPanel::setFinishing);
  connect(jobs_, &Jobs::removed, panels_.jobs, &JobPanel::removeJob);
  connect(panels_.jobs, &JobPanel::cancelRequested, jobs_, &Jobs::cancel);
  connect(panels_.jobs, &JobPanel::finishRequested, jobs_, &Jobs::finishEarly);
  connect(jobs_, &Jobs::added, this, &MainWindow::showStatus);
  connect(jobs_, &Jobs::removed, this, &MainWindow::showStatus);
  connect(jobs_, &Jobs::failed, this, [this](const QString& sentence) {
    panels_.messages->showMessage(Severity::Error, sentence);
  });
}

void MainWindow::connectControllers() {
  const auto hint = [this](const QString& sentence) {
    panels_.messages->showMessage(Severity::Info, sentence);
  };
  connect(browse_, &BrowseController::hint, this, hint);
  connect(estimate_, &EstimateController::hint, this, hint);
  connect(focus_, &FocusController::hint, this, hint);
  connect(exporter_, &ExportController::hint, this, hint);
  connect(metrics_, &MetricController::hint, this, hint);
  const auto written = [this](const QString& path) {
    panels_.messages->showMessage(Severity::Success, tr("Written: %1").arg(path));
  };
  connect(exporter_, &ExportController::written, this, written);
  connect(metrics_, &MetricController::written, this, written);
  const auto warn = [this](const QString& sentence) {
    panels_.messages->showMessage(Severity::Warning, sentence);
  };
  connect(opener_, &OpenController::warned, this, warn);
  connect(exporter_, &ExportController::refused, this, warn);
  connect(estimate_, &EstimateController::exportRequested, exporter_,
          &ExportController::exportResultDialog);
  connect(overlay_, &OverlayController::choiceChanged, this, &MainWindow::updateActions);
  connect(panels_.canvas, &ViewCanvas::spaceTapped, actions_, [this] {
    if (QAction* action = actions_->find(actions_->userOf(Qt::Key_Space))) action->trigger();
  });
  connect(panels_.color_bar, &ColorBar::automaticRangeRequested, statistics_,
          &StatisticsController::useAutomaticRange);
  connect(compare_, &CompareController::modeChanged, this, &MainWindow::updateActions);
  connect(opener_, &OpenController::previewing, compare_, &CompareController::leave);
  connect(opener_, &OpenController::previewing, overlay_, &OverlayController::setSuspended);
  connect(opener_, &OpenController::previewing, this, [this](bool is_previewing) {
    if (session_->scene()) return;
    panels_.info->setInfo(is_previewing ? tr("Opening …") : tr("Nothing is open"), {}, {});
  });
  connect(opener_, &OpenController::recentInputsChanged, this, &MainWindow::fillRecentMenu);
  connect(opener_, &OpenController::reopenableChanged, this, &MainWindow::updateActions);
  panels_.info->setConventionsAction(actions_->find("file.conventions"));
  connect(opener_, &OpenController::titleChanged, this, [this](const QString& title) {
    setWindowTitle(title.isEmpty() ? QString("Episcope") : tr("%1[*] — Episcope").arg(title));
  });
}

void MainWindow::connectAnnotation() {
  follow_document(*actions_, *this);
  follow_segmentation(*actions_, *this);
  const auto hint = [this](const QString& sentence) {
    panels_.messages->showMessage(Severity::Info, sentence);
  };
  connect(annotate_, &AnnotateController::hint, this, hint);
  connect(scribbles_, &ScribbleController::hint, this, hint);
  connect(segment_, &SegmentController::hint, this, hint);
  connect(segment_, &SegmentController::labelsArrived, overlay_, [this] {
    if (render::info_of(overlay_->quantity()).subject != render::Subject::Segmentation) {
      overlay_->setQuantity(render::Quantity::Segmentation);
    }
  });
  connect(document_, &DocumentController::problem, this, [this](const QString& sentence) {
    panels_.messages->showMessage(Severity::Warning, sentence);
  });
  connect(annotate_, &AnnotateController::modeChanged, this, [this] {
    if (annotate_->isAnnotating()) compare_->leave();
  });
  connect(opener_, &OpenController::previewing, annotate_, &AnnotateController::setSuspended);
  connect(opener_, &OpenController::previewing, scribbles_, &ScribbleController::setSuspended);
}

void MainWindow::connectFiles() {
  opener_->setGuard(
      [this](std::function<void()> go_on) { annotation_files_->leave(std::move(go_on)); });
  connect(document_, &DocumentController::unsavedChanged, this, &MainWindow::setWindowModified);
  connect(annotation_files_, &AnnotationFiles::hint, this, [this](const QString& sentence) {
    panels_.messages->showMessage(Severity::Info, sentence);
  });
  connect(annotation_files_, &AnnotationFiles::written, this, [this](const QString& path) {
    panels_.messages->showMessage(Severity::Success, tr("Written: %1").arg(path));
  });
  connect(annotation_files_, &AnnotationFiles::imported, this, [this](const QString& path) {
    panels_.messages->showMessage(Severity::Success, tr("Imported: %1").arg(path));
  });
  connect(annotation_files_, &AnnotationFiles::compared, this, [this](const QString& path) {
    panels_.messages->showMessage(Severity::Success, tr("Labels are compared with %1").arg(path));
  });
  connect(recovery_, &RecoveryController::recovered, this, [this](const QString& name) {
    annotate_->setAnnotating(true);
    panels_.messages->showMessage(Severity::Success,
                                  tr("Recovered what was painted on “%1”.").arg(name));
  });
}

void MainWindow::offerRecovery() {
  recovery_->look();
}

void MainWindow::fillRecentMenu() {
  recent_menu_->clear();
  for (const QString& input : opener_->recentInputs()) {
    recent_menu_->addAction(input, this, [this, input] { open(input); });
  }
  recent_menu_->setEnabled(!recent_menu_->isEmpty());
  if (recent_menu_->isEmpty()) return;
  recent_menu_->addSeparator();
  recent_menu_->addAction(tr("Forget all"), opener_, &OpenController::forgetRecentInputs);
}

void MainWindow::updateActions() {
  const bool has_scene = session_->scene() != nullptr;
  const bool has_result = session_->shown() != nullptr;
  for (const auto* overlays : {&overlay_actions(), &segment_overlay_actions()}) {
    for (const auto& [id, quantity] : *overlays) {
      QAction* action = actions_->find(id);
      action->setEnabled(overlay_->isAvailable(quantity));
      if (overlay_->quantity() == quantity) action->setChecked(true);
    }
  }
  actions_->find("compare.difference")->setChecked(overlay_->showsDifference());
  for (const auto& [id, mode] : std::initializer_list<std::pair<const char*, CompareMode>>{
           {"compare.wipe", CompareMode::Wipe},
           {"compare.sides", CompareMode::Sides},
           {"compare.tiles", CompareMode::Wall}}) {
    actions_->find(id)->setEnabled(compare_->isAvailable(mode));
    actions_->find(id)->setChecked(compare_->mode() == mode);
  }
  actions_->find("compare.flip")->setEnabled(has_result);
  for (const char* id : {"compare.difference", "compare.swap"}) {
    actions_->find(id)->setEnabled(session_->compared() != nullptr);
  }
  for (const char* id : {"file.export", "estimate.remove", "estimate.next", "estimate.previous"}) {
    actions_->find(id)->setEnabled(has_result);
  }
  actions_->find("view.focus_apply")->setEnabled(focus_->canApply());
  actions_->find("view.focus_undo")->setEnabled(focus_->canUndo());
  actions_->find("file.conventions")->setEnabled(!opener_->reopenable().isEmpty());
  for (const char* id :
       {"file.save_scribbles", "file.save_scribbles_as", "file.export_scribbles",
        "file.import_scribbles", "file.compare_labels", "file.save_picture", "file.save_map",
        "file.close", "file.open_result", "estimate.run", "estimate.copy_command"}) {
    actions_->find(id)->setEnabled(has_scene);
  }
}

void MainWindow::showInfo() {
  if (!session_->scene()) {
    panels_.info->setInfo(tr("Nothing is open"), {}, {});
    return;
  }
  const SceneInfo info = describe(*session_->scene());
  panels_.info->setInfo(info.title, info.rows, info.warnings);
}

void MainWindow::showInvitation() {
  const QString key = actions_->keyText("file.open");
  panels_.canvas->setEmptyHint(
      key.isEmpty() ? tr("Open a light field, or drop a file or a folder here.")
                    : tr("Open a light field with %1, or drop a file or a folder here.").arg(key));
}

void MainWindow::showStatus() {
  const int count = jobs_->count();
  panels_.values->setStatus(count == 0   ? tr("ready")
                            : count == 1 ? tr("1 job running")
                                         : tr("%1 jobs running").arg(count));
}

void MainWindow::showShortcuts() {
  if (!shortcuts_) shortcuts_ = new ShortcutWindow(*actions_, this);
  shortcuts_->show();
  shortcuts_->raise();
}

void MainWindow::showPalette() {
  palette_->popUp();
}

void MainWindow::showAbout() {
  auto* box = new QMessageBox(
      QMessageBox::NoIcon, tr("About Episcope"),
      tr("<b>Episcope %1</b><p>Views, EPIs, disparity and labels of 4D light fields.</p>"
         "<p>BSD 3-Clause licence.</p>")
          .arg(kVersion),
      QMessageBox::Close, this);
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->open();
}

void MainWindow::escape() {
  if (annotate_->cancelStroke() || segment_->cancel() || browse_->endWhatIsInHand() ||
      compare_->leave())
    return;
  if (const quint64 job = jobs_->newest()) {
    jobs_->cancel(job);
  } else {
    panels_.messages->dismiss();
  }
}

bool MainWindow::eventFilter(QObject* watched, QEvent* event) {
  const bool is_press = event->type() == QEvent::KeyPress;
  const bool is_flipper = std::find(flippers_.begin(), flippers_.end(), watched) != flippers_.end();
  if (is_flipper && (is_press || event->type() == QEvent::KeyRelease)) {
    const auto* key = static_cast<QKeyEvent*>(event);
    for (const QKeySequence& flip : actions_->keys("compare.flip")) {
      // Modifiers may be let go before the key.
      const bool is_flip = is_press ? QKeySequence(key->keyCombination()) == flip
                                    : key->key() == flip[0].key() && overlay_->isFlipped();
      if (!is_flip) continue;
      if (!key->isAutoRepeat() && compare_->mode() == CompareMode::Single) {
        overlay_->setFlipped(is_press);
      }
      return true;
    }
  }
  if (is_flipper && event->type() == QEvent::FocusOut) overlay_->setFlipped(false);
  return QMainWindow::eventFilter(watched, event);
}

void MainWindow::restoreLayout() {
  const QByteArray geometry = QSettings().value("geometry").toByteArray();
  if (geometry.isEmpty() || !restoreGeometry(geometry)) resize(kFirstSize);
  panels_.canvas->setFocus();
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (document_->hasUnsavedChanges()) {
    event->ignore();
    annotation_files_->leave([this] { close(); });
    return;
  }
  QSettings().setValue("geometry", saveGeometry());
  event->accept();
}

}  // namespace episcope
