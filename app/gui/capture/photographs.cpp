// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/capture/photographs.h"

#include "app/gui/scene/scene_opener.h"
#include "app/gui/shell/dialogs.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/session/session.h"
#include "engine/core/error.h"
#include "engine/core/parameter.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/parameter_form.h"

#include <QCoreApplication>
#include <QDialog>
#include <QDialogButtonBox>
#include <QDir>
#include <QFileInfo>
#include <QPushButton>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <utility>

class QWidget;

namespace episcope {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> paths_of(const QStringList& names) {
  std::vector<fs::path> paths;
  for (const QString& name : names) paths.push_back(path_of(name));
  return paths;
}

// Path of a folder that does not exist yet.
fs::path new_folder(const QString& parent) {
  const QString name = QDir(parent).filePath("gantry_demo");
  QString free = name;
  for (int i = 2; QFileInfo::exists(free); ++i) free = QString("%1_%2").arg(name).arg(i);
  return path_of(free);
}

// Tool tip of the lens.
QString details_of(const CaptureLens& lens) {
  if (!lens.file.empty()) return QString::fromStdString(lens.file);
  const auto used = std::ranges::count_if(
      lens.photographs, [](const CalibratedPhotograph& each) { return each.problem.empty(); });
  QStringList lines{
      Photographs::tr("%1 of %2 photographs used").arg(used).arg(lens.photographs.size())};
  for (const CalibratedPhotograph& each : lens.photographs) {
    const QString name = QString::fromStdString(each.name);
    lines << (each.problem.empty() ? Photographs::tr("%1: %2 px").arg(name).arg(each.rms, 0, 'f', 3)
                                   : Photographs::tr("%1: left out, %2")
                                         .arg(name, QString::fromStdString(each.problem)));
  }
  return lines.join('\n');
}

QString alignment_text(const RowAlignment& rows) {
  return Photographs::tr("Rows aligned to %1 px (before %2 px)")
      .arg(rows.after.percentile_95, 0, 'f', 2)
      .arg(rows.before.percentile_95, 0, 'f', 2);
}

// Initial work of the demo, without the lens.
CaptureWork work_of(const GantryFolder& demo) {
  CaptureWork work;
  work.pattern = capture::demo_pattern();
  work.rectify.step = capture::DemoRig().step;
  work.objects.push_back({.name = demo.mesh().stem().string(),
                          .mesh = demo.mesh().string(),
                          .pairs = capture::read_pairs(demo.picks())});
  return work;
}

}  // namespace

void ask_for_values(QWidget* window, const FormQuestion& question,
                    std::function<void(const ParameterSet&)> answer) {
  auto* dialog = named(question.name, new QDialog(window));
  dialog->setWindowTitle(question.title);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  auto* form = new ParameterForm(dialog);
  form->setParameters(question.parameters);
  form->setValues(question.values);
  auto* answers = make_answers(dialog, question.name + ".accept", question.accept);
  make_column(dialog, {form, answers}, {.margins = kStyleMargins});
  QObject::connect(dialog, &QDialog::accepted, window,
                   [form, answer = std::move(answer)] { answer(form->values()); });
  dialog->open();
}

Photographs::Photographs(const Workbench& bench, CaptureDocuments& documents, QObject* parent)
    : QObject(parent), bench_(bench), documents_(documents) {
  connect(&documents, &CaptureDocuments::changed, this, &Photographs::show);
  bench_.session.on_changed([this](Parts parts) {
    if (parts.has(Part::Scene)) show();
  });
}

void Photographs::attach(PhotographSteps* steps) {
  steps_ = steps;
  connect(steps, &PhotographSteps::calibrateRequested, this, &Photographs::askForPattern);
  connect(steps, &PhotographSteps::rectifyRequested, this, &Photographs::askForRectified);
  connect(steps, &PhotographSteps::openCameraRequested, this, [this] {
    ask_for_file(&bench_.window,
                 {.name = "open_camera",
                  .title = tr("Open a camera"),
                  .filter = tr("Camera (*.yml *.yaml)")},
                 [this](const QString& path) { openCamera(path); });
  });
  connect(steps, &PhotographSteps::saveCameraRequested, this, [this] {
    ask_where_to_save(bench_,
                      {.name = "save_camera",
                       .title = tr("Save the camera"),
                       .filter = tr("Camera (*.yml)"),
                       .proposal = named_after_front(bench_, "camera.yml")},
                      [this](const QString& path) { saveCamera(path); });
  });
  connect(steps, &PhotographSteps::demoRequested, this, [this] {
    ask_for_folder(&bench_.window,
                   {.name = "make_demo", .title = tr("Folder in which to create the demo")},
                   [this](const QString& folder) { makeDemo(folder); });
  });
  show();
}

