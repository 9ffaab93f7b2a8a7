// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/files/project_controller.h"

#include "app/gui/files/autosave.h"
#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/scene/scene_switcher.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/dialogs.h"
#include "app/gui/shell/features.h"
#include "app/gui/shell/frame.h"
#include "app/session/load_scene.h"
#include "app/session/open_scene.h"
#include "app/session/project_file.h"
#include "app/session/project_store.h"
#include "app/session/session.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/message_bar.h"

#include <QAbstractButton>
#include <QComboBox>
#include <QCoreApplication>
#include <QFileInfo>
#include <QPushButton>
#include <QSignalBlocker>
#include <QStringList>

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

namespace episcope {
namespace {

// Results of a scene in order of creation, also unreadable ones.
std::string results_text(const OpenScene& scene) {
  std::map<int, std::string> lines;
  for (const auto* entries : {&scene.estimates, &scene.unread}) {
    for (const EstimateEntry& entry : *entries) lines[entry.id] = entry.name + ' ' + entry.note;
  }
  std::string text;
  for (const auto& [id, line] : lines) text += std::to_string(id) + ' ' + line + '\n';
  return text;
}

// Documents with the project files that hold them.
std::vector<EditedDocument> stored_in(const Project& project,
                                      std::vector<EditedDocument> documents) {
  for (EditedDocument& each : documents) {
    const auto scene = std::ranges::find(project.scenes, each.scene, &ProjectScene::id);
    if (scene != project.scenes.end()) each.stored = scene->strokes;
  }
  return documents;
}

}  // namespace

ProjectController::ProjectController(const Workbench& bench, Autosave& autosave)
    : QObject(&bench.owner), bench_(bench), autosave_(autosave) {
  addCommands();
  connect(&bench.opener, &SceneOpener::isProject, this, &ProjectController::open);
  connect(&bench.scenes, &SceneSwitcher::notFound, this, &ProjectController::locate);
}

void ProjectController::addCommands() {
  const auto has_scene = [this] { return !bench_.session.scenes().empty(); };
  bench_.commands.add({.menu = Menu::Project, .enabled = has_scene},
                      {{.id = "file.save",
                        .text = tr("Save"),
                        .tip = tr("Saves the project; without one, new scribbles, or asks where"),
                        .icon = "save",
                        .keys = {QKeySequence::Save},
                        .run = [this] { saveWhatIsNew(); }},
                       {.id = "file.save_project",
                        .text = tr("Save as…"),
                        .tip = tr("Saves all open light fields with their results and scribbles "
                                  "as a project"),
                        .icon = "save",
                        .keys = {tr("Ctrl+Alt+S")},
                        .run = [this] { saveAs(); }}});
}

// Until there is a project, new scribbles go to a file that other programs read.
void ProjectController::saveWhatIsNew() {
  if (file().isEmpty() && bench_.document.hasUnsavedChanges()) {
    bench_.commands.trigger("file.save_scribbles");
  } else {
    save();
  }
}

QString ProjectController::file() const {
  return QString::fromStdString(autosave_.projectFile().string());
}

void ProjectController::setFile(const QString& path) {
  autosave_.setProjectFile(path.toStdString());
  known_.note(path.toStdString());
  bench_.commands.refresh();
}

std::string ProjectController::content() const {
  std::string text;
  for (const OpenScene* scene : bench_.session.scenes()) {
    text += scene->input + '\n' + results_text(*scene);
    if (!scene->labels.empty()) text += std::to_string(scene->labels.strokes) + '\n';
    text += work_text(scene->place);
  }
  for (const Sweep& sweep : bench_.scenes.sweeps().all()) {
    text += "sweep " + std::to_string(sweep.id);
    for (const SweepScene& scene : sweep.scenes) text += ' ' + std::to_string(scene.points.size());
    text += '\n';
  }
  return text;
}

void ProjectController::open(const QString& path, const std::function<void()>& then) {
  bench_.guards.leave(Leaving::Session, [this, path, then] { read(path, then); });
}

void ProjectController::read(const QString& path, const std::function<void()>& then) {
  using Read = std::shared_ptr<ReadProject>;
  bench_.jobs.start<Read>(
      Lane::Open, tr("Opening %1").arg(QFileInfo(path).fileName()),
      [path](const Progress&) {
        auto read = std::make_shared<ReadProject>();
        read->project = read_project(path.toStdString());
        read_strokes(*read);
        const OwnFolders own(path.toStdString());
        for (auto& [place, strokes] : read->strokes) forget_file_elsewhere(strokes.owner, own);
        return read;
      },
      [this, path, then](const Read& read) {
        show_project(bench_, std::move(*read), ProjectOrigin::File);
        saved_content_ = content();
        setFile(path);
        if (then) then();
      });
}

QString ProjectController::suggestion() const {
  if (!file().isEmpty()) return file();
  const OpenScene* front = bench_.session.find_scene(bench_.session.generation());
  return QString::fromStdString(front ? front->name : "project") + kProjectSuffix;
}

void ProjectController::save(std::function<void()> then) {
  file().isEmpty() ? saveAs(std::move(then)) : saveTo(file(), std::move(then));
}

void ProjectController::saveAs(std::function<void()> then) {
  ask_where_to_save(bench_,
                    {.name = "save_project",
                     .title = tr("Save project"),
                     .filter = tr("Projects (*.episcope)"),
                     .proposal = suggestion()},
                    [this, then = std::move(then)](const QString& path) { saveTo(path, then); });
}

void ProjectController::saveTo(const QString& path, std::function<void()> then) {
  if (!known_.has_changed(path.toStdString())) {
    write(path, std::move(then));
    return;
  }
  ask_about_changed_file(&bench_.window, path,
                         {.overwrite = [this, path, then] { write(path, then); },
                          .elsewhere = [this, then] { saveAs(then); },
                          .reload = [this, path] { read(path); },
                          .of_reloading = tr("Reloading replaces the open light fields.")});
}

void ProjectController::write(const QString& path, std::function<void()> then) {
  bench_.document.endStroke();
  Project project = project_of(bench_.session);
  project.sweeps = bench_.scenes.sweeps().all();
  const std::vector<EditedDocument> documents = bench_.document.editedDocuments();
  for (const EditedDocument& each : documents) {
    const auto scene = std::ranges::find(project.scenes, each.scene, &ProjectScene::id);
    if (scene != project.scenes.end()) scene->strokes = each.journal;
  }
  bench_.jobs.start<Project>(
      Lane::Export, tr("Saving %1").arg(QFileInfo(path).fileName()),
      [path, project](const Progress& progress) {
        return store_project(path.toStdString(), project, progress);
      },
      [this, path, documents, content = content(), then = std::move(then)](const Project& written) {
        bench_.document.noteKept(stored_in(written, documents));
        saved_content_ = content;
        noteSaved(path, written);
        if (then) then();
      });
}

void ProjectController::noteSaved(const QString& path, const Project& written) {
  for (const ProjectScene& scene : written.scenes) {
    bench_.session.set_labels_file(scene.id, scene.labels.labeling, scene.labels.file);
    bench_.session.mark_labels_saved(scene.id, scene.labels.labeling);
    bench_.session.set_unread_strokes(scene.id, scene.unread_strokes);
    for (const EstimateEntry& result : scene.estimates) {
      bench_.session.set_kept(result.id, result.kept);
      bench_.session.mark_saved(result.id);
    }
    for (const EstimateEntry& result : scene.unread) {
      bench_.session.set_kept(result.id, result.kept);
    }
  }
  for (const Sweep& sweep : written.sweeps) bench_.scenes.sweeps().mark_saved(sweep);
  setFile(path);
  bench_.messages.written(path);
}

void ProjectController::locate(quint64 scene) {
  const OpenScene* missing = bench_.session.find_scene(scene);
  if (!missing) return;
  const QString input = QString::fromStdString(missing->input);
  auto* box = new_question_box(&bench_.window,
                               {.name = "moved_light_field",
                                .title = tr("Light field not found"),
                                .text = tr("“%1” is no longer at %2. Where is it now? Files that "
                                           "were moved with it are then found too.")
                                            .arg(QString::fromStdString(missing->name), input)});
  const auto add = [&](const char* name, const QString& text, auto ask) {
    QPushButton* button = box->addButton(text, QMessageBox::AcceptRole);
    button->setObjectName(name);
    connect(button, &QPushButton::clicked, this, [this, scene, ask, title = box->windowTitle()] {
      ask(&bench_.window, {.name = "locate_light_field", .title = title},
          [this, scene](const QString& path) { move(scene, path); });
    });
  };
  add("moved_light_field.file", tr("Choose file…"), ask_for_file);
  add("moved_light_field.folder", tr("Choose folder…"), ask_for_folder);
  box->open();
}

void ProjectController::move(quint64 scene, const QString& input) {
  const OpenScene* moved = bench_.session.find_scene(scene);
  if (!moved) return;
  const MovedFolder folder = moved_folder(moved->input, input.toStdString());
  bench_.scenes.showMoved(scene, input.toStdString(), [this, scene, input, folder] {
    bench_.session.set_input(scene, input.toStdString());
    for (const OpenScene* each : bench_.session.scenes()) {
      const std::string found = moved_input(each->input, folder);
      if (!found.empty()) bench_.session.set_input(each->id, found);
    }
  });
}

namespace {

// What takes long and ends with something to keep.
constexpr Lane kLanesOfWork[] = {Lane::Capture, Lane::Estimate, Lane::Label, Lane::Export};

QString list_of(const std::vector<std::string>& names) {
  QStringList texts;
  for (const std::string& each : names) texts << QString::fromStdString(each);
  return listed(texts);
}

// Pairs of the built-in gantry come with it.
bool has_picks(const OpenScene& scene) {
  return builtin_scene_id(scene.input).empty() &&
         std::ranges::any_of(scene.place.capture.objects,
                             [](const CaptureObject& each) { return !each.pairs.empty(); });
}

}  // namespace

/// Asks once before losing results and labels that somebody asked for, scribbles of other scenes,
/// project changes or running work; offers to save a project.
class ProjectGuard : public QObject {
  Q_OBJECT

