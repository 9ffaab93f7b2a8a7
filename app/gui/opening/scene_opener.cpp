// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/opening/scene_opener.h"

#include "app/gui/files/conventions_dialog.h"
#include "app/gui/frame/queued_post.h"
#include "app/gui/opening/remembered_conventions.h"
#include "app/session/run/read_result.h"
#include "app/session/run/result_reading.h"
#include "app/session/run/run_estimator.h"
#include "app/session/scene/load_scene.h"
#include "app/session/scene/scene_range.h"
#include "engine/core/error.h"
#include "engine/io/open/reader.h"
#include "engine/render/shade.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/style/picture.h"

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
  try {
    return names_result(path.toStdString());
  } catch (const std::exception&) {
    return false;  // opening it will tell what is wrong
  }
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

struct ReadEstimate : FinishedEstimate {
  bool is_of_others = false;
  std::string differing_options;
};

ReadEstimate read_estimate(const LightField& light_field, const std::string& path,
                           const Progress& progress) {
  auto estimate = std::make_shared<Estimate>(read_result_of(light_field, path));
  progress.check();
  check_fits(*estimate, light_field, path);
  const bool is_of_others = is_of_other_samples(*estimate, light_field);
  const bool is_moved = estimate->reading.focus_px() != light_field.info().reading.focus_px();
  bring_to_focus(*estimate, light_field, progress);
  const Interval range = display_range(*estimate);
  std::string options = differing_options(*estimate, light_field);
  return {{std::move(estimate), range}, is_of_others && !is_moved, std::move(options)};
}

using ScenePtr = std::shared_ptr<const Scene>;

ScenePtr read_as_told(const std::string& input, const LoadOptions& options,
                      const Progress& progress) {
  return std::make_shared<const Scene>(load_scene(input, options, progress));
}

// Conventions that no longer fit the file are told and not used.
ScenePtr read_as_remembered(const std::string& input, const LoadOptions& options,
                            const Progress& progress) {
  if (io::given_options(options.open).empty()) return read_as_told(input, options, progress);
  try {
    return read_as_told(input, options, progress);
  } catch (const IoError& error) {
    LoadOptions automatic;
    automatic.cache_folder = options.cache_folder;
    automatic.open.on_center_view = options.open.on_center_view;
    Scene scene = load_scene(input, automatic, progress);
    scene.convention.warnings.push_back(
        std::string("The conventions that you set for this file were not used: ") + error.what());
    return std::make_shared<const Scene>(std::move(scene));
  }
}

// The options that a reader of the input knows; of one that nobody reads, all but the focus plane.
std::vector<ParameterDescription> options_of(const QString& input, const std::string& reader_id) {
  const io::Reader* reader = io::reader_named(reader_id);
  try {
    if (!reader) reader = io::find_reader(input.toStdString(), {}).reader;
  } catch (const std::exception&) {
    reader = nullptr;  // it could not be opened either
  }
  std::vector<ParameterDescription> options = io::open_schema().descriptions();
  std::erase_if(options, [reader](const ParameterDescription& option) {
    return option.key == Reading::kFocus || (reader && !reader->has_option(option.key));
  });
  return options;
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
    if (loading_job_ != 0) last_failure_ = sentence;
  });
}

void OpenController::open(const QString& input_as_given, std::function<void()> opened) {
  const QString input = absolute(input_as_given);
  const ParameterSet given = is_builtin(input) ? ParameterSet() : remembered_conventions(input);
  load(input, given, true, std::move(opened));
}

void OpenController::reopenWith(const ParameterSet& given) {
  const QString input = reopenable();
  if (input.isEmpty()) return;
  load(input, given, false, [input, given] { remember_conventions(input, given); });
}

void OpenController::reopenAt(double focus_px, std::function<void()> opened) {
  if (!session_.scene()) return;
  Reading reading = session_.light_field()->info().reading;
  reading.set_focus(focus_px);
  load(QString::fromStdString(session_.input()), reading.options, false, std::move(opened));
}

QString OpenController::reopenable() const {
  const QString input =
      failed_input_.isEmpty() ? QString::fromStdString(session_.input()) : failed_input_;
  return is_builtin(input) ? QString() : input;
}