void Photographs::askForPattern() {
  const auto photographs = [this](const ParameterSet& values) {
    const capture::Pattern pattern = capture::pattern_schema().parse(values);
    ask_for_files(&bench_.window,
                  {.name = "calibrate",
                   .title = tr("Photographs of the pattern"),
                   .filter = tr("Images (*.png *.jpg *.jpeg *.tif *.tiff *.bmp);;All files (*)")},
                  [this, pattern](const QStringList& paths) { calibrate(paths, pattern); });
  };
  ask_for_values(&bench_.window,
                 {.name = "pattern",
                  .title = tr("The pattern that was photographed"),
                  .accept = tr("Photographs…"),
                  .parameters = capture::pattern_schema().descriptions(),
                  .values = capture::pattern_schema().values(documents_.now().work().pattern)},
                 photographs);
}

void Photographs::askForRectified() {
  const auto save = [this](const ParameterSet& values) {
    documents_.change([&](CaptureDocument& document) {
      document.set_rectify(capture::rectify_schema().parse(values));
    });
    ask_where_to_save(bench_,
                      {.name = "save_rectified",
                       .title = tr("Save the rectified light field"),
                       .filter = tr("Light field (*.h5)"),
                       .proposal = named_after_front(bench_, "rectified.h5"),
                       .confirms_overwrite = false},
                      [this](const QString& path) { rectify(path); });
  };
  ask_for_values(&bench_.window,
                 {.name = "rectify",
                  .title = tr("Rectify the photographs"),
                  .accept = tr("Save as…"),
                  .parameters = capture::rectify_schema().descriptions(),
                  .values = capture::rectify_schema().values(documents_.now().work().rectify)},
                 save);
}

void Photographs::calibrate(const QStringList& photographs, const capture::Pattern& pattern) {
  bench_.jobs.start<capture::Calibration>(
      Lane::Capture, tr("Calibrating the lens"),
      [files = paths_of(photographs), pattern](const Progress& progress) {
        return capture::calibrate(files, pattern, progress);
      },
      [this, pattern, scene = bench_.session.generation()](
          const capture::Calibration& calibration) { take(calibration, pattern, scene); });
}

void Photographs::beginGantry(const GantryFolder& demo) {
  try {
    documents_.begin(work_of(demo));
  } catch (const Error& error) {
    bench_.messages.fail(QString::fromUtf8(error.what()));
  }
  QStringList files;
  for (const fs::path& each : demo.pattern()) files << QString::fromStdString(each.string());
  calibrate(files, capture::demo_pattern());
  bench_.messages.hint(
      tr("These are photographs of a gantry, with points picked. "
         "Rectify them to find the pose of the mesh."));
}

void Photographs::take(const capture::Calibration& calibration, const capture::Pattern& pattern,
                       std::uint64_t scene) {
  const auto set = [&](CaptureDocument& document) {
    document.set_lens(lens_of(calibration), pattern);
  };
  if (!documents_.changeOf(scene, set)) {
    bench_.messages.warn(tr("The lens was dropped: its light field was closed meanwhile."));
    return;
  }
  const auto& all = calibration.photographs;
  const auto used = std::ranges::count_if(all, &capture::PatternPhotograph::is_used);
  if (used < std::ssize(all)) {
    bench_.messages.warn(tr("%1 of %2 photographs of the pattern were left out; the tool tip of "
                            "“Lens” tells why.")
                             .arg(std::ssize(all) - used)
                             .arg(all.size()));
  }
}

void Photographs::openCamera(const QString& path) {
  try {
    const CaptureLens lens{.camera = capture::read_camera(path_of(path)),
                           .file = path.toStdString()};
    documents_.change(
        [&](CaptureDocument& document) { document.set_lens(lens, document.work().pattern); });
  } catch (const Error& error) {
    bench_.messages.fail(QString::fromUtf8(error.what()));
  }
}