 public:
  ProjectGuard(const Workbench& bench, ProjectController& project)
      : QObject(&bench.owner), bench_(bench), project_(project) {
    bench.guards.add({.may_leave = [this](Leaving what) { return loss(what).empty(); },
                      .ask = [this](Leaving what, const Continue& go_on) { ask(what, go_on); }});
    bench.session.on_changed([this](Parts parts) {
      if (parts.has_any(Part::Scene | Part::Scenes | Part::Estimates | Part::Capture |
                        Part::Measured | Part::Labels)) {
        is_settled_ = false;
      }
    });
    bench.scenes.sweeps().on_changed([this] { is_settled_ = false; });
    connect(&bench.jobs, &Jobs::added, this, [this] {
      if (running(Leaving::Session).size() > settled_jobs_) is_settled_ = false;
    });
  }

 private:
  using Continue = LeaveGuards::Continue;

  /// What would be lost.
  struct Loss {
    std::vector<std::string> results;
    std::vector<std::string> scribbled;  ///< Names of light fields,
    std::vector<std::string> picked;     ///< of those with pairs for ground truth,
    std::vector<std::string> measured;   ///< and of those with lines kept of EPIs.
    bool of_project = false;             ///< Other changes of a project that has a file.
    std::vector<std::string> running;    ///< Jobs, with their progress.
    [[nodiscard]] bool empty() const { return !has_unsaved() && running.empty(); }
    [[nodiscard]] bool has_unsaved() const {
      return !results.empty() || !scribbled.empty() || !picked.empty() || !measured.empty() ||
             of_project;
    }
  };

