// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/capture/capture_controller.h"

#include "app/gui/capture/photographs.h"
#include "app/gui/capture/raw_pictures.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/dialogs.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/session/load_scene.h"
#include "app/session/scene_summary.h"
#include "app/session/session.h"
#include "engine/capture/alignment.h"
#include "engine/capture/solve_pose.h"
#include "engine/core/error.h"
#include "engine/io/formats/write_scene.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/layout.h"
#include "widgets/panels/capture_panel.h"
#include "widgets/panels/raw_picture_panel.h"

#include <QAction>
#include <QCursor>
#include <QEvent>
#include <QFileInfo>
#include <QKeyEvent>
#include <QLocale>
#include <QTabWidget>

#include <array>
#include <cmath>
#include <utility>

namespace episcope {

/// Outputs of meshes and poses: a result, ground truth, files of poses.
class MeshResults : public QObject {
  Q_OBJECT

 public:
  MeshResults(const Workbench& bench, const CaptureDocuments& documents, const MeshShelf& shelf,
              QObject* parent)
      : QObject(parent), bench_(bench), documents_(documents), shelf_(shelf) {}

  /// Adds the depth of all objects in the center view as a result, replacing the previous one.
  void showOverView() {
    const std::vector<PosedMesh> meshes = posedMeshes();
    if (meshes.empty()) return;
    const quint64 job = bench_.jobs.start<EstimatePtr>(
        Lane::Estimate, job_title(tr("Depth of the mesh"), bench_.session),
        [meshes, scene = bench_.session.scene()](const Progress& progress) {
          return std::make_shared<const Estimate>(mesh_estimate(meshes, *scene, progress));
        },
        [this, scene = bench_.session.generation()](const EstimatePtr& estimate) {
          int& result = results_[scene];
          if (scene == bench_.session.generation()) bench_.session.remove_estimate(result);
          result = bench_.session.add_estimate(estimate, display_range(*estimate), scene);
          bench_.session.show_opened_estimate(result);
        });
    bench_.jobs.setScene(job, bench_.session.generation());
  }

  /// Writes the light field with the depth of all objects in all views as ground truth.
  void writeTruth(const QString& path) {
    const std::vector<PosedMesh> meshes = posedMeshes();
    if (meshes.empty() || !is_new_light_field(path, bench_.messages)) return;
    write_in_background(
        bench_.jobs, bench_.messages, path,
        [file = path_of(path), meshes, scene = bench_.session.scene()](const Progress& progress) {
          const Scene made = with_mesh_truth(meshes, *scene, progress.part(0, 0.9));
          io::write_archive(file, made, progress.part(0.9, 1));
        });
  }

  /// Writes the pose of the current object.
  void savePose(const QString& path) {
    const CaptureObject* object = documents_.now().work().object();
    if (!object || !object->pose || !has_suffix(path, {"json"}, bench_.messages)) return;
    const capture::PoseStory story{object->mesh, bench_.session.input(),
                                   bench_.session.light_field()->info().camera, object->pairs,
                                   *object->pose};
    write_in_background(
        bench_.jobs, bench_.messages, path,
        [file = path_of(path), story](const Progress&) { capture::write_pose(file, story); });
  }

 private:
  /// All objects with mesh and pose. Tells the user which are left out.
  [[nodiscard]] std::vector<PosedMesh> posedMeshes() const {
    std::vector<PosedMesh> posed;
    QStringList left_out;
    for (const CaptureObject& object : documents_.now().work().objects) {
      const ReadMesh* read = shelf_.find(object.mesh);
      if (read && object.pose) {
        posed.push_back({read->mesh, object.pose->pose});
      } else {
        left_out << QString::fromStdString(object.name);
      }
    }
    if (!posed.empty() && !left_out.isEmpty()) {
      bench_.messages.warn(
          tr("Skipped without a mesh or a pose: %1.").arg(left_out.join(QStringLiteral(", "))));
    }
    return posed;
  }