void Photographs::saveCamera(const QString& path) {
  const auto& lens = documents_.now().work().lens;
  if (!lens || !has_suffix(path, {"yml", "yaml"}, bench_.messages)) return;
  write_in_background(bench_.jobs, bench_.messages, path,
                      [file = path_of(path), camera = lens->camera](const Progress&) {
                        capture::write_camera(file, camera);
                      });
}

void Photographs::rectify(const QString& path) {
  if (!canRectify() || !is_new_light_field(path, bench_.messages)) return;
  const RectifyTask task{*bench_.session.scene(), documents_.now().work(), path_of(path)};
  const quint64 job = bench_.jobs.start<CaptureWork>(
      Lane::Capture, job_title(tr("Rectifying"), bench_.session),
      [task](const Progress& progress) { return rectify_to_file(task, progress).work; },
      [this, path](const CaptureWork& work) {
        bench_.opener.open(path, [this, work] { documents_.begin(work); });
      });
  bench_.jobs.setScene(job, bench_.session.generation());
}

void Photographs::makeDemo(const QString& folder, const capture::DemoOptions& options) {
  const GantryFolder demo{new_folder(folder)};
  bench_.jobs.start<bool>(
      Lane::Capture, tr("Making the demo"),
      [demo, options](const Progress& progress) {
        capture::write_demo_folder(demo.path, options, progress);
        return true;
      },
      [this, demo](bool) {
        bench_.opener.open(QString::fromStdString(demo.photographs().string()),
                           [this, demo] { beginGantry(demo); });
      });
}

bool Photographs::canRectify() const {
  return documents_.now().work().lens && bench_.session.scene() &&
         !bench_.session.light_field()->info().camera.pinhole;
}

void Photographs::show() {
  if (!steps_) return;
  const CaptureWork& work = documents_.now().work();
  QString lens;
  if (work.lens) {
    lens = tr("Lens: focal length %1 px, error %2 px")
               .arg(work.lens->camera.focal_x, 0, 'f', 0)
               .arg(work.lens->camera.rms, 0, 'f', 2);
  }
  steps_->setCamera(lens, work.lens ? details_of(*work.lens) : QString(), work.lens.has_value());
  QString text = tr("Open the folder of photographs.");
  if (bench_.session.scene()) {
    const bool is_rectified = bench_.session.light_field()->info().camera.pinhole.has_value();
    text = is_rectified ? tr("The light field tells its lens; it is rectified.")
           : work.lens  ? tr("Photographs of a gantry are rectified next.")
                        : tr("Photographs of a gantry need the lens first.");
    if (work.rows) text = alignment_text(*work.rows);
  }
  steps_->setAlignment(text, canRectify());
}

CaptureDocuments::CaptureDocuments(const Workbench& bench, QObject* parent)
    : QObject(parent), bench_(bench) {
  documents_[0];
  follow();
  bench.session.on_changed([this](Parts parts) {
    if (parts.has(Part::Scene)) follow();
    if (!parts.has(Part::Scenes)) return;
    std::erase_if(documents_, [this](const auto& each) {
      return each.first != 0 && each.first != scene_ && !bench_.session.find_scene(each.first);
    });
  });
}

std::set<std::string> CaptureDocuments::meshes() const {
  std::set<std::string> files;
  for (const auto& [scene, document] : documents_) {
    for (const CaptureObject& object : document.work().objects) files.insert(object.mesh);
  }
  return files;
}

CaptureWork CaptureDocuments::firstWork() const {
  CaptureWork work = bench_.session.place().capture;
  if (!work.empty()) return work;
  const CaptureWork& former = now().work();
  if (scene_ == 0) return former;
  if (bench_.session.scene() && !bench_.session.light_field()->info().camera.pinhole) {
    work.lens = former.lens;
    work.pattern = former.pattern;
    work.rectify = former.rectify;
  }
  return work;
}

void CaptureDocuments::follow() {
  const std::uint64_t scene = bench_.session.generation();
  if (scene == scene_) return;
  if (!documents_.contains(scene)) documents_.emplace(scene, CaptureDocument(firstWork()));
  if (scene_ == 0) documents_[0] = CaptureDocument();
  if (shows_none_) heir_ = {scene_, scene};
  shows_none_ = !bench_.session.scene();
  scene_ = scene;
  settle();
}