LoadOptions OpenController::loadOptions(quint64 load, const ParameterSet& given) {
  LoadOptions options;
  options.cache_folder = cache_folder_;
  options.open = io::open_schema().parse(given);
  // The reading thread ends with the jobs, after this object: posts go by way of the jobs.
  options.open.on_center_view = [this, load, post = queued_post(&jobs_)](
                                    const Image<std::uint8_t>& center, const LightFieldInfo& info,
                                    GridShape) {
    auto picture = std::make_shared<Image<std::uint8_t>>(rgba_of(center));
    post([this, load, picture, name = QString::fromStdString(info.name)] {
      if (load != load_ || loading_job_ == 0) return;
      browse_.showPreview(to_qimage(std::move(*picture)), tr("%1 · reading all views …").arg(name));
      emit previewing(true);
    });
  };
  return options;
}

void OpenController::load(const QString& input, const ParameterSet& given, bool is_remembered,
                          std::function<void()> opened) {
  guard_([this, input, given, is_remembered, opened = std::move(opened)] {
    startLoading(input, given, is_remembered, opened);
  });
}

void OpenController::startLoading(const QString& input, const ParameterSet& given,
                                  bool is_remembered, std::function<void()> opened) {
  jobs_.cancelLane(Lane::Load);
  const quint64 load = ++load_;
  beginLoading(short_name(input));
  loading_job_ = jobs_.start<ScenePtr>(
      Lane::Load, tr("Opening %1").arg(loading_name_),
      [path = input.toStdString(), options = loadOptions(load, given),
       is_remembered](const Progress& progress) {
        return is_remembered ? read_as_remembered(path, options, progress)
                             : read_as_told(path, options, progress);
      },
      [this, input, load, opened = std::move(opened)](const ScenePtr& read) {
        // Painting may have gone on while this was read.
        guard_([this, input, load, opened, read] {
          if (load != load_) return;
          finishOpening(input, read);
          if (opened) opened();
        });
      },
      [this, load, input] { endLoading(load, input); });
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

void OpenController::finishOpening(const QString& input, const ScenePtr& scene) {
  jobs_.cancelLane(Lane::Estimate);  // they belong to the former light field
  session_.open(scene, input.toStdString());
  emit titleChanged(QString::fromStdString(session_.light_field()->info().name));
  if (is_builtin(input)) {
    keepBuiltin(input);
  } else {
    remember(input);
  }
}

void OpenController::endLoading(quint64 load, const QString& input) {
  if (load != load_) return;
  loading_job_ = 0;
  failed_input_ = last_failure_.isEmpty() ? QString() : input;
  emit reopenableChanged();
  const bool was_previewing = browse_.isPreviewing();
  browse_.endPreview();
  if (was_previewing) emit previewing(false);
  if (session_.scene()) return;
  if (last_failure_.isEmpty()) {
    panels_.canvas->showEmpty();
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
  jobs_.start<ReadEstimate>(
      Lane::Load, tr("Opening %1").arg(short_name(path)),
      [light_field, path = path.toStdString()](const Progress& progress) {
        return read_estimate(*light_field, path, progress);
      },
      [this, generation, name = short_name(path)](const ReadEstimate& read) {
        session_.add_estimate(read.estimate, read.display_range, generation);
        if (!read.differing_options.empty()) {
          emit warned(tr("%1 was estimated with%2: its errors may be meaningless. Choose the same "
                         "in Conventions…")
                          .arg(name, QString::fromStdString(read.differing_options)));
        } else if (read.is_of_others) {
          emit warned(tr("%1 was estimated from other samples than those of this light field: its "
                         "errors may be meaningless.")
                          .arg(name));
        }
      });
}

void OpenController::conventionsDialog() {
  const QString input = reopenable();
  if (input.isEmpty()) return;
  const std::string reader =
      failed_input_.isEmpty() ? session_.light_field()->info().reading.reader : std::string();
  auto* dialog = new ConventionsDialog(input, options_of(input, reader),
                                       remembered_conventions(input), panels_.viewer->window());
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &QDialog::accepted, this, [this, dialog, input] {
    // Something else may have been opened meanwhile, by a drop.
    if (reopenable() == input) reopenWith(dialog->given());
  });
  dialog->open();
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
  guard_([this] {
    jobs_.cancelLane(Lane::Load);
    jobs_.cancelLane(Lane::Estimate);
    ++load_;
    loading_job_ = 0;
    failed_input_.clear();
    session_.close();
    emit titleChanged({});
  });
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
