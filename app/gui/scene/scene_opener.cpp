// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/scene/scene_opener.h"

#include "app/gui/scene/scene_switcher.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/session/collections.h"
#include "app/session/picture.h"
#include "app/session/project_file.h"
#include "app/session/user_folders.h"
#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/io/base/files.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/labels.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/picture.h"
#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"

#include <fmt/format.h>

#include <QButtonGroup>
#include <QDialog>
#include <QDialogButtonBox>
#include <QFileInfo>
#include <QLabel>
#include <QPushButton>
#include <QRadioButton>
#include <QSettings>
#include <QUrl>
#include <QVBoxLayout>
#include <QVariantMap>

#include <algorithm>
#include <utility>

namespace episcope {
namespace {

/// Asks how a light field is to be read where the files do not tell.
class ReadingQuestion : public QDialog {
  Q_OBJECT

 public:
  ReadingQuestion(const io::Undecided& question, QWidget* parent);

  [[nodiscard]] std::string chosen() const;

 private:
  std::vector<io::ReadingChoice> choices_;
  QButtonGroup* buttons_;
};

constexpr int kQuestionWidth = 460;

QString sentence(const std::string& text) {
  const QString whole = QString::fromStdString(text);
  return whole.left(1).toUpper() + whole.mid(1) + '.';
}

QLabel* paragraph(const QString& text, QWidget* parent) {
  auto* label = new QLabel(text, parent);
  label->setTextFormat(Qt::PlainText);
  label->setWordWrap(true);
  return label;
}

ReadingQuestion::ReadingQuestion(const io::Undecided& question, QWidget* parent)
    : QDialog(parent), choices_(question.choices()), buttons_(new QButtonGroup(this)) {
  setObjectName("readingQuestion");
  setWindowTitle(tr("How is it to be read?"));
  auto* layout = new QVBoxLayout(this);
  auto* file = new ElidedLabel(this, Qt::ElideMiddle);
  file->setFullText(QString::fromStdString(question.path().string()));
  layout->addWidget(file);
  layout->addWidget(paragraph(with_conventions(sentence(question.reason())), this));
  for (std::size_t i = 0; i < choices_.size(); ++i) {
    auto* button = named("readingQuestion." + QString::fromStdString(choices_[i].value),
                         new QRadioButton(schema_text(choices_[i].label), this));
    buttons_->addButton(button, static_cast<int>(i));
    layout->addWidget(button);
  }
  if (auto* first = buttons_->button(0)) first->setChecked(true);
  auto* note =
      paragraph(tr("Your choice is remembered for this file; “Conventions…” changes it."), this);
  theme::mute(note);
  layout->addWidget(note);
  layout->addStretch(1);
  layout->addWidget(make_answers(this, "readingQuestion.ok", tr("Open")));
  layout->activate();
  resize(kQuestionWidth, layout->heightForWidth(kQuestionWidth));
}

std::string ReadingQuestion::chosen() const {
  const int index = std::max(buttons_->checkedId(), 0);
  return choices_[static_cast<std::size_t>(index)].value;
}

QString short_name(const QString& input) {
  const QString name = QFileInfo(input).fileName();
  return name.isEmpty() ? input : name;
}

// Paths are kept absolute, so that they open from any working folder.
QString absolute(const QString& input) {
  return is_builtin(input) ? input : QFileInfo(input).absoluteFilePath();
}

RgbaImage rgba_of(const Image<std::uint8_t>& rgb) {
  RgbaImage picture(rgb.height(), rgb.width(), 4, 255);
  for (int y = 0; y < rgb.height(); ++y) {
    for (int x = 0; x < rgb.width(); ++x) {
      for (int c = 0; c < 3; ++c) {
        picture.at(y, x, c) = rgb.at(y, x, rgb.channels() == 3 ? c : 0);
      }
    }
  }
  return picture;
}

using ScenePtr = std::shared_ptr<const Scene>;

ScenePtr read_as_told(const std::string& input, const LoadOptions& options,
                      const Progress& progress) {
  // Which of several light fields of a folder is meant is for the user to say.
  if (io::given_options(options.open).empty()) {
    const auto below = collection_at(input, options.open, progress);
    if (below.size() > 1) throw IsCollection(input, below.size());
  }
  return std::make_shared<const Scene>(load_scene(input, options, progress));
}

ParameterSet with_option(ParameterSet given, const std::string& key, const std::string& text) {
  std::erase_if(given, [&](const auto& option) { return option.first == key; });
  given.emplace_back(key, parse_parameter(io::open_schema().description(key), text));
  return given;
}

// Outcome of reading: a scene, a question, or a folder of several.
struct Opened {
  ScenePtr scene;
  std::optional<io::Undecided> question;
  bool is_collection = false;
};

Opened read_or_question(const std::function<ScenePtr()>& read) {
  try {
    return {read(), {}};
  } catch (const io::Undecided& question) {
    return {nullptr, question};
  } catch (const IsCollection&) {
    return {nullptr, {}, true};
  }
}

// Drops conventions that no longer fit the file, and tells the user.
ScenePtr read_as_remembered(const std::string& input, const LoadOptions& options,
                            const Progress& progress) {
  if (io::given_options(options.open).empty()) return read_as_told(input, options, progress);
  try {
    return read_as_told(input, options, progress);
  } catch (const IoError& error) {
    LoadOptions automatic;
    automatic.cache_folder = options.cache_folder;
    automatic.open.on_center_view = options.open.on_center_view;
    automatic.open.on_center_epis = options.open.on_center_epis;
    Scene scene = load_scene(input, automatic, progress);
    scene.convention.warnings.push_back(
        fmt::format(finding_text("conventions.unused"), error.what()));
    return std::make_shared<const Scene>(std::move(scene));
  }
}

}  // namespace

bool is_builtin(const QString& input) {
  return !builtin_scene_id(input.toStdString()).empty();
}

SceneOpener::SceneOpener(Session& session, Jobs& jobs, ViewerArea& viewer_area,
                         const LeaveGuards& guards, SceneSwitcher& scenes, QObject* parent)
    : QObject(parent),
      session_(session),
      jobs_(jobs),
      viewer_area_(viewer_area),
      guards_(guards),
      scenes_(scenes),
      cache_folder_(default_cache_folder()) {
  connect(&jobs_, &Jobs::progressed, this,
          [this](quint64 job, double fraction) { showLoading(job, fraction); });
  connect(&jobs_, &Jobs::failed, this, [this](const QString& sentence, quint64 job) {
    if (job == loading_job_) last_failure_ = sentence;
  });
}

void SceneOpener::open(const QString& input_as_given, std::function<void()> then,
                       std::function<void(const QString&)> otherwise) {
  const QString input = absolute(input_as_given);
  if (names_project(input.toStdString())) {
    emit isProject(input, then);
    return;
  }
  if (const std::uint64_t open = session_.scene_of(input.toStdString())) {
    failed_input_.clear();
    emit changed();
    scenes_.show(open, std::move(then));
    return;
  }
  load({.input = input,
        .given = is_builtin(input) ? ParameterSet() : remembered_conventions(input),
        .is_remembered = true,
        .then =
            [this, input, then = std::move(then)] {
              emit opened(input);
              if (then) then();
            },
        .otherwise = std::move(otherwise),
        .is_added = true});
}

void SceneOpener::setCacheFolder(const std::filesystem::path& folder) {
  cache_folder_ = folder;
  scenes_.setCacheFolder(folder);
}

void SceneOpener::reopen() {
  const QString input = reopenable();
  if (input.isEmpty()) return;
  load({.input = input,
        .given = remembered_conventions(input),
        .is_remembered = true,
        .then = nullptr,
        .is_added = hasFailed()});
}

void SceneOpener::reopenWith(const ParameterSet& given) {
  const QString input = reopenable();
  if (!input.isEmpty()) readAs(input, given, hasFailed());
}

void SceneOpener::reopenShownWith(const ParameterSet& given) {
  if (session_.scene()) readAs(QString::fromStdString(session_.input()), given, false);
}

void SceneOpener::readAs(const QString& input, const ParameterSet& given, bool is_added) {
  load({.input = input,
        .given = given,
        .then = [input, given] { remember_conventions(input, given); },
        .is_added = is_added});
}

void SceneOpener::reopenAt(double focus_px, std::function<void()> then) {
  if (!session_.scene()) return;
  Reading reading = session_.light_field()->info().reading;
  reading.set_focus(focus_px);
  load({.input = QString::fromStdString(session_.input()),
        .given = reading.options,
        .then = std::move(then),
        .keeps_results = true});
}

void SceneOpener::reopenFrame(int frame, std::function<void()> then) {
  if (!session_.scene()) return;
  io::OpenOptions options = io::open_schema().parse(session_.reading_options());
  options.frame = frame;
  load({.input = QString::fromStdString(session_.input()),
        .given = io::given_options(options),
        .then = std::move(then)});
}

QString SceneOpener::reopenable() const {
  const QString input =
      failed_input_.isEmpty() ? QString::fromStdString(session_.input()) : failed_input_;
  return is_builtin(input) ? QString() : input;
}

LoadOptions SceneOpener::loadOptions(quint64 number, const ParameterSet& given) {
  LoadOptions options;
  options.cache_folder = cache_folder_;
  options.open = io::open_schema().parse(given);
  // The reading thread ends with the jobs, after this object: posts go by way of the jobs.
  options.open.on_center_view = [this, number, post = queued_post(&jobs_)](
                                    const Image<std::uint8_t>& center, const LightFieldInfo& info,
                                    GridShape) {
    auto picture = std::make_shared<RgbaImage>(rgba_of(center));
    post([this, number, picture, name = QString::fromStdString(info.name)] {
      if (number != number_ || loading_job_ == 0) return;
      viewer_area_.showPreview(to_qimage(std::move(*picture)),
                               tr("%1 · reading all views …").arg(name));
    });
  };
  options.open.on_center_epis = [this, number,
                                 post = queued_post(&jobs_)](const io::CenterEpis& epis) {
    auto horizontal = std::make_shared<RgbaImage>(rgba_of(epis.horizontal));
    auto vertical = std::make_shared<RgbaImage>(rgba_of(epis.vertical));
    post([this, number, horizontal, vertical] {
      if (number != number_ || loading_job_ == 0) return;
      viewer_area_.showPreviewEpis(to_qimage(std::move(*horizontal)),
                                   to_qimage(std::move(*vertical)));
    });
  };
  return options;
}

void SceneOpener::load(const Load& load) {
  leave(load, [this, load] { start(load); });
}

void SceneOpener::leave(const Load& load, const std::function<void()>& go_on) {
  if (load.is_added) {
    go_on();
  } else {
    guards_.leave(load.keeps_results ? Leaving::Reading : Leaving::Scene, go_on);
  }
}

void SceneOpener::start(const Load& load) {
  jobs_.cancelLane(Lane::Open);
  failed_input_.clear();
  const quint64 number = ++number_;
  loading_name_ = short_name(load.input);
  last_failure_.clear();
  has_asked_ = false;
  if (!session_.scene()) viewer_area_.canvas()->showLoading(loading_name_, -1);
  loading_job_ = jobs_.start<Opened>(
      Lane::Open, tr("Opening %1").arg(loading_name_),
      [path = load.input.toStdString(), options = loadOptions(number, load.given),
       is_remembered = load.is_remembered](const Progress& progress) {
        return read_or_question([&] {
          return is_remembered ? read_as_remembered(path, options, progress)
                               : read_as_told(path, options, progress);
        });
      },
      [this, number, load](const Opened& opened) {
        if (opened.question) {
          if (number == number_) ask(load, *opened.question);
          return;
        }
        if (opened.is_collection) {
          if (number != number_) return;
          emit isCollection(load.input);
          if (load.otherwise) load.otherwise({});
          return;
        }
        // Painting may have gone on while this was read.
        leave(load, [this, number, load, scene = opened.scene] {
          if (number != number_) return;
          finish(load, scene);
          if (load.then) load.then();
        });
      },
      [this, number, load] { end(number, load); });
  emit changed();
}

void SceneOpener::ask(const Load& load, const io::Undecided& question) {
  last_failure_ = tr("%1: %2. “Conventions…” lets you choose.")
                      .arg(QString::fromStdString(question.path().string()),
                           with_conventions(QString::fromStdString(question.reason())));
  has_asked_ = true;
  auto* dialog = new ReadingQuestion(question, viewer_area_.canvas()->window());
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &QDialog::accepted, this, [this, load, key = question.option(), dialog] {
    Load again = load;
    again.is_remembered = false;
    again.given = with_option(load.given, key, dialog->chosen());
    again.then = [input = load.input, given = again.given, then = load.then] {
      remember_conventions(input, given);
      if (then) then();
    };
    this->load(again);
  });
  if (load.otherwise) {
    connect(dialog, &QDialog::rejected, this,
            [load, failure = last_failure_] { load.otherwise(failure); });
  }
  dialog->open();
}

