// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/capture/photographs.h"

#include "app/gui/capture/capture_files.h"
#include "app/gui/capture/form_question.h"
#include "app/gui/frame/dialogs.h"
#include "app/gui/frame/jobs.h"
#include "app/gui/frame/messages.h"
#include "app/gui/opening/scene_opener.h"
#include "app/session/session.h"
#include "engine/capture/demo/demo_folder.h"
#include "engine/core/error.h"
#include "widgets/capture/photograph_steps.h"
#include "widgets/style/number_text.h"

#include <QDir>
#include <QFileInfo>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace episcope {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> paths_of(const QStringList& names) {
  std::vector<fs::path> paths;
  for (const QString& name : names) paths.push_back(path_of(name));
  return paths;
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

// A folder that is not there yet.
fs::path new_folder(const QString& parent) {
  const QString name = QDir(parent).filePath("gantry_demo");
  QString free = name;
  for (int i = 2; QFileInfo::exists(free); ++i) free = QString("%1_%2").arg(name).arg(i);
  return path_of(free);
}

QString details_of(const capture::Calibration& calibration) {
  QStringList lines;
  for (const capture::PatternPhotograph& each : calibration.photographs) {
    const QString name = QFileInfo(QString::fromStdString(each.name)).fileName();
    lines << (each.is_used() ? Photographs::tr("%1: %2 px").arg(name).arg(each.rms, 0, 'f', 3)
                             : Photographs::tr("%1: left out, %2")
                                   .arg(name, QString::fromStdString(each.problem)));
  }
  return lines.join('\n');
}

QString alignment_text(const capture::Rectified& rectified) {
  return Photographs::tr("Rows aligned to %1 px (before %2 px)")
      .arg(rectified.after.percentile_95, 0, 'f', 2)
      .arg(rectified.before.percentile_95, 0, 'f', 2);
}

}  // namespace

Photographs::Photographs(const Workbench& bench,
                         std::function<std::vector<capture::PointPair>()> picks, QObject* parent)
    : QObject(parent), bench_(bench), picks_(std::move(picks)) {
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
    ask_where_to_save(&bench_.window,
                      {.name = "save_camera",
                       .title = tr("Save the camera"),
                       .filter = tr("Camera (*.yml)"),
                       .proposal = "camera.yml"},
                      [this](const QString& path) { saveCamera(path); });
  });
  connect(steps, &PhotographSteps::demoRequested, this, [this] {
    ask_for_folder(&bench_.window,
                   {.name = "make_demo", .title = tr("Where to put the folder of the demo")},
                   [this](const QString& folder) { makeDemo(folder); });
  });
  show();
}

void Photographs::askForPattern() {
  const auto photographs = [this](const ParameterSet& values) {
    pattern_ = capture::pattern_schema().parse(values);
    ask_for_files(&bench_.window,
                  {.name = "calibrate",
                   .title = tr("Photographs of the pattern"),
                   .filter = tr("Images (*.png *.jpg *.jpeg *.tif *.tiff *.bmp);;All files (*)")},
                  [this](const QStringList& paths) { calibrate(paths, pattern_); });
  };
  ask_for_values(&bench_.window,
                 {.name = "pattern",
                  .title = tr("The pattern that was photographed"),
                  .accept = tr("Photographs…"),
                  .parameters = capture::pattern_schema().descriptions(),
                  .values = capture::pattern_schema().values(pattern_)},
                 photographs);
}

void Photographs::askForRectified() {
  const auto save = [this](const ParameterSet& values) {
    options_ = capture::rectify_schema().parse(values);
    ask_where_to_save(&bench_.window,
                      {.name = "save_rectified",
                       .title = tr("Save the rectified light field"),
                       .filter = tr("Light field (*.h5)"),
                       .proposal = "rectified.h5",
                       .confirms_overwrite = false},
                      [this](const QString& path) { rectify(path, options_); });
  };
  ask_for_values(&bench_.window,
                 {.name = "rectify",
                  .title = tr("Rectify the photographs"),
                  .accept = tr("Save as…"),
                  .parameters = capture::rectify_schema().descriptions(),
                  .values = capture::rectify_schema().values(options_)},
                 save);
}

void Photographs::calibrate(const QStringList& photographs, const capture::Pattern& pattern) {
  bench_.jobs.start<capture::Calibration>(
      Lane::Load, tr("Calibrating the lens"),
      [files = paths_of(photographs), pattern](const Progress& progress) {
        return capture::calibrate(files, pattern, progress);
      },
      [this](const capture::Calibration& calibration) { take(calibration); });
}

