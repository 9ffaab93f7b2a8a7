// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/files/autosave.h"

#include "app/gui/scene/scene_switcher.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/session/open_scene.h"
#include "app/session/project_file.h"
#include "app/session/project_store.h"
#include "app/session/user_folders.h"
#include "engine/core/error.h"
#include "widgets/controls/text.h"

#include <algorithm>

namespace episcope {
namespace {

namespace fs = std::filesystem;

constexpr int kLater_ms = 500;  // what changes with every movement of the hand

// Merely opened light fields are not worth keeping: they open again as quickly.
bool is_worth_keeping(const Project& project) {
  return project.scenes.size() > 1 || !project.sweeps.empty() ||
         std::ranges::any_of(project.scenes, [](const ProjectScene& scene) {
           return !scene.results.empty() || scene.labels.covers_many() || has_work(scene.place);
         });
}

// The part of a project that is in files.
Project written_part(Project project) {
  for (ProjectScene& scene : project.scenes) {
    std::erase_if(scene.results, [](const ProjectResult& each) { return !is_in_file(each); });
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
  if (is_over_ && workspace_) workspace_->remove();
}

void Autosave::follow(Parts parts) {
  if (parts.has_any(Part::Scene | Part::Scenes | Part::Estimates | Part::Measured | Part::Capture |
                    Part::Judged | Part::LabelLook)) {
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
    for (ProjectResult& result : scene.results) {
      if (is_in_file(result)) continue;
      result.file = store_result(folder, scene.name, result, scene.input, progress);
      kept.results.emplace_back(result.id, result.file);
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
  if (workspace_) workspace_->remove();
  workspace_ = std::move(taken);  // written when its scenes are open
}

void Autosave::setProjectFile(fs::path file) {
  project_file_ = std::move(file);
  emit projectFileChanged();
  schedule();
}

}  // namespace episcope

#include "moc_autosave.cpp"