void SceneOpener::showLoading(quint64 job, double fraction) {
  if (job != loading_job_ || session_.scene() || viewer_area_.isPreviewing()) return;
  viewer_area_.canvas()->showLoading(loading_name_, fraction);
}

void SceneOpener::finish(const Load& load, const ScenePtr& scene) {
  emit failureIsOver(told_failures_.take(load.input));
  if (load.is_added) {
    session_.add(scene, load.input.toStdString());
  } else {
    session_.open(scene, load.input.toStdString());
  }
  if (is_builtin(load.input)) keepBuiltin(load.input);
}

void SceneOpener::end(quint64 number, const Load& load) {
  if (number != number_) return;
  loading_job_ = 0;
  const bool has_failed = !last_failure_.isEmpty();
  failed_input_ = has_failed ? load.input : QString();
  viewer_area_.endPreview();
  emit changed();
  if (has_failed) {
    tellFailure(load);
  } else if (!session_.scene()) {
    viewer_area_.canvas()->showEmpty();
  }
}

// In one place: where the view would be, else over it.
void SceneOpener::tellFailure(const Load& load) {
  QString told = last_failure_;
  if (io::is_image_name(load.input.toStdString())) {
    told += ' ' + tr("The raw picture of a plenoptic camera is opened in the tab Capture, "
                     "on the page “Raw picture”.");
  }
  if (!session_.scene()) {
    emit failureIsOver(last_failure_);
    viewer_area_.canvas()->showError(told);
  } else if (!has_asked_) {
    emit failureIsOver(std::exchange(told_failures_[load.input], told));
    emit failed(told);
  }
  if (load.otherwise && !has_asked_) load.otherwise(told);
}

