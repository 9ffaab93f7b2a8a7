// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/estimate/method_runs.h"

#include "app/gui/scene/scene_opener.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/session/load_scene.h"
#include "app/session/session.h"
#include "engine/disparity/registry.h"
#include "widgets/controls/text.h"
#include "widgets/panels/method_panel.h"

#include <algorithm>

namespace episcope {

ViewSelection views_of(bool all_views) {
  return all_views ? ViewSelection::All : ViewSelection::Center;
}

EstimateRequest request_of(const RunRequest& request) {
  return {request.method, request.values, {.views = views_of(request.all_views)}};
}

MethodRuns::MethodRuns(const Workbench& bench) : bench_(bench) {
  bench.session.on_changed([this](Parts parts) {
    if (parts.has(Part::Scenes)) cancelClosed();
  });
  connect(&bench.jobs, &Jobs::removed, this, [this](quint64 job) {
    if (runs_.erase(job) > 0) emit changed();
  });
}

void MethodRuns::run(const EstimateRequest& request, const OpenScene& scene) {
  const EstimatorInfo info = find_estimator(request.method).info;
  const QString method = QString::fromStdString(info.name);
  const quint64 job = bench_.jobs.start<FinishedEstimate>(
      Lane::Estimate, job_title(method, scene),
      [request, source = scene_source(scene, bench_.opener.cacheFolder(), false)](
          const Progress& progress) {
        return run_estimator(*source(progress), find_estimator(request.method), request.parameters,
                             request.options, progress);
      },
      [this, id = scene.id](const FinishedEstimate& finished) {
        bench_.session.add_estimate(finished.estimate, finished.display_range, id);
        if (finished.warning.empty()) return;
        bench_.messages.warn(with_minus(QString::fromStdString(finished.warning)));
      });
  runs_[job] = scene.id;
  bench_.jobs.setScene(job, scene.id);
  if (info.iterative) bench_.jobs.setIterative(job);
  emit changed();
}

bool MethodRuns::isRunning(std::uint64_t scene) const {
  return std::ranges::any_of(runs_, [scene](const auto& run) { return run.second == scene; });
}

std::vector<quint64> MethodRuns::jobsOn(std::uint64_t scene) const {
  std::vector<quint64> jobs;
  for (const auto& [job, of] : runs_) {
    if (of == scene) jobs.push_back(job);
  }
  return jobs;
}

void MethodRuns::cancelClosed() {
  for (const auto& [job, scene] : runs_) {
    if (!bench_.session.find_scene(scene)) bench_.jobs.cancel(job);
  }
}

SceneSource scene_source(const OpenScene& scene, const std::filesystem::path& cache,
                         bool needs_truth) {
  if (scene.scene) return [loaded = scene.scene](const Progress&) { return loaded; };
  LoadOptions options;
  options.open = io::open_schema().parse(scene.reading);
  options.cache_folder = cache;
  options.needs_truth = needs_truth;
  return [input = scene.input, options](const Progress& progress) {
    return std::make_shared<const Scene>(load_scene(input, options, progress));
  };
}

}  // namespace episcope

#include "moc_method_runs.cpp"
