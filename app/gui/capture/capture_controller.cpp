// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/capture/capture_controller.h"

#include "app/gui/capture/capture_files.h"
#include "app/gui/capture/pair_marks.h"
#include "app/gui/capture/photographs.h"
#include "app/gui/frame/dialogs.h"
#include "app/gui/frame/frame.h"
#include "app/gui/frame/messages.h"
#include "app/gui/opening/scene_opener.h"
#include "app/gui/stage/stage.h"
#include "app/session/capture/mesh_truth.h"
#include "app/session/scene/gantry_scene.h"
#include "app/session/scene/scene_range.h"
#include "app/session/session.h"
#include "engine/capture/mesh/mesh_file.h"
#include "engine/capture/pose/pairs_file.h"
#include "engine/capture/pose/pose_file.h"
#include "engine/core/error.h"
#include "engine/io/archive/write_scene.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/capture/capture_panel.h"

#include <QCursor>
#include <QEvent>
#include <QFileInfo>
#include <QLocale>
#include <QVBoxLayout>

#include <array>
#include <cmath>
#include <utility>

namespace episcope {

// What a worker makes of a file.
struct CaptureController::Loaded {
  std::shared_ptr<const capture::TriangleMesh> mesh;
  CloudPartsPtr cloud;
};

CaptureController::CaptureController(const Workbench& bench, QWidget* tab)
    : QObject(&bench.owner),
      bench_(bench),
      tab_(tab),
      photographs_(new Photographs(
          bench, [this] { return now_->pairs.all(); }, this)) {
  followPhotographs();
  tab->installEventFilter(this);
  connect(&bench.frame, &Frame::tabShown, this, [this](const QString& id) {
    if (id == "capture") makePanel();
  });
  bench.session.on_changed([this](Parts parts) {
    if (parts.has(Part::Scene)) followScene();
    if (parts.has_any(Part::View | Part::CrossHair)) showNext();
    if (parts.has(Part::View)) showMarks();
  });
  connect(bench.stage.canvas(), &ViewCanvas::cursorMoved, this, [this] {
    if (!panel_ || bench_.stage.canvas()->marks().empty()) return;
    const ViewCanvas& canvas = *bench_.stage.canvas();
    panel_->setHovered(canvas.markAt(canvas.mapFromGlobal(QCursor::pos())));
  });
}

void CaptureController::followScene() {
  const auto [found, is_new] = of_scenes_.try_emplace(bench_.session.generation());
  if (is_new) found->second.pairs = PickedPairs(bench_.session.place().capture.pairs);
  if (std::exchange(now_, &found->second) == &found->second) return;
  openFormerMesh();
  changed();
  followGantry();
}

void CaptureController::followGantry() {
  if (!panel_ || !is_gantry(builtin_scene_id(bench_.session.input()))) return;
  if (!now_->pairs.all().empty()) return;
  const auto demo = gantry_folder(bench_.session.input(), bench_.opener.cacheFolder());
  if (!demo) return;
  importPairs(QString::fromStdString(demo->picks().string()));
  openMesh(QString::fromStdString(demo->mesh().string()));
  photographs_->calibrateGantry(*demo);
}

// The mesh that a project names, once it can be seen.
void CaptureController::openFormerMesh() {
  const std::string& file = bench_.session.place().capture.mesh;
  if (panel_ && !file.empty() && file != mesh_file_) loadMesh(QString::fromStdString(file));
}

// For the project; light fields that are just opened are followed first.
void CaptureController::keep() {
  const auto found = of_scenes_.find(bench_.session.generation());
  if (found == of_scenes_.end() || &found->second != now_) return;
  std::string mesh = mesh_file_.string();
  const std::string& former = bench_.session.place().capture.mesh;
  if (mesh.empty() || now_->pairs.all().empty()) mesh = former;
  bench_.session.set_capture({mesh, now_->pairs.all()});
}

// Light fields that it opens are shown already, and not yet told of.
void CaptureController::followPhotographs() {
  connect(photographs_, &Photographs::rectified, this,
          [this](const std::vector<capture::PointPair>& pairs) {
            followScene();
            now_->pairs.add(pairs);
            changed();
          });
  connect(photographs_, &Photographs::demoOpened, this,
          [this](const QString& mesh, const QString& picks) {
            followScene();
            importPairs(picks);
            openMesh(mesh);
          });
}

void CaptureController::makePanel() {
  if (panel_) return;
  // As in the 3D tab: the first OpenGL widget has the native window recreated.
  bench_.window.move(bench_.window.pos());
  panel_ = new CapturePanel(tab_);
  auto* layout = new QVBoxLayout(tab_);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(panel_);
  connectPanel();
  photographs_->attach(panel_->steps());
  openFormerMesh();
  changed();
  followGantry();
}

void CaptureController::connectPanel() {
  const auto ask = [this](const char* name, const QString& title, const QString& filter,
                          void (CaptureController::*answer)(const QString&), bool saves,
                          const QString& proposal = {}) {
    const FileQuestion question{
        .name = name, .title = title, .filter = filter, .proposal = proposal};
    const auto to = [this, answer](const QString& path) { (this->*answer)(path); };
    return saves ? ask_where_to_save(&bench_.window, question, to)
                 : ask_for_file(&bench_.window, question, to);
  };
  connect(panel_, &CapturePanel::openRequested, this, [=, this] {
    ask("open_mesh", tr("Open a mesh"), tr("Meshes (*.ply *.obj *.stl)"),
        &CaptureController::openMesh, false);
  });
  connect(panel_, &CapturePanel::importRequested, this, [=, this] {
    ask("import_pairs", tr("Import pairs"), tr("Pairs (*.csv)"), &CaptureController::importPairs,
        false);
  });
  connect(panel_, &CapturePanel::exportRequested, this, [=, this] {
    ask("export_pairs", tr("Export pairs"), tr("Pairs (*.csv)"), &CaptureController::exportPairs,
        true, "pairs.csv");
  });
  connect(panel_, &CapturePanel::savePoseRequested, this, [=, this] {
    ask("save_pose", tr("Save the pose"), tr("Pose (*.json)"), &CaptureController::savePose, true,
        "pose.json");
  });
  connect(panel_, &CapturePanel::writeTruthRequested, this, [=, this] {
    ask("write_truth", tr("Write the light field with its ground truth"), tr("Light field (*.h5)"),
        &CaptureController::writeTruth, true, "lf.h5");
  });
  connect(panel_, &CapturePanel::snapChanged, this, &CaptureController::showNext);
  connect(panel_, &CapturePanel::addRequested, this, &CaptureController::addPair);
  connect(panel_, &CapturePanel::emphasisChanged, this, &CaptureController::showMarks);
  connect(panel_, &CapturePanel::lockChanged, this, [this](int row, bool is_locked) {
    now_->pairs.lock(row, is_locked);
    changed();
  });
  connect(panel_, &CapturePanel::vertexPicked, this, &CaptureController::pickVertex);
  connect(panel_, &CapturePanel::showRequested, this, &CaptureController::showOverView);
  connect(panel_, &CapturePanel::removeRequested, this, [this] {
    now_->pairs.remove(panel_->selectedRows());
    changed();
  });
  connect(panel_, &CapturePanel::undoRequested, this, [this] {
    now_->pairs.undo();
    changed();
  });
  connect(panel_, &CapturePanel::renamed, this, [this](int row, const QString& name) {
    now_->pairs.rename(row, name.toStdString());
    changed();
  });
  connect(panel_, &CapturePanel::rowChosen, this, [this](int row) {
    const capture::PointPair& pair = now_->pairs.all()[row];
    bench_.session.set_view(bench_.session.light_field()->center());
    bench_.session.set_cross_hair(
        {static_cast<int>(std::lround(pair.x_px)), static_cast<int>(std::lround(pair.y_px))});
  });
}

void CaptureController::openMesh(const QString& path) {
  bench_.frame.showTab("capture");
  makePanel();
  loadMesh(path);
}

void CaptureController::loadMesh(const QString& path) {
  bench_.jobs.start<Loaded>(
      Lane::Load, tr("Opening %1").arg(QFileInfo(path).fileName()),
      [file = path_of(path)](const Progress& progress) {
        Loaded loaded;
        loaded.mesh = std::make_shared<const capture::TriangleMesh>(
            capture::read_mesh(file, progress.part(0, 0.8)));
        loaded.cloud = mesh_parts(*loaded.mesh);
        return loaded;
      },
      [this, path](const Loaded& loaded) {
        mesh_ = loaded.mesh;
        mesh_file_ = path_of(path);
        vertex_.reset();
        panel_->setMesh(
            tr("%1 · %2 faces")
                .arg(QFileInfo(path).fileName(),
                     QLocale::c().toString(static_cast<qulonglong>(mesh_->faces.size()))),
            loaded.cloud);
        changed();
      });
}

void CaptureController::importPairs(const QString& path) {
  try {
    now_->pairs.add(capture::read_pairs(path_of(path)));
    changed();
  } catch (const Error& error) {
    bench_.messages.fail(QString::fromUtf8(error.what()));
  }
}

void CaptureController::exportPairs(const QString& path) {
  if (!has_suffix(path, {"csv"}, bench_.messages)) return;
  write_in_background(bench_.jobs, bench_.messages, path,
                      [file = path_of(path), pairs = now_->pairs.all()](const Progress&) {
                        capture::write_pairs(file, pairs);
                      });
}

void CaptureController::savePose(const QString& path) {
  if (!pose_ || !has_suffix(path, {"json"}, bench_.messages)) return;
  capture::PoseStory story{mesh_file_, bench_.session.input(),
                           bench_.session.light_field()->info().camera, now_->pairs.all(), *pose_};
  write_in_background(
      bench_.jobs, bench_.messages, path,
      [file = path_of(path), story](const Progress&) { capture::write_pose(file, story); });
}

void CaptureController::writeTruth(const QString& path) {
  if (!pose_ || !mesh_ || !is_new_light_field(path, bench_.messages)) return;
  write_in_background(bench_.jobs, bench_.messages, path,
                      [file = path_of(path), mesh = mesh_, pose = pose_->pose,
                       scene = bench_.session.scene()](const Progress& progress) {
                        const Scene made =
                            with_mesh_truth(*mesh, pose, *scene, progress.part(0, 0.9));
                        io::write_archive(file, made, progress.part(0.9, 1));
                      });
}

void CaptureController::pickVertex(std::size_t vertex) {
  if (!mesh_ || vertex >= mesh_->vertices.size()) return;
  vertex_ = vertex;
  showNext();
}

void CaptureController::addPair() {
  if (!vertex_ || !bench_.session.scene()) return;
  const PixelIndex pixel = bench_.session.cross_hair();
  const auto mark = snapped();
  const auto& [x, y, z] = mesh_->vertices[*vertex_];
  now_->pairs.add({{"",
                    mark ? mark->place.x : static_cast<double>(pixel.x),
                    mark ? mark->place.y : static_cast<double>(pixel.y),
                    {x, y, z}}});
  vertex_.reset();
  changed();
}

void CaptureController::showOverView() {
  if (!pose_ || !mesh_) return;
  bench_.jobs.start<EstimatePtr>(
      Lane::Estimate, tr("Depth of the mesh"),
      [mesh = mesh_, pose = pose_->pose, scene = bench_.session.scene()](const Progress& progress) {
        return std::make_shared<const Estimate>(mesh_estimate(*mesh, pose, *scene, progress));
      },
      [this, scene = bench_.session.generation()](const EstimatePtr& estimate) {
        OfScene& of_scene = of_scenes_[scene];
        if (scene == bench_.session.generation()) bench_.session.remove_estimate(of_scene.result);
        of_scene.result = bench_.session.add_estimate(estimate, display_range(*estimate), scene);
      });
}

void CaptureController::changed() {
  keep();
  solve();
  showPairs();
  showNext();
}

void CaptureController::solve() {
  pose_.reset();
  problem_.clear();
  if (!mesh_ || !obstacle().isEmpty() || now_->pairs.all().size() < 4) return;
  try {
    pose_ = capture::solve_pose(now_->pairs.all(), bench_.session.light_field()->info().camera);
  } catch (const InvalidInput& error) {
    problem_ = QString::fromUtf8(error.what());
  }
}

QString CaptureController::obstacle() const {
  if (!bench_.session.scene()) return tr("Open a light field first.");
  if (!bench_.session.light_field()->info().camera.pinhole) {
    return tr(
        "This light field does not tell its focal length and centre in pixels, which a pose "
        "needs. Rectify photographs with their calibrated lens; pairs are carried over.");
  }
  return {};
}

std::optional<capture::SnappedPick> CaptureController::snapped() {
  if (!panel_->snaps()) return {};
  return snapper_.snap(bench_.session.light_field(), bench_.session.cross_hair());
}

QString CaptureController::nextText() {
  if (const auto mark = snapped()) {
    return QString("%1, %2 (%3)")
        .arg(mark->place.x, 0, 'f', 2)
        .arg(mark->place.y, 0, 'f', 2)
        .arg(mark->kind == capture::MarkKind::Corner ? tr("corner") : tr("blob"));
  }
  const PixelIndex pixel = bench_.session.cross_hair();
  const QString whole = QString("%1, %2").arg(pixel.x).arg(pixel.y);
  return panel_->snaps() ? tr("%1 (no mark beside it)").arg(whole) : whole;
}

void CaptureController::showNext() {
  if (!panel_) return;
  const bool is_here =
      bench_.session.scene() && bench_.session.view() == bench_.session.light_field()->center();
  std::optional<std::array<double, 3>> point;
  if (mesh_ && vertex_) {
    const auto& [x, y, z] = mesh_->vertices[*vertex_];
    point = {x, y, z};
  }
  const QString elsewhere = bench_.session.scene() ? tr("go to the centre view (Home)") : QString();
  panel_->setPicked(point ? std::optional(in_mesh_view({(*point)[0], (*point)[1], (*point)[2]}))
                          : std::nullopt);
  panel_->setNext(is_here ? nextText() : elsewhere, point, is_here && point);
}

void CaptureController::showPairs() {
  if (!panel_) return;
  panel_->setRows(pair_rows(now_->pairs.all(), pose_));
  panel_->setUndoable(now_->pairs.is_undoable());
  panel_->setPose(poseText(), pose_.has_value());
  showMarks();
}

void CaptureController::showMarks() {
  if (!panel_) return;
  const Session& session = bench_.session;
  PairMarks marks;
  if (session.scene()) {
    marks = pair_marks(now_->pairs.all(), pose_ ? &pose_->pose : nullptr,
                       session.light_field()->info().camera.pinhole,
                       [this](int row) { return panel_->isEmphasised(row); });
  }
  const bool is_here = session.scene() && session.view() == session.light_field()->center();
  if (!is_here || !tab_->isVisible()) marks.on_view.clear();
  if (!mesh_) marks.on_mesh.clear();
  bench_.stage.canvas()->setMarks(std::move(marks.on_view));
  panel_->setMarks(marks.on_mesh);
}

bool CaptureController::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Show || event->type() == QEvent::Hide) showMarks();
  return QObject::eventFilter(watched, event);
}

QString CaptureController::poseText() const {
  const QString missing = obstacle();
  if (!missing.isEmpty()) return missing;
  if (!problem_.isEmpty()) return problem_;
  const auto count = static_cast<int>(now_->pairs.all().size());
  if (!pose_) return tr("%1 of at least 4 pairs; 10 are better.").arg(count);
  QString text = tr("Mean reprojection error %1 px; depth to ± %2 (unit of the mesh)")
                     .arg(pose_->reprojection_error_px, 0, 'f', 2)
                     .arg(pose_->delta_tz, 0, 'g', 3);
  if (std::isfinite(pose_->delta_tz_px)) {
    text += tr(", ± %1 px of disparity").arg(pose_->delta_tz_px, 0, 'f', 4);
  }
  return text + '.';
}

}  // namespace episcope

#include "moc_capture_controller.cpp"