void SceneOpener::keepBuiltin(const QString& input) {
  const quint64 job = jobs_.start<bool>(
      Lane::Export, tr("Caching the built-in scene"),
      [scene = session_.scene(), input = input.toStdString(),
       folder = cache_folder_](const Progress& progress) {
        store_in_cache(input, *scene, folder, progress);
        return true;
      },
      [](bool) {});
  jobs_.setExpendable(job);
}

void SceneOpener::close() {
  guards_.leave(Leaving::Scene, [this] {
    jobs_.cancelLane(Lane::Open);
    ++number_;
    loading_job_ = 0;
    failed_input_.clear();
    viewer_area_.endPreview();
    session_.close();
    scenes_.showLatest();
    emit changed();
  });
}

namespace {

// Slashes would make groups of the path's folders.
QString key_of(const QString& path) {
  return "conventions/" + QString::fromLatin1(QUrl::toPercentEncoding(path));
}

}  // namespace

ParameterSet remembered_conventions(const QString& path) {
  const QVariantMap texts = QSettings().value(key_of(path)).toMap();
  ParameterSet given;
  for (const ParameterDescription& option : io::open_schema().descriptions()) {
    const QVariant text = texts.value(QString::fromStdString(option.key));
    if (!text.isValid()) continue;
    try {
      given.emplace_back(option.key, parse_parameter(option, text.toString().toStdString()));
    } catch (const InvalidInput&) {
      // Settings are a file that anybody may edit: what is no choice counts as automatic.
    }
  }
  return given;
}

void remember_conventions(const QString& path, const ParameterSet& given) {
  if (given.empty()) {
    QSettings().remove(key_of(path));
    return;
  }
  QVariantMap texts;
  for (const auto& [key, value] : given) {
    texts[QString::fromStdString(key)] = QString::fromStdString(to_text(value));
  }
  QSettings().setValue(key_of(path), texts);
}

}  // namespace episcope

#include "moc_scene_opener.cpp"
#include "scene_opener.moc"