  [[nodiscard]] Loss loss(Leaving what) const {
    Loss loss;
    if (is_settled_ || what == Leaving::Reading) return loss;
    const Session& session = bench_.session;
    const bool has_file = !project_.file().isEmpty();
    for (const OpenScene* scene : session.scenes()) {
      if (what == Leaving::Scene && scene->id != session.generation()) continue;
      if (!has_file && has_picks(*scene)) loss.picked.push_back(scene->name);
      if (!has_file && !scene->place.measured.list.empty()) loss.measured.push_back(scene->name);
      addResults(*scene, loss);
    }
    for (const Sweep& sweep : bench_.scenes.sweeps().all()) {
      const bool is_left = what != Leaving::Scene || is_of_scene(sweep, session.generation());
      if (is_left && !sweep.is_saved) {
        loss.results.push_back(
            tr("sweep of %1").arg(QString::fromStdString(sweep.base.method)).toStdString());
      }
    }
    for (const Jobs::Running& each : running(what)) {
      loss.running.push_back(
          tr("%1 (%2 %)").arg(each.title).arg(percent_done(each.fraction)).toStdString());
    }
    if (what != Leaving::Session) return loss;
    loss.of_project = project_.hasChanged();
    for (const std::uint64_t id : bench_.document.unsavedScenes()) {
      // Alone and without a project, scribbles go to a file of their own, which is asked for later.
      if (id == session.generation() && session.scenes().size() == 1 && !has_file) continue;
      if (const OpenScene* scene = session.find_scene(id)) loss.scribbled.push_back(scene->name);
    }
    return loss;
  }

  void addResults(const OpenScene& scene, Loss& loss) const {
    const auto add = [&](const QString& what) {
      loss.results.push_back(job_title(what, scene).toStdString());
    };
    for (const EstimateEntry& entry : scene.estimates) {
      if (!entry.is_saved) add(QString::fromStdString(entry.name));
    }
    const KeptLabels& labels = scene.labels;
    if (!labels.is_unsaved()) return;
    add(labels.covers_many() || labels.is_on_disk_alone() ? tr("labels of all views")
                                                          : tr("labels of one view"));
  }