void Photographs::calibrateGantry(const GantryFolder& demo) {
  pattern_ = capture::demo_pattern();
  options_.step = capture::DemoRig().step;
  QStringList files;
  for (const fs::path& each : demo.pattern()) files << QString::fromStdString(each.string());
  calibrate(files, pattern_);
  bench_.messages.hint(
      tr("These are photographs of a gantry, with points picked. "
         "Rectify them to find the pose of the mesh."));
}

void Photographs::take(const capture::Calibration& calibration) {
  const auto& all = calibration.photographs;
  const auto used = std::ranges::count_if(all, &capture::PatternPhotograph::is_used);
  take(calibration.camera,
       tr("%1 of %2 photographs used").arg(used).arg(all.size()) + '\n' + details_of(calibration));
  if (used < std::ssize(all)) {
    bench_.messages.warn(tr("%1 of %2 photographs of the pattern were left out; the tool tip of "
                            "“Lens” tells why.")
                             .arg(std::ssize(all) - used)
                             .arg(all.size()));
  }
}

void Photographs::take(const capture::LensCamera& camera, const QString& details) {
  camera_ = camera;
  camera_details_ = details;
  show();
}

void Photographs::openCamera(const QString& path) {
  try {
    take(capture::read_camera(path_of(path)), path);
  } catch (const Error& error) {
    bench_.messages.fail(QString::fromUtf8(error.what()));
  }
}

void Photographs::saveCamera(const QString& path) {
  if (!camera_ || !has_suffix(path, {"yml", "yaml"}, bench_.messages)) return;
  write_in_background(bench_.jobs, bench_.messages, path,
                      [file = path_of(path), camera = *camera_](const Progress&) {
                        capture::write_camera(file, camera);
                      });
}

void Photographs::rectify(const QString& path, const capture::RectifyOptions& options) {
  if (!canRectify() || !is_new_light_field(path, bench_.messages)) return;
  const RectifyTask task{*bench_.session.scene(), *camera_, options, path_of(path), picks_()};
  bench_.jobs.start<RectifiedFile>(
      Lane::Load, tr("Rectifying"),
      [task](const Progress& progress) { return rectify_to_file(task, progress); },
      [this, path](const RectifiedFile& made) {
        bench_.opener.open(path, [this, text = alignment_text(made.rectified), pairs = made.pairs] {
          alignments_[bench_.session.generation()] = text;
          show();
          emit rectified(pairs);
        });
      });
}

void Photographs::makeDemo(const QString& folder, const capture::DemoOptions& options) {
  const fs::path made = new_folder(folder);
  bench_.jobs.start<capture::Calibration>(
      Lane::Load, tr("Making the demo"),
      [made, options](const Progress& progress) {
        capture::write_demo_folder(made, options, progress.part(0, 0.8));
        return capture::calibrate(files_in(made / "pattern"), capture::demo_pattern(),
                                  progress.part(0.8, 1));
      },
      [this, made](const capture::Calibration& calibration) {
        take(calibration);
        pattern_ = capture::demo_pattern();
        options_.step = capture::DemoRig().step;
        const auto file = [&](const char* name) {
          return QString::fromStdString((made / name).string());
        };
        bench_.opener.open(file("photographs"),
                           [this, mesh = file("mesh.ply"), picks = file("picks.csv")] {
                             emit demoOpened(mesh, picks);
                             bench_.messages.hint(
                                 tr("These are photographs of a gantry, with points picked. "
                                    "Rectify them to find the pose of the mesh."));
                           });
      });
}

bool Photographs::canRectify() const {
  return camera_ && bench_.session.scene() && !bench_.session.light_field()->info().camera.pinhole;
}

void Photographs::show() {
  if (!steps_) return;
  QString lens;
  if (camera_) {
    lens = tr("Lens: focal length %1 px, error %2 px")
               .arg(camera_->focal_x, 0, 'f', 0)
               .arg(camera_->rms, 0, 'f', 2);
  }
  steps_->setCamera(lens, camera_details_, camera_.has_value());
  QString text = tr("Open the folder of photographs.");
  if (bench_.session.scene()) {
    const auto made = alignments_.find(bench_.session.generation());
    const bool is_rectified = bench_.session.light_field()->info().camera.pinhole.has_value();
    text = is_rectified ? tr("The light field tells its lens; it is rectified.")
           : camera_    ? tr("Photographs of a gantry are rectified next.")
                        : tr("Photographs of a gantry need the lens first.");
    if (made != alignments_.end()) text = made->second;
  }
  steps_->setAlignment(text, canRectify());
}

}  // namespace episcope

#include "moc_photographs.cpp"
