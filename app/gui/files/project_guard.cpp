// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/files/project_guard.h"

#include "app/gui/files/project_controller.h"
#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/scene_switcher.h"
#include "app/gui/shell/dialogs.h"
#include "app/gui/shell/jobs.h"
#include "app/session/load_scene.h"
#include "app/session/session.h"

#include <QAbstractButton>

#include <algorithm>

namespace episcope {
namespace {

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

ProjectGuard::ProjectGuard(const Workbench& bench, ProjectController& project)
    : QObject(&bench.owner), bench_(bench), project_(project) {
  bench.guards.add({.may_leave = [this](Leaving what) { return loss(what).empty(); },
                    .ask = [this](Leaving what, const Continue& go_on) { ask(what, go_on); }});
  bench.session.on_changed([this](Parts parts) {
    if (parts.has_any(Part::Scene | Part::Scenes | Part::Estimates | Part::Capture |
                      Part::Measured)) {
      is_settled_ = false;
    }
  });
  bench.scenes.sweeps().on_changed([this] { is_settled_ = false; });
  connect(&bench.jobs, &Jobs::added, this, [this] {
    const int count = bench_.jobs.count(Lane::Estimate);
    if (count == 1 && !is_settled_) running_.start();
    if (count > settled_jobs_) is_settled_ = false;
  });
}

ProjectGuard::Loss ProjectGuard::loss(Leaving what) const {
  Loss loss;
  if (is_settled_ || what == Leaving::Reading) return loss;
  const Session& session = bench_.session;
  const bool has_file = !project_.file().isEmpty();
  for (const OpenScene* scene : session.scenes()) {
    if (what == Leaving::Scene && scene->id != session.generation()) continue;
    if (!has_file && has_picks(*scene)) loss.picked.push_back(scene->name);
    if (!has_file && !scene->place.measured.list.empty()) loss.measured.push_back(scene->name);
    for (const EstimateEntry& entry : scene->estimates) {
      const double seconds = entry.estimate ? entry.estimate->seconds : worth_keeping_s_;
      if (!entry.is_saved && (has_file || seconds >= worth_keeping_s_)) {
        loss.results.push_back(entry.name);
      }
    }
  }
  for (const Sweep& sweep : bench_.scenes.sweeps().all()) {
    const bool is_left = what != Leaving::Scene ||
                         std::ranges::count(sweep.scenes, session.generation(), &SweepScene::scene);
    if (is_left && !sweep.is_saved && (has_file || seconds_of(sweep) >= worth_keeping_s_)) {
      loss.results.push_back(
          tr("sweep of %1").arg(QString::fromStdString(sweep.base.method)).toStdString());
    }
  }
  loss.is_running = isRunning();
  if (what != Leaving::Session) return loss;
  loss.of_project = project_.hasChanged();
  for (const std::uint64_t id : bench_.document.unsavedScenes()) {
    // Alone and without a project, scribbles go to a file of their own, which is asked for later.
    if (id == session.generation() && session.scenes().size() == 1 && !has_file) continue;
    if (const OpenScene* scene = session.find_scene(id)) loss.scribbled.push_back(scene->name);
  }
  return loss;
}

bool ProjectGuard::isRunning() const {
  return bench_.jobs.count(Lane::Estimate) > 0 && running_.isValid() &&
         static_cast<double>(running_.elapsed()) >= 1000 * worth_keeping_s_;
}

QString ProjectGuard::sentence(const Loss& loss) {
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
  if (loss.is_running) {
    sentences << tr("A method is still running; its result would be lost.");
  }
  return sentences.join(' ');
}

void ProjectGuard::ask(Leaving what, const Continue& go_on) {
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
                       .title = has_unsaved ? tr("Unsaved work") : tr("A method is running"),
                       .text = sentence(lost),
                       .buttons = (has_unsaved ? QMessageBox::SaveAll : QMessageBox::NoButton) |
                                  QMessageBox::Discard | QMessageBox::Cancel});
  question_->setDefaultButton(has_unsaved ? QMessageBox::SaveAll : QMessageBox::Cancel);
  connect(question_, &QMessageBox::buttonClicked, this,
          [this, box = question_.data(), what, go_on](QAbstractButton* button) {
            question_ = nullptr;
            answer(box->standardButton(button), what, go_on);
          });
  question_->open();
}

void ProjectGuard::answer(QMessageBox::StandardButton button, Leaving what, const Continue& go_on) {
  if (button == QMessageBox::SaveAll) project_.save([this, what, go_on] { ask(what, go_on); });
  if (button != QMessageBox::Discard) return;
  is_settled_ = true;
  settled_jobs_ = bench_.jobs.count(Lane::Estimate);
  if (what == Leaving::Session) bench_.document.discardAll();
  go_on();
}

}  // namespace episcope

#include "moc_project_guard.cpp"