  // A light field that is closed ends the jobs on it alone.
  [[nodiscard]] std::vector<Jobs::Running> running(Leaving what) const {
    std::vector<Jobs::Running> all;
    for (const Lane lane : kLanesOfWork) {
      for (Jobs::Running& each : bench_.jobs.running(lane)) {
        const bool is_left = what != Leaving::Scene || each.scene == bench_.session.generation();
        if (is_left && !each.is_expendable) all.push_back(std::move(each));
      }
    }
    return all;
  }

  [[nodiscard]] static QString sentence(const Loss& loss) {
    QStringList sentences;
    if (!loss.results.empty()) sentences << tr("Not saved: %1.").arg(list_of(loss.results));
    if (!loss.scribbled.empty()) {
      sentences << tr("Unsaved scribbles: on %1.").arg(list_of(loss.scribbled));
    }
    if (!loss.picked.empty()) {
      sentences << tr("Unsaved pairs of points: on %1.").arg(list_of(loss.picked));
    }
    if (!loss.measured.empty()) {
      sentences << tr("Unsaved measured lines: on %1.").arg(list_of(loss.measured));
    }
    if (loss.of_project && sentences.isEmpty()) sentences << tr("The project has changed.");
    if (!loss.running.empty()) {
      sentences << tr("Still running, and would be lost: %1.").arg(list_of(loss.running));
    }
    return sentences.join(' ');
  }

  void ask(Leaving what, const Continue& go_on) {
    const Loss lost = loss(what);
    if (lost.empty()) {
      go_on();
      return;
    }
    if (question_) {
      question_->raise();
      return;
    }
    const bool has_unsaved = lost.has_unsaved();
    question_ = new_question_box(
        &bench_.window, {.name = "unsaved_results",
                         .title = has_unsaved ? tr("Unsaved work") : tr("Work is running"),
                         .text = sentence(lost),
                         .buttons = (has_unsaved ? QMessageBox::SaveAll : QMessageBox::NoButton) |
                                    QMessageBox::Discard | QMessageBox::Cancel});
    if (!has_unsaved) {
      question_->button(QMessageBox::Discard)
          ->setText(what == Leaving::Session ? tr("Quit anyway") : tr("Close anyway"));
    }
    question_->setDefaultButton(has_unsaved ? QMessageBox::SaveAll : QMessageBox::Cancel);
    connect(question_, &QMessageBox::buttonClicked, this,
            [this, box = question_.data(), what, go_on](QAbstractButton* button) {
              question_ = nullptr;
              answer(box->standardButton(button), what, go_on);
            });
    question_->open();
  }

  void answer(QMessageBox::StandardButton button, Leaving what, const Continue& go_on) {
    if (button == QMessageBox::SaveAll) project_.save([this, what, go_on] { ask(what, go_on); });
    if (button != QMessageBox::Discard) return;
    is_settled_ = true;
    settled_jobs_ = running(Leaving::Session).size();
    if (what == Leaving::Session) bench_.document.discardAll();
    go_on();
  }

  Workbench bench_;
  ProjectController& project_;
  std::size_t settled_jobs_ = 0;  // that ran when the user said so:
  bool is_settled_ = false;       // what is there now may go
  QPointer<QMessageBox> question_;
};

namespace {

struct SceneChooserText {
  Q_DECLARE_TR_FUNCTIONS(episcope::SceneChooser)
};

// "edge · 3 results".
QString text_of(const OpenScene& scene) {
  const QString name = QString::fromStdString(scene.name);
  const auto count = scene.estimates.size();
  if (count == 0) return name;
  return count == 1 ? SceneChooserText::tr("%1 · 1 result").arg(name)
                    : SceneChooserText::tr("%1 · %2 results").arg(name).arg(count);
}

}  // namespace

/// The list of open light fields, which switches between them.
class SceneChooser : public QObject {
  Q_OBJECT

 public:
  explicit SceneChooser(const Workbench& bench)
      : QObject(&bench.owner),
        bench_(bench),
        list_(named("scenes.open", new QComboBox(&bench.frame))) {
    list_->setAccessibleName(tr("Open light fields"));
    list_->setToolTip(tr("Open light fields: choose the one to show"));
    list_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    list_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    bench.frame.addToColumn(list_, false);
    connect(list_, &QComboBox::activated, this, [this](int row) {
      bench_.scenes.show(list_->itemData(row).toULongLong());
      fill();  // until it is read, the one before is shown
    });
    addCommands();
    connect(&bench.viewer_area, &ViewerArea::previewChanged, this, &SceneChooser::fill);
    bench.session.on_changed([this](Parts parts) {
      if (parts.has_any(Part::Scene | Part::Scenes | Part::Estimates)) fill();
    });
    fill();
  }

