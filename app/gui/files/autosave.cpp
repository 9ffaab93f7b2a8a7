// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/files/autosave.h"

#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/scene_switcher.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/dialogs.h"
#include "app/gui/shell/features.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/session/load_scene.h"
#include "app/session/user_folders.h"
#include "engine/core/error.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/message_bar.h"
#include "widgets/controls/text.h"

#include <QCoreApplication>

#include <algorithm>
#include <functional>

namespace episcope {
namespace {

namespace fs = std::filesystem;

constexpr int kLater_ms = 500;  // what changes with every movement of the hand

// Merely opened light fields are not worth keeping: they open again as quickly.
bool is_worth_keeping(const Project& project) {
  return project.scenes.size() > 1 || !project.sweeps.empty() ||
         std::ranges::any_of(project.scenes, [](const ProjectScene& scene) {
           return !scene.estimates.empty() || !scene.unread.empty() ||
                  scene.labels.is_worth_keeping() || has_work(scene.place);
         });
}

Project written_part(Project project) {
  for (ProjectScene& scene : project.scenes) {
    std::erase_if(scene.estimates, std::not_fn(is_in_file));
  }
  return project;
}

}  // namespace

Autosave::Autosave(const Workbench& bench)
    : QObject(&bench.owner),
      bench_(bench),
      root_(default_workspace_folder()),
      runner_(std::make_unique<JobRunner>(queued_post(this))) {
  later_.setSingleShot(true);
  later_.setInterval(kLater_ms);
  connect(&later_, &QTimer::timeout, this, &Autosave::schedule);
  connect(&bench.frame, &Frame::ended, this, [this] { is_over_ = true; });
  bench.session.on_changed([this](Parts parts) { follow(parts); });
  bench.scenes.sweeps().on_changed([this] { schedule(); });
}

Autosave::~Autosave() {
  runner_.reset();
  if (!is_over_) return;
  if (workspace_) workspace_->remove();
  for (const auto& former : former_) former->remove();
}

void Autosave::follow(Parts parts) {
  if (parts.has_any(Part::Scene | Part::Scenes | Part::Estimates | Part::Shown | Part::Measured |
                    Part::Capture | Part::Judged | Part::LabelLook)) {
    schedule();
  } else if (!later_.isActive()) {
    later_.start();
  }
}

void Autosave::schedule() {
  is_due_ = true;
  if (!is_writing_) write();
}

bool Autosave::makeWorkspace() {
  if (workspace_) return true;
  if (root_.empty() || has_failed_) return false;
  try {
    workspace_ = std::make_unique<Workspace>(root_);
  } catch (const IoError& error) {
    has_failed_ = true;
    bench_.messages.warn(QString::fromUtf8(error.what()));
  }
  return workspace_ != nullptr;
}

void Autosave::write() {
  is_due_ = false;
  later_.stop();
  Project project = project_of(bench_.session);
  project.sweeps = bench_.scenes.sweeps().all();
  project.saved_as = project_file_;
  if (is_over_ || (!workspace_ && !is_worth_keeping(project)) || !makeWorkspace()) return;
  is_writing_ = true;
  const auto kept = std::make_shared<Kept>();
  runner_->start<bool>(
      [project, kept, file = workspace_->project_file()](const Progress& progress) {
        lower_thread_priority();
        write_all(project, file, *kept, progress);
        return true;
      },
      [this, kept](const Outcome<bool>& outcome) { finish(outcome, *kept); });
}

void Autosave::write_all(Project project, const fs::path& file, Kept& kept,
                         const Progress& progress) {
  write_project(file, written_part(project));  // results may take long
  const fs::path folder = file.parent_path();
  for (ProjectScene& scene : project.scenes) {
    for (EstimateEntry& result : scene.estimates) {
      if (is_in_file(result)) continue;
      result.kept = store_result(folder, scene, result, progress);
      kept.results.emplace_back(result.id, result.kept);
      write_project(file, written_part(project));
    }
  }
  for (ProjectScene& scene : project.scenes) {
    if (!scene.labels.labeling || !scene.labels.file.empty()) continue;
    scene.labels.file = store_labels(folder, scene, progress);
    kept.labels.push_back({scene.id, scene.labels.labeling, scene.labels.file});
    write_project(file, written_part(project));
  }
}

// Removes the file of outdated labels once the project names the new one.
void Autosave::keepLabels(const Kept::Labels& kept) {
  const fs::path former = std::exchange(label_files_[kept.scene], kept.file);
  std::error_code ignored;
  if (!former.empty()) fs::remove(former, ignored);
  bench_.session.set_labels_file(kept.scene, kept.labeling, kept.file);
}

void Autosave::finish(const Outcome<bool>& outcome, const Kept& kept) {
  is_writing_ = false;
  for (const auto& [estimate, file] : kept.results) bench_.session.set_kept(estimate, file);
  for (const Kept::Labels& each : kept.labels) keepLabels(each);
  if (outcome.failure && !std::exchange(has_failed_, true)) {
    bench_.messages.warn(tr("Results cannot be kept for a crash: %1")
                             .arg(schema_text(failure_text(outcome.failure))));
  }
  if (is_due_ && !has_failed_) write();
}

void Autosave::takeOver(const fs::path& folder) {
  auto taken = Workspace::take_over(folder);
  runner_ = std::make_unique<JobRunner>(queued_post(this));  // what was being written is dropped
  is_writing_ = false;
  if (workspace_) former_.push_back(std::move(workspace_));
  workspace_ = std::move(taken);  // written when its scenes are open
}

void Autosave::setProjectFile(fs::path file) {
  project_file_ = std::move(file);
  emit projectFileChanged();
  schedule();
}

namespace {

struct SessionRecoveryText {
  Q_DECLARE_TR_FUNCTIONS(episcope::SessionRecovery)
};

std::size_t result_count(const Project& project) {
  std::size_t count = 0;
  for (const ProjectScene& scene : project.scenes) count += scene.estimates.size();
  return count;
}

// "light fields: 2, results: 3, with scribbles: 1".
QString content_of(const Project& project) {
  QStringList parts{SessionRecoveryText::tr("light fields: %1").arg(project.scenes.size())};
  const auto add = [&parts](const QString& text, std::size_t count) {
    if (count > 0) parts << text.arg(count);
  };
  const auto count = [&project](auto has) {
    return static_cast<std::size_t>(std::ranges::count_if(project.scenes, has));
  };
  add(SessionRecoveryText::tr("results: %1"), result_count(project));
  add(SessionRecoveryText::tr("with scribbles: %1"),
      count([](const ProjectScene& scene) { return !scene.strokes.empty(); }));
  add(SessionRecoveryText::tr("with labels: %1"),
      count([](const ProjectScene& scene) { return !scene.labels.empty(); }));
  return parts.join(", ");
}

// The journals that the killed session left: each belongs to the scene that it was painted on. Also
// where the user's own project holds everything: recovered strokes continue from there.
void name_journals(Project& project, const std::filesystem::path& folder) {
  for (const OrphanedJournal& journal : orphaned_journals(folder)) {
    try {
      const RecoveredAnnotation found = read_journal(journal.path);
      if (found.is_untouched()) continue;
      const auto scene =
          std::ranges::find(project.scenes, found.owner.source, &ProjectScene::input);
      if (scene != project.scenes.end() && scene->strokes.empty()) {
        scene->strokes = journal.path;
      }
    } catch (const IoError&) {
      // Not even its beginning can be read: it is of no scene.
    }
  }
}

}  // namespace

/// Offers scenes, results and scribbles of a session that ended unexpectedly, in a bar that does
/// not block. Closed without an answer, it keeps them for the next start.
class SessionRecovery : public QObject {
  Q_OBJECT