  Workbench bench_;
  const CaptureDocuments& documents_;
  const MeshShelf& shelf_;
  std::map<std::uint64_t, int> results_;  // by OpenScene::id
};

MeshShelf::MeshShelf(const Workbench& bench, QObject* parent) : QObject(parent), bench_(bench) {
  connect(&bench.jobs, &Jobs::failed, this, [this](const QString&, quint64 job) {
    for (const auto& [file, reading] : reading_) {
      if (reading == job) broken_.insert(file);
    }
  });
}

void MeshShelf::read(const std::string& file, const std::function<void()>& then) {
  reading_[file] = bench_.jobs.start<ReadMesh>(
      Lane::Load, tr("Opening %1").arg(QFileInfo(QString::fromStdString(file)).fileName()),
      [file](const Progress& progress) {
        ReadMesh read;
        read.mesh = std::make_shared<const capture::TriangleMesh>(
            capture::read_mesh(file, progress.part(0, 0.8)));
        read.cloud = mesh_parts(*read.mesh);
        return read;
      },
      [this, file, then](const ReadMesh& read) {
        reading_.erase(file);
        broken_.erase(file);
        meshes_[file] = read;
        then();
      },
      [this, file] {
        if (reading_.erase(file) > 0) emit changed();
      });
}

void MeshShelf::keep(const std::set<std::string>& files) {
  std::erase_if(meshes_, [&](const auto& each) { return !files.contains(each.first); });
  for (const std::string& file : files) {
    if (file.empty() || find(file) || isReading(file) || isBroken(file)) continue;
    read(file, [this] { emit changed(); });
  }
}

const ReadMesh* MeshShelf::find(const std::string& file) const {
  const auto found = meshes_.find(file);
  return found == meshes_.end() ? nullptr : &found->second;
}

namespace {

// Why there is no pose; empty = there can be one.
QString obstacle(const Session& session) {
  if (!session.scene()) return open_a_light_field();
  if (!session.light_field()->info().camera.pinhole) {
    return CaptureController::tr(
        "This light field does not tell its focal length and center in pixels, which a pose "
        "needs. Rectify photographs with their calibrated lens; pairs are carried over.");
  }
  return {};
}

// State of the current object's pose, or what it lacks.
QString pose_text(const Session& session, const CaptureDocuments& documents) {
  const QString missing = obstacle(session);
  if (!missing.isEmpty()) return missing;
  if (!documents.problem().isEmpty()) return documents.problem();
  const CaptureObject* object = documents.now().work().object();
  if (!object || !object->pose) {
    return CaptureController::tr("%1 of at least 4 pairs; 10 are better.")
        .arg(documents.now().pairs().size());
  }
  const capture::SolvedPose& pose = *object->pose;
  QString text =
      CaptureController::tr("Mean reprojection error %1 px; depth to ± %2 (unit of the mesh)")
          .arg(pose.reprojection_error_px, 0, 'f', 2)
          .arg(pose.delta_tz, 0, 'g', 3);
  if (std::isfinite(pose.delta_tz_px)) {
    text += CaptureController::tr(", ± %1 px of disparity").arg(pose.delta_tz_px, 0, 'f', 4);
  }
  return text + '.';
}

}  // namespace

CaptureController::CaptureController(const Workbench& bench, QWidget* tab)
    : QObject(&bench.owner),
      bench_(bench),
      tab_(tab),
      documents_(new CaptureDocuments(bench, this)),
      shelf_(new MeshShelf(bench, this)),
      photographs_(new Photographs(bench, *documents_, this)),
      raw_pictures_(new RawPictures(bench, this)),
      results_(new MeshResults(bench, *documents_, *shelf_, this)) {
  tab->installEventFilter(this);
  bench.viewer_area.canvas()->installEventFilter(this);
  connect(documents_, &CaptureDocuments::changed, this, &CaptureController::show);
  connect(shelf_, &MeshShelf::changed, this, &CaptureController::showRead);
  connect(&bench.frame, &Frame::tabShown, this, [this](const QString& id) {
    if (id == "capture") makePanel();
  });
  bench.session.on_changed([this](Parts parts) {
    if (parts.has(Part::Scene)) followGantry();
    if (parts.has_any(Part::View | Part::CrossHair)) showNext();
    if (parts.has(Part::View)) showMarks();
  });
  connect(bench.viewer_area.canvas(), &ViewCanvas::cursorMoved, this, [this] {
    if (!panel_ || bench_.viewer_area.canvas()->marks().empty()) return;
    const ViewCanvas& canvas = *bench_.viewer_area.canvas();
    panel_->setHovered(canvas.markAt(canvas.mapFromGlobal(QCursor::pos())));
  });
}

const CaptureWork& CaptureController::work() const {
  return documents_->now().work();
}

const std::vector<capture::PointPair>& CaptureController::pairs() const {
  return documents_->now().pairs();
}

const std::optional<capture::SolvedPose>& CaptureController::pose() const {
  static const std::optional<capture::SolvedPose> kNone;
  const CaptureObject* object = work().object();
  return object ? object->pose : kNone;
}

const ReadMesh* CaptureController::mesh() const {
  const CaptureObject* object = work().object();
  return object ? shelf_->find(object->mesh) : nullptr;
}

void CaptureController::followGantry() {
  const CaptureDocument& document = documents_->now();
  const std::string& input = bench_.session.input();
  if (!panel_ || !is_gantry(builtin_scene_id(input))) return;
  if (!document.work().objects.empty() || document.history().count() > 0) return;
  if (const auto demo = gantry_folder(input, bench_.opener.cacheFolder())) {
    photographs_->beginGantry(*demo);
  }
}

void CaptureController::makePanel() {
  if (panel_) return;
  auto* pages = named("capture.pages", new QTabWidget(tab_));
  pages->setDocumentMode(true);
  panel_ = new CapturePanel(pages);
  QStringList mosaics;
  for (const auto& each : names_of(capture::Mosaic{})) mosaics << QString(each.name);
  auto* raw = new RawPicturePanel(mosaics, pages);
  pages->addTab(panel_, tr("Photographs"));
  pages->addTab(raw, tr("Raw picture"));
  connect(raw_pictures_, &RawPictures::begun, pages,
          [pages, raw] { pages->setCurrentWidget(raw); });
  make_column(tab_, {pages});
  connectObjects();
  connectPairs();
  connectResults();
  connectFiles();
  photographs_->attach(panel_->steps());
  raw_pictures_->attach(raw);
  show();
  followGantry();
}

void CaptureController::change(const Change& change) {
  documents_->change(change);
}

void CaptureController::connectObjects() {
  const CaptureObjects* objects = panel_->objects();
  connect(objects, &CaptureObjects::chosen, this, [this](int object) {
    change([=](CaptureDocument& document) { document.choose(object); });
  });
  connect(objects, &CaptureObjects::renamed, this, [this](const QString& name) {
    change([&](CaptureDocument& document) { document.rename_object(name.toStdString()); });
  });
  connect(objects, &CaptureObjects::removeRequested, this,
          [this] { change(&CaptureDocument::remove_object); });
  connect(panel_, &CapturePanel::undoRequested, this, [this] { change(&CaptureDocument::undo); });
  connect(panel_, &CapturePanel::redoRequested, this, [this] { change(&CaptureDocument::redo); });
}

void CaptureController::connectPairs() {
  connect(panel_, &CapturePanel::snapChanged, this, &CaptureController::showNext);
  connect(panel_, &CapturePanel::addRequested, this, &CaptureController::addPair);
  connect(panel_, &CapturePanel::emphasisChanged, this, &CaptureController::showMarks);
  connect(panel_, &CapturePanel::vertexPicked, this, &CaptureController::pickVertex);
  connect(panel_, &CapturePanel::lockChanged, this, [this](int row, bool is_locked) {
    change([=](CaptureDocument& document) { document.lock_pair(row, is_locked); });
  });
  connect(panel_, &CapturePanel::removeRequested, this, [this] {
    change([this](CaptureDocument& document) { document.remove_pairs(panel_->selectedRows()); });
  });
  connect(panel_, &CapturePanel::renamed, this, [this](int row, const QString& name) {
    change([&](CaptureDocument& document) { document.rename_pair(row, name.toStdString()); });
  });
  connect(panel_, &CapturePanel::rowChosen, this,
          [this](int row) { goTo(pairs()[static_cast<std::size_t>(row)]); });
}

void CaptureController::goTo(const capture::PointPair& pair) {
  bench_.session.set_view(bench_.session.light_field()->center());
  bench_.session.set_cross_hair(
      {static_cast<int>(std::lround(pair.y_px)), static_cast<int>(std::lround(pair.x_px))});
}

void CaptureController::connectResults() {
  connect(panel_, &CapturePanel::showRequested, results_, &MeshResults::showOverView);
  connect(panel_, &CapturePanel::savePoseRequested, this, [this] {
    ask_where_to_save(bench_,
                      {.name = "save_pose",
                       .title = tr("Save the pose"),
                       .filter = tr("Pose (*.json)"),
                       .proposal = named_after_front(bench_, "pose.json")},
                      [this](const QString& path) { savePose(path); });
  });
  connect(panel_, &CapturePanel::writeTruthRequested, this, [this] {
    ask_where_to_save(bench_,
                      {.name = "write_truth",
                       .title = tr("Write the light field with its ground truth"),
                       .filter = tr("Light field (*.h5)"),
                       .proposal = named_after_front(bench_, "truth.h5")},
                      [this](const QString& path) { writeTruth(path); });
  });
}

void CaptureController::connectFiles() {
  const auto ask_for_mesh = [this](void (CaptureController::*open)(const QString&)) {
    ask_for_file(&bench_.window,
                 {.name = "open_mesh",
                  .title = tr("Open a mesh"),
                  .filter = tr("Meshes (*.ply *.obj *.stl)")},
                 [this, open](const QString& path) { (this->*open)(path); });
  };
  connect(panel_->objects(), &CaptureObjects::openMeshRequested, this,
          [=] { ask_for_mesh(&CaptureController::openMesh); });
  connect(panel_->objects(), &CaptureObjects::addRequested, this,
          [=] { ask_for_mesh(&CaptureController::addObject); });
  connect(panel_, &CapturePanel::importRequested, this, [this] {
    ask_for_file(
        &bench_.window,
        {.name = "import_pairs", .title = tr("Import pairs"), .filter = tr("Pairs (*.csv)")},
        [this](const QString& path) { importPairs(path); });
  });
  connect(panel_, &CapturePanel::exportRequested, this, [this] {
    ask_where_to_save(bench_,
                      {.name = "export_pairs",
                       .title = tr("Export pairs"),
                       .filter = tr("Pairs (*.csv)"),
                       .proposal = named_after_front(bench_, "pairs.csv")},
                      [this](const QString& path) { exportPairs(path); });
  });
}

void CaptureController::readMesh(const QString& path, const Change& then) {
  bench_.frame.showTab("capture");
  makePanel();
  shelf_->read(path.toStdString(), [this, path, then, scene = bench_.session.generation()] {
    if (scene == bench_.session.generation()) vertex_.reset();
    if (documents_->changeOf(scene, then)) return;
    bench_.messages.warn(tr("%1 was dropped: its light field was closed meanwhile.")
                             .arg(QFileInfo(path).fileName()));
  });
}

void CaptureController::openMesh(const QString& path) {
  readMesh(path,
           [file = path.toStdString()](CaptureDocument& document) { document.set_mesh(file); });
}

void CaptureController::addObject(const QString& mesh) {
  readMesh(mesh,
           [file = mesh.toStdString()](CaptureDocument& document) { document.add_object(file); });
}

void CaptureController::importPairs(const QString& path) {
  try {
    const auto pairs = capture::read_pairs(path_of(path));
    change([&](CaptureDocument& document) { document.add_pairs(pairs); });
  } catch (const Error& error) {
    bench_.messages.fail(QString::fromUtf8(error.what()));
  }
}

void CaptureController::exportPairs(const QString& path) {
  if (!has_suffix(path, {"csv"}, bench_.messages)) return;
  write_in_background(bench_.jobs, bench_.messages, path,
                      [file = path_of(path), pairs = pairs()](const Progress&) {
                        capture::write_pairs(file, pairs);
                      });
}

void CaptureController::savePose(const QString& path) {
  results_->savePose(path);
}

void CaptureController::writeTruth(const QString& path) {
  results_->writeTruth(path);
}

void CaptureController::pickVertex(std::size_t vertex) {
  if (!mesh() || vertex >= mesh()->mesh->vertices.size()) return;
  vertex_ = vertex;
  showNext();
}

void CaptureController::addPair() {
  if (!vertex_ || !mesh() || !bench_.session.scene()) return;
  const PixelIndex pixel = bench_.session.cross_hair();
  const auto mark = snapped();
  const auto& [x, y, z] = mesh()->mesh->vertices[*vertex_];
  const capture::PointPair pair{"",
                                mark ? mark->place.x : static_cast<double>(pixel.x),
                                mark ? mark->place.y : static_cast<double>(pixel.y),
                                {x, y, z}};
  vertex_.reset();
  change([&](CaptureDocument& document) { document.add_pairs({pair}); });
}

void CaptureController::show() {
  if (!panel_) return;
  shelf_->keep(documents_->meshes());
  showRead();
}

void CaptureController::showRead() {
  if (!panel_) return;
  showMesh();
  showPairs();
  showNext();
}

void CaptureController::showMesh() {
  QStringList names;
  for (const CaptureObject& each : work().objects) names << QString::fromStdString(each.name);
  panel_->objects()->setObjects(names, work().current);
  const CaptureObject* object = work().object();
  const ReadMesh* read = mesh();
  QString text;
  if (object && !object->mesh.empty()) {
    const QString name = QFileInfo(QString::fromStdString(object->mesh)).fileName();
    const auto count = static_cast<qulonglong>(read ? read->mesh->faces.size() : 0);
    text = read ? tr("%1 · %2 faces").arg(name, QLocale::c().toString(count))
           : shelf_->isReading(object->mesh) ? tr("%1 is being read…").arg(name)
           : shelf_->isBroken(object->mesh)  ? tr("%1 cannot be read").arg(name)
                                             : tr("%1 was not read").arg(name);
  }
  panel_->objects()->setMesh(text);
  const void* shown = read ? read->mesh.get() : nullptr;
  if (std::exchange(shown_mesh_, shown) == shown) return;
  vertex_.reset();
  panel_->setMesh(read ? read->cloud : std::make_shared<const CloudParts>());
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
  if (mesh() && vertex_) {
    const auto& [x, y, z] = mesh()->mesh->vertices[*vertex_];
    point = {x, y, z};
  }
  const QString elsewhere = bench_.session.scene() ? tr("go to the center view (Home)") : QString();
  panel_->setPicked(point ? std::optional(in_mesh_view({(*point)[0], (*point)[1], (*point)[2]}))
                          : std::nullopt);
  panel_->setNext(is_here ? nextText() : elsewhere, point, is_here && point);
}

void CaptureController::showPairs() {
  const History<CaptureEdit>& history = documents_->now().history();
  panel_->setRows(pair_rows(pairs(), pose()));
  panel_->setUndoable(history.next_undo() != nullptr);
  panel_->setRedoable(history.next_redo() != nullptr);
  panel_->setPose(pose_text(bench_.session, *documents_), pose() && mesh());
  showMarks();
}

void CaptureController::showMarks() {
  if (!panel_) return;
  const Session& session = bench_.session;
  PairMarks marks;
  if (session.scene()) {
    marks = pair_marks(pairs(), pose() ? &pose()->pose : nullptr,
                       session.light_field()->info().camera.pinhole,
                       [this](int row) { return panel_->isEmphasised(row); });
  }
  const bool is_here = session.scene() && session.view() == session.light_field()->center();
  if (!is_here || !tab_->isVisible()) marks.on_view.clear();
  if (!mesh()) marks.on_mesh.clear();
  bench_.viewer_area.canvas()->setMarks(std::move(marks.on_view));
  panel_->setMarks(marks.on_mesh);
}

bool CaptureController::hearKey(const QKeyEvent& event) {
  const QKeySequence key(event.keyCombination());
  const bool is_undo = bench_.commands.keys("annotate.undo").contains(key);
  if (!is_undo && !bench_.commands.keys("annotate.redo").contains(key)) return false;
  if (!panel_ || !tab_->isVisible() || bench_.commands.find("annotate.mode")->isChecked()) {
    return false;
  }
  if (event.type() == QEvent::KeyPress) {
    change(is_undo ? &CaptureDocument::undo : &CaptureDocument::redo);
  }
  return true;
}

bool CaptureController::eventFilter(QObject* watched, QEvent* event) {
  const QEvent::Type type = event->type();
  if (watched == tab_ && (type == QEvent::Show || type == QEvent::Hide)) showMarks();
  const bool is_key = type == QEvent::ShortcutOverride || type == QEvent::KeyPress;
  if (is_key && hearKey(*static_cast<QKeyEvent*>(event))) {
    event->accept();  // else the undo of labels takes it
    return true;
  }
  return QObject::eventFilter(watched, event);
}

std::optional<capture::SnappedPick> PickSnapper::snap(const LightFieldPtr& light_field,
                                                      PixelIndex pixel) {
  if (light_field_.lock() != light_field) {
    grey_ = capture::gray_view(*light_field, light_field->center());
    light_field_ = light_field;
  }
  return capture::snap_pick(
      grey_.view(), {static_cast<double>(pixel.x), static_cast<double>(pixel.y)}, kReach_px);
}

}  // namespace episcope

#include "moc_capture_controller.cpp"

#include "capture_controller.moc"