void CaptureDocuments::change(const std::function<void(CaptureDocument&)>& change) {
  follow();
  change(documents_[scene_]);
  settle();
}

bool CaptureDocuments::changeOf(std::uint64_t scene,
                                const std::function<void(CaptureDocument&)>& change) {
  follow();
  const std::uint64_t id = scene == heir_.none ? heir_.next : scene;
  if (id == scene_) {
    this->change(change);
    return true;
  }
  const auto found = documents_.find(id);
  if (found == documents_.end() || !bench_.session.find_scene(id)) return false;
  change(found->second);  // its pose is solved when it is shown again
  bench_.session.set_capture(id, found->second.work());
  emit changed();
  return true;
}

void CaptureDocuments::begin(CaptureWork work) {
  follow();
  documents_[scene_] = CaptureDocument(std::move(work));
  settle();
}

void CaptureDocuments::settle() {
  const LightFieldPtr field = bench_.session.light_field();
  CaptureDocument& document = documents_[scene_];
  problem_ = QString::fromStdString(document.solve(field ? field->info().camera : CameraGrid()));
  bench_.session.set_capture(document.work());
  emit changed();
}

namespace {

struct CaptureFilesText {
  Q_DECLARE_TR_FUNCTIONS(episcope::CaptureFiles)
};

}  // namespace

bool is_new_light_field(const QString& path, Messages& messages) {
  if (!has_suffix(path, {"h5"}, messages)) return false;
  if (!std::filesystem::exists(path_of(path))) return true;
  messages.fail(
      CaptureFilesText::tr("%1 exists already; name a new file, so that no light field is lost")
          .arg(path));
  return false;
}

namespace {

constexpr std::size_t kMovingFaces = 60'000;

// A canvas counts from the corner of a pixel.
QPointF on_canvas(double x_px, double y_px) {
  return {x_px + 0.5, y_px + 0.5};
}

}  // namespace

CloudPartsPtr mesh_parts(const capture::TriangleMesh& mesh) {
  CloudPart part{make_mesh_cloud(mesh.vertices, mesh.faces), {}};
  if (mesh.faces.size() > kMovingFaces) {
    const capture::TriangleMesh coarse = capture::cluster_vertices(mesh, kMovingFaces);
    part.few = make_mesh_cloud(coarse.vertices, coarse.faces);
  }
  auto parts = std::make_shared<CloudParts>();
  parts->push_back(std::move(part));
  return parts;
}

std::array<double, 3> in_mesh_view(const capture::Point3& point) {
  return {point.x, -point.y, -point.z};
}

std::vector<CaptureRow> pair_rows(const std::vector<capture::PointPair>& pairs,
                                  const std::optional<capture::SolvedPose>& pose) {
  std::vector<CaptureRow> rows;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const capture::PointPair& pair = pairs[i];
    CaptureRow row{.name = QString::fromStdString(pair.name),
                   .pixel = {pair.x_px, pair.y_px},
                   .point = {pair.point.x, pair.point.y, pair.point.z},
                   .off_px = {},
                   .is_locked = pair.is_locked};
    if (pose) {
      row.off_px = pose->pairs[i].residual_px;
      row.is_outlier = pose->pairs[i].is_outlier;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

PairMarks pair_marks(const std::vector<capture::PointPair>& pairs, const capture::RigidPose* pose,
                     const std::optional<Pinhole>& pinhole,
                     const std::function<bool(int)>& is_emphasised) {
  PairMarks marks;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const capture::PointPair& pair = pairs[i];
    const bool is_strong = is_emphasised(static_cast<int>(i));
    CanvasMark mark{
        on_canvas(pair.x_px, pair.y_px), {}, QString::fromStdString(pair.name), is_strong};
    if (pose && pinhole) {
      const auto [dx, dy] = capture::reprojection_residual(pair, *pose, *pinhole);
      if (std::isfinite(dx)) mark.wanted = on_canvas(pair.x_px + dx, pair.y_px + dy);
    }
    marks.on_view.push_back(std::move(mark));
    marks.on_mesh.push_back({in_mesh_view(pair.point), pair.name, is_strong});
  }
  return marks;
}

}  // namespace episcope

#include "moc_photographs.cpp"