 public:
  SessionRecovery(const Workbench& bench, Autosave& autosave)
      : QObject(&bench.owner),
        bench_(bench),
        autosave_(autosave),
        bar_(named("sessionRecoveryBar", new MessageBar(&bench.frame))),
        job_(this) {
    bench.frame.addFloating(bar_);
    connect(&bench.frame, &Frame::started, this, &SessionRecovery::look);
    connect(bar_, &MessageBar::closed, this, &SessionRecovery::offerNext);
  }

  /// Looks for workspaces in the background and offers the latest.
  void look() {
    using Left = std::vector<OrphanedWorkspace>;
    job_.start<Left>(
        [root = autosave_.root(), journals = bench_.document.journalFolder()](const Progress&) {
          Left left = root.empty() ? Left() : orphaned_workspaces(root);
          std::erase_if(left, [](const OrphanedWorkspace& each) {
            if (each.project.scenes.empty()) discard_workspace(each.folder);
            return each.project.scenes.empty();
          });
          for (OrphanedWorkspace& each : left) {
            if (!journals.empty()) name_journals(each.project, journals);
          }
          return left;
        },
        [this](Left left) {
          left_ = std::move(left);
          std::ranges::reverse(left_);
          offerNext();
        });
  }

 private:
  void offerNext() {
    if (left_.empty()) {
      bench_.frame.settle();
      return;
    }
    const OrphanedWorkspace left = left_.back();
    left_.pop_back();
    offer(left);
  }

  void offer(const OrphanedWorkspace& left) {
    bar_->showMessage(Severity::Warning,
                      tr("Episcope ended unexpectedly (%1). What was open can be recovered: %2.")
                          .arg(short_text(left.last_change), content_of(left.project)),
                      {tr("Recover"), [this, left] { takeOver(left); }},
                      {tr("Discard…"), [this, left] { askToDiscard(left); }});
  }

  void askToDiscard(const OrphanedWorkspace& left) {
    QStringList names;
    for (const ProjectScene& scene : left.project.scenes) {
      names << QString::fromStdString(scene.name);
    }
    confirm_discarding(
        &bench_.window,
        tr("This deletes the results that the earlier session kept: %1. Its light fields were: %2.")
            .arg(result_count(left.project))
            .arg(listed(names)),
        [this, left] {
          discard_workspace(left.folder);
          offerNext();
        },
        [this, left] { offer(left); });
  }

