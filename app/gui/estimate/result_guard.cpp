// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/estimate/result_guard.h"

#include "app/gui/frame/dialogs.h"
#include "app/gui/frame/jobs.h"
#include "app/gui/frame/leave_guards.h"
#include "app/gui/frame/messages.h"
#include "app/session/save/save_result.h"
#include "app/session/session.h"

#include <QAbstractButton>

#include <utility>

namespace episcope {
namespace {

// "scene_EPI_L 2.h5", whatever the name holds.
std::filesystem::path file_of(const std::string& scene, const EstimateEntry& entry) {
  std::string name = scene + "_" + entry.name + ".h5";
  for (char& each : name) {
    if (each == '/' || each == '\\') each = '_';
  }
  return name;
}

}  // namespace

ResultGuard::ResultGuard(const Workbench& bench) : QObject(&bench.owner), bench_(bench) {
  bench.guards.add({.may_leave = [this] { return mayLeave(); },
                    .ask = [this](const Continue& go_on) { ask(go_on); },
                    .is_of_results = true});
  bench.session.on_changed([this](Parts parts) {
    if (parts.has_any(Part::Scene | Part::Estimates)) is_settled_ = false;
  });
  connect(&bench.jobs, &Jobs::added, this, [this] {
    const int count = bench_.jobs.count(Lane::Estimate);
    if (count == 1 && !is_settled_) running_.start();
    if (count > settled_jobs_) is_settled_ = false;
  });
}

std::vector<EstimateEntry> ResultGuard::unsaved() const {
  std::vector<EstimateEntry> found;
  for (const EstimateEntry& entry : bench_.session.estimates()) {
    if (!entry.is_saved && entry.estimate->seconds >= worth_keeping_s_) found.push_back(entry);
  }
  return found;
}

bool ResultGuard::isRunning() const {
  return bench_.jobs.count(Lane::Estimate) > 0 && running_.isValid() &&
         static_cast<double>(running_.elapsed()) >= 1000 * worth_keeping_s_;
}

bool ResultGuard::mayLeave() const {
  return is_settled_ || (unsaved().empty() && !isRunning());
}

QString ResultGuard::sentence() const {
  const auto results = unsaved();
  QStringList names;
  for (const EstimateEntry& each : results) names << QString::fromStdString(each.name);
  QStringList sentences;
  if (!names.isEmpty()) {
    sentences << tr("Not saved: %1.").arg(names.join(QStringLiteral(", ")));
  }
  if (isRunning()) sentences << tr("A method is still running; its result would be lost.");
  return sentences.join(' ');
}

void ResultGuard::ask(const Continue& go_on) {
  if (mayLeave()) {
    go_on();
    return;
  }
  if (question_) {
    question_->raise();
    return;
  }
  const bool has_unsaved = !unsaved().empty();
  question_ =
      new QMessageBox(QMessageBox::Question,
                      has_unsaved ? tr("Unsaved results") : tr("A method is running"), sentence(),
                      (has_unsaved ? QMessageBox::SaveAll : QMessageBox::NoButton) |
                          QMessageBox::Discard | QMessageBox::Cancel,
                      &bench_.window);
  question_->setObjectName("unsaved_results");
  question_->setAttribute(Qt::WA_DeleteOnClose);
  question_->setDefaultButton(has_unsaved ? QMessageBox::SaveAll : QMessageBox::Cancel);
  connect(question_, &QMessageBox::buttonClicked, this,
          [this, box = question_.data(), go_on](QAbstractButton* button) {
            const auto answer = box->standardButton(button);
            question_ = nullptr;
            if (answer == QMessageBox::SaveAll) saveAll(go_on);
            if (answer != QMessageBox::Discard) return;
            is_settled_ = true;
            settled_jobs_ = bench_.jobs.count(Lane::Estimate);
            go_on();
          });
  question_->open();
}

void ResultGuard::saveAll(const Continue& go_on) {
  ask_for_folder(&bench_.window, {.name = "save_results", .title = tr("Folder for the results")},
                 [this, go_on](const QString& folder) {
                   bench_.jobs.start<bool>(
                       Lane::Export, tr("Saving results"),
                       [results = unsaved(), folder = std::filesystem::path(folder.toStdString()),
                        scene = bench_.session.light_field()->info().name,
                        input = bench_.session.input()](const Progress& progress) {
                         for (const EstimateEntry& each : results) {
                           save_result(folder / file_of(scene, each), *each.estimate, input,
                                       progress);
                         }
                         return true;
                       },
                       [this, results = unsaved(), folder, go_on](bool) {
                         for (const EstimateEntry& each : results)
                           bench_.session.mark_saved(each.id);
                         bench_.messages.written(folder);
                         ask(go_on);
                       });
                 });
}

}  // namespace episcope

#include "moc_result_guard.cpp"
