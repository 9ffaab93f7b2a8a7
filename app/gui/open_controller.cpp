// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/open_controller.h"

#include "app/gui/queued_post.h"
#include "app/session/load_scene.h"
#include "app/session/run_estimator.h"
#include "engine/io/result_file.h"
#include "engine/render/shade.h"
#include "widgets/picture.h"
#include "widgets/view_canvas.h"

#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QMimeData>
#include <QSettings>
#include <QUrl>

#include <utility>

namespace episcope {
namespace {

constexpr const char* kRecentKey = "recent";
constexpr int kMostRecent = 10;

QString short_name(const QString& input) {
  const QString name = QFileInfo(input).fileName();
  return name.isEmpty() ? input : name;
}

bool is_builtin(const QString& input) {
  return !builtin_scene_id(input.toStdString()).empty();
}

// Paths are kept absolute, so that they open from any working folder.
QString absolute(const QString& input) {
  return is_builtin(input) ? input : QFileInfo(input).absoluteFilePath();
}

bool is_result(const QString& path) {
  const QString suffix = QFileInfo(path).suffix().toLower();
  if (suffix == "pfm" || suffix == "tif" || suffix == "tiff") return QFileInfo(path).isFile();
  return suffix == "h5" && io::is_result_file(path.toStdString());
}

Image<std::uint8_t> rgba_of(const Image<std::uint8_t>& center) {
  constexpr int rgba = 4;
  Image<std::uint8_t> picture(center.height(), center.width(), rgba, 255);
  for (int y = 0; y < center.height(); ++y) {
    for (int x = 0; x < center.width(); ++x) {
      for (int c = 0; c < 3; ++c) {
        picture.at(y, x, c) = center.at(y, x, center.channels() == 3 ? c : 0);
      }
    }
  }
  return picture;
}

}  // namespace

OpenController::OpenController(Session& session, Jobs& jobs, BrowseController& browse,
                               const Panels& panels, QObject* parent)
    : QObject(parent),
      session_(session),
      jobs_(jobs),
      browse_(browse),
      panels_(panels),
      cache_folder_(default_cache_folder()) {
  connect(&jobs_, &Jobs::progressed, this,
          [this](quint64 job, double fraction) { showLoading(job, fraction); });
  connect(&jobs_, &Jobs::failed, this, [this](const QString& sentence) {
    if (!session_.scene()) last_failure_ = sentence;
  });
}

void OpenController::open(const QString& input_as_given, std::function<void()> opened) {
  const QString input = absolute(input_as_given);
  jobs_.cancelLane(Lane::Load);
  const quint64 load = ++load_;
  LoadOptions options;
  options.cache_folder = cache_folder_;
  options.open.on_center_view = [this, load, post = queued_post(this)](
                                    const Image<std::uint8_t>& center, const LightFieldInfo& info,
                                    GridShape) {
    auto picture = std::make_shared<Image<std::uint8_t>>(rgba_of(center));
    post([this, load, picture, name = QString::fromStdString(info.name)] {
      if (load != load_ || loading_job_ == 0) return;
      browse_.showPreview(to_qimage(std::move(*picture)), tr("%1 · reading all views …").arg(name));
      emit previewing(true);
    });
  };
  beginLoading(short_name(input));
  using ScenePtr = std::shared_ptr<const Scene>;
  loading_job_ = jobs_.start<ScenePtr>(
      Lane::Load, tr("Opening %1").arg(loading_name_),
      [path = input.toStdString(), options](const Progress& progress) {
        return std::make_shared<const Scene>(load_scene(path, options, progress));
      },
      [this, input, load, opened = std::move(opened)](const ScenePtr& scene) {
        if (load != load_) return;
        finishOpening(input, scene);
        if (opened) opened();
      },
      [this, load] { endLoading(load); });
}

void OpenController::beginLoading(const QString& name) {
  loading_name_ = name;
  last_failure_.clear();
  if (!session_.scene()) panels_.canvas->showLoading(name, -1);
}

void OpenController::showLoading(quint64 job, double fraction) {
  if (job != loading_job_ || session_.scene() || browse_.isPreviewing()) return;
  panels_.canvas->showLoading(loading_name_, fraction);
}

void OpenController::finishOpening(const QString& input, std::shared_ptr<const Scene> scene) {
  jobs_.cancelLane(Lane::Estimate);  // they belong to the former light field
  session_.open(std::move(scene), input.toStdString());
  emit titleChanged(QString::fromStdString(session_.light_field()->info().name));
  if (is_builtin(input)) {
    keepBuiltin(input);
  } else {
    remember(input);
  }
}

void OpenController::endLoading(quint64 load) {
  if (load != load_) return;
  loading_job_ = 0;
  const bool was_previewing = browse_.isPreviewing();
  browse_.endPreview();
  if (was_previewing) emit previewing(false);
  if (session_.scene()) return;
  if (last_failure_.isEmpty()) {
    panels_.canvas->showEmpty(
        tr("Open a light field with Ctrl+O, or drop a file or a folder here."));
  } else {
    panels_.canvas->showError(last_failure_);
  }
}

void OpenController::keepBuiltin(const QString& input) {
  jobs_.start<bool>(
      Lane::Export, tr("Keeping the built-in scene for the next start"),
      [scene = session_.scene(), input = input.toStdString(),
       folder = cache_folder_](const Progress& progress) {
        store_in_cache(input, *scene, folder, progress);
        return true;
      },
      [](bool) {});
}

void OpenController::openResult(const QString& path) {
  const LightFieldPtr light_field = session_.light_field();
  if (!light_field) {
    open(path);  // says what is wrong with it
    return;
  }
  const std::uint64_t generation = session_.generation();
  jobs_.start<FinishedEstimate>(
      Lane::Load, tr("Opening %1").arg(short_name(path)),
      [light_field, path = path.toStdString()](const Progress& progress) {
        Estimate estimate = io::read_result(path, light_field->grid(), light_field->info().name);
        progress.check();
        check_fits(estimate, *light_field, path);
        const Interval range = display_range(estimate);
        return FinishedEstimate{std::make_shared<const Estimate>(std::move(estimate)), range};
      },
      [this, generation](const FinishedEstimate& read) {
        session_.add_estimate(read.estimate, read.display_range, generation);
      });
}

void OpenController::openFileDialog() {
  auto* dialog = new QFileDialog(
      panels_.viewer->window(), tr("Open a light field"), QString(),
      tr("Light fields and results (*.h5 *.hdf5 *.pfm *.tif *.tiff);;All files (*)"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFile);
  connect(dialog, &QFileDialog::fileSelected, this,
          [this](const QString& path) { is_result(path) ? openResult(path) : open(path); });
  dialog->open();
}

void OpenController::openFolderDialog() {
  auto* dialog =
      new QFileDialog(panels_.viewer->window(), tr("Open a folder that holds a light field"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::Directory);
  dialog->setOption(QFileDialog::ShowDirsOnly);
  connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& path) { open(path); });
  dialog->open();
}

void OpenController::openResultDialog() {
  auto* dialog = new QFileDialog(panels_.viewer->window(), tr("Open a result"), QString(),
                                 tr("Results (*.h5 *.hdf5 *.pfm *.tif *.tiff);;All files (*)"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFile);
  connect(dialog, &QFileDialog::fileSelected, this, &OpenController::openResult);
  dialog->open();
}

void OpenController::closeScene() {
  jobs_.cancelLane(Lane::Load);
  jobs_.cancelLane(Lane::Estimate);
  ++load_;
  loading_job_ = 0;
  session_.close();
  emit titleChanged({});
}

QStringList OpenController::recentInputs() const {
  return QSettings().value(kRecentKey).toStringList();
}

void OpenController::forgetRecentInputs() {
  QSettings().remove(kRecentKey);
  emit recentInputsChanged();
}

void OpenController::remember(const QString& input) {
  QStringList recent = recentInputs();
  recent.removeAll(input);
  recent.prepend(input);
  QSettings().setValue(kRecentKey, recent.mid(0, kMostRecent));
  emit recentInputsChanged();
}

bool OpenController::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::DragEnter || event->type() == QEvent::Drop) {
    auto* drop = static_cast<QDropEvent*>(event);
    const QList<QUrl> urls = drop->mimeData()->urls();
    if (urls.isEmpty() || !urls.front().isLocalFile()) return false;
    drop->acceptProposedAction();
    if (event->type() == QEvent::Drop) {
      const QString path = urls.front().toLocalFile();
      is_result(path) && session_.scene() ? openResult(path) : open(path);
    }
    return true;
  }
  return QObject::eventFilter(watched, event);
}

}  // namespace episcope