  void takeOver(const OrphanedWorkspace& left) {
    using Read = std::shared_ptr<ReadProject>;
    job_.start<Read>(
        [project = left.project](const Progress&) {
          auto read = std::make_shared<ReadProject>();
          read->project = project;
          read_strokes(*read);
          return read;
        },
        [this, left](const Read& read) {
          const std::filesystem::path saved_as = read->project.saved_as;
          try {
            autosave_.takeOver(left.folder);
          } catch (const IoError& error) {
            bench_.messages.warn(QString::fromUtf8(error.what()));
            return offerNext();
          }
          const auto kept = show_project(bench_, std::move(*read), ProjectOrigin::Crash, [this] {
            bench_.messages.success(tr("Recovered what was open."));
          });
          autosave_.setProjectFile(saved_as);
          for (const std::filesystem::path& each : kept) {
            // What lies elsewhere is of a project of the user's.
            if (each.parent_path() == bench_.document.journalFolder()) discard_journal(each);
          }
          offerNext();
        });
  }

  Workbench bench_;
  Autosave& autosave_;
  MessageBar* bar_;
  std::vector<OrphanedWorkspace> left_;  // the one to be offered next comes last
  LatestJob job_;
};

void read_strokes(ReadProject& read) {
  for (std::size_t i = 0; i < read.project.scenes.size(); ++i) {
    const std::filesystem::path& file = read.project.scenes[i].strokes;
    if (file.empty()) continue;
    try {
      read.strokes.emplace(i, read_journal(file));
    } catch (const IoError& error) {
      read.failures << QString::fromUtf8(error.what());
    }
  }
}

namespace {

bool has_unsaved_work(const Workbench& bench, const OpenScene& open) {
  const auto unsaved = bench.document.unsavedScenes();
  const auto is_running_in = [&](Lane lane) {
    return std::ranges::any_of(bench.jobs.running(lane), [&](const Jobs::Running& each) {
      return each.scene == open.id && !each.is_expendable;
    });
  };
  const auto is_unsaved_here = [&](const Sweep& sweep) {
    return !sweep.is_saved && is_of_scene(sweep, open.id);
  };
  return !std::ranges::all_of(open.estimates, &EstimateEntry::is_saved) ||
         open.labels.is_unsaved() || has_work(open.place) ||
         std::ranges::count(unsaved, open.id) > 0 ||
         std::ranges::any_of(bench.scenes.sweeps().all(), is_unsaved_here) ||
         is_running_in(Lane::Estimate) || is_running_in(Lane::Label);
}

// A built-in scene is what a start without a file shows. Whatever was done stays open.
bool gives_way(const Workbench& bench, const OpenScene& open, const Project& project) {
  return (!builtin_scene_id(open.input).empty() ||
          std::ranges::count(project.scenes, open.input, &ProjectScene::input) > 0) &&
         !has_unsaved_work(bench, open);
}

void make_way(const Workbench& bench, const Project& project, ProjectOrigin origin) {
  bench.jobs.cancelLane(Lane::Open);
  for (const OpenScene* each : bench.session.scenes()) {
    if (origin == ProjectOrigin::Crash && !gives_way(bench, *each, project)) continue;
    const std::uint64_t id = each->id;
    id == bench.session.generation() ? bench.session.close() : bench.session.remove(id);
  }
}

}  // namespace

std::vector<std::filesystem::path> show_project(const Workbench& bench, ReadProject read,
                                                ProjectOrigin origin, std::function<void()> shown) {
  const bool is_saved = origin == ProjectOrigin::File;
  make_way(bench, read.project, origin);
  bench.session.set_bad_threshold(read.project.bad_threshold_px);
  std::uint64_t current = 0;
  std::vector<std::filesystem::path> kept;
  std::map<std::uint64_t, std::uint64_t> ids;  // of scenes: in the project, now
  for (std::size_t i = 0; i < read.project.scenes.size(); ++i) {
    const ProjectScene& scene = read.project.scenes[i];
    const std::uint64_t id = bench.session.add_aside(scene_of(scene, is_saved));
    ids[scene.id] = id;
    if (i <= read.project.current) current = id;
    const auto strokes = read.strokes.find(i);
    if (strokes == read.strokes.end()) {
      bench.session.set_unread_strokes(id, scene.strokes);
      continue;
    }
    strokes->second.owner.source = scene.input;
    const auto stored = is_saved ? scene.strokes : std::filesystem::path();
    if (bench.document.bring(id, std::move(strokes->second), stored)) kept.push_back(scene.strokes);
  }
  for (Sweep& sweep : read.project.sweeps) {
    for (SweepScene& scene : sweep.scenes) scene.scene = ids[scene.scene];
    sweep.is_saved = is_saved;
    bench.scenes.sweeps().add(std::move(sweep));
  }
  if (!read.failures.isEmpty()) bench.messages.warn(read.failures.join(' '));
  bench.scenes.show(current, std::move(shown));
  return kept;
}

void add_session_recovery(const Workbench& bench, Autosave& autosave) {
  new SessionRecovery(bench, autosave);
}

}  // namespace episcope

#include "moc_autosave.cpp"

#include "autosave.moc"