 private:
  void addCommands() {
    const auto has_several = [this] { return bench_.session.scenes().size() > 1; };
    bench_.commands.add({.menu = Menu::View, .section = section::kTabs, .enabled = has_several},
                        {{.id = "scenes.next",
                          .text = tr("Next open light field"),
                          .tip = tr("Shows the next open light field"),
                          .keys = {tr("Ctrl+Alt+PgDown")},
                          .run = [this] { bench_.scenes.step(1); }},
                         {.id = "scenes.previous",
                          .text = tr("Previous open light field"),
                          .tip = tr("Shows the previous open light field"),
                          .keys = {tr("Ctrl+Alt+PgUp")},
                          .run = [this] { bench_.scenes.step(-1); }}});
    bench_.commands.addTargets([this] {
      std::vector<PaletteTarget> found;
      for (const OpenScene* scene : bench_.session.scenes()) {
        found.push_back({tr("Open light field: %1").arg(QString::fromStdString(scene->name)),
                         tr("Shows it: %1").arg(QString::fromStdString(scene->input)),
                         {},
                         [this, id = scene->id] { bench_.scenes.show(id); }});
      }
      return found;
    });
  }

  void fill() {
    const QSignalBlocker blocker(list_);
    list_->clear();
    for (const OpenScene* scene : bench_.session.scenes()) {
      list_->addItem(text_of(*scene), QVariant::fromValue<qulonglong>(scene->id));
      list_->setItemData(list_->count() - 1, QString::fromStdString(scene->input), Qt::ToolTipRole);
    }
    const bool is_opening = bench_.viewer_area.isPreviewing();
    const auto shown = QVariant::fromValue<qulonglong>(bench_.session.generation());
    list_->setCurrentIndex(is_opening ? -1 : list_->findData(shown));
    const bool is_empty = list_->count() == 0;
    list_->setEnabled(!is_empty);
    list_->setPlaceholderText(is_opening ? tr("opening …")
                              : is_empty ? tr("nothing is open")
                                         : tr("none of these is shown"));
  }

  Workbench bench_;
  QComboBox* list_;
};

/// Titles the window after light field and project; a star marks unsaved scribbles or project
/// changes.
class WindowTitle : public QObject {
  Q_OBJECT

 public:
  WindowTitle(const Workbench& bench, const Autosave& autosave, const ProjectController& project)
      : QObject(&bench.owner), bench_(bench), autosave_(autosave), project_(project) {
    connect(&bench.document, &DocumentController::unsavedChanged, this, &WindowTitle::show);
    connect(&autosave, &Autosave::projectFileChanged, this, &WindowTitle::show);
    bench.session.on_changed([this](Parts parts) {
      if (parts.has_any(Part::Scene | Part::Scenes)) {
        show();
      } else if (parts.has_any(Part::Estimates | Part::Labels | Part::Capture)) {
        mark();
      }
    });
    bench.scenes.sweeps().on_changed([this] { mark(); });
    show();
  }

 private:
  void show() {
    QStringList parts;
    if (const LightFieldPtr light_field = bench_.session.light_field()) {
      parts << QString::fromStdString(light_field->info().name);
    }
    if (const std::string file = autosave_.projectFile().filename().string(); !file.empty()) {
      parts << QString::fromStdString(file);
    }
    if (!parts.isEmpty()) parts.front() += "[*]";
    bench_.window.setWindowTitle((parts << QStringLiteral("Episcope")).join(QStringLiteral(" — ")));
    mark();
  }

  void mark() {
    const bool has_file = !autosave_.projectFile().empty();
    const bool is_unsaved = has_file
                                ? project_.hasChanged() || !bench_.document.unsavedScenes().empty()
                                : bench_.document.hasUnsavedChanges();
    // The mark has a place where there is a name.
    bench_.window.setWindowModified(is_unsaved && bench_.window.windowTitle().contains("[*]"));
  }

  Workbench bench_;
  const Autosave& autosave_;
  const ProjectController& project_;
};

void add_project(const Workbench& bench) {
  auto* autosave = new Autosave(bench);
  auto* project = new ProjectController(bench, *autosave);
  new ProjectGuard(bench, *project);
  add_session_recovery(bench, *autosave);
  new SceneChooser(bench);
  new WindowTitle(bench, *autosave, *project);
}

}  // namespace episcope

#include "moc_project_controller.cpp"

#include "project_controller.moc"
