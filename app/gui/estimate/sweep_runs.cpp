// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/estimate/sweep_runs.h"

#include "app/gui/estimate/method_runs.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/scene/scene_switcher.h"
#include "app/gui/shell/jobs.h"
#include "app/session/session.h"
#include "engine/core/error.h"
#include "engine/disparity/registry.h"

#include <QPointer>

#include <functional>
#include <string>
#include <utility>

namespace episcope {
namespace {

/// What a worker does.
struct Work {
  struct Of {
    std::uint64_t scene = 0;
    std::string name;
    SceneSource source;
  };
  std::vector<Of> scenes;
  EstimateRequest base;
  std::vector<ParameterSet> points;
  std::function<void(std::uint64_t scene, const SweepPoint&)> tell;
};

// Every point of an unreadable light field tells why.
std::shared_ptr<const Scene> read(const Work& work, const Work::Of& of, const Progress& progress) {
  try {
    return of.source(progress);
  } catch (const Error& error) {
    for (const ParameterSet& each : work.points) {
      SweepPoint failed;
      failed.point = each;
      failed.problem = error.what();
      work.tell(of.scene, failed);
    }
    return nullptr;
  }
}

void run_scene(const Work& work, const Work::Of& of, const Progress& progress) {
  const auto scene = read(work, of, progress.part(0, 0.02));
  if (!scene) return;
  const Progress running = progress.part(0.02, 1);
  EstimatePtr reference;
  const auto count = static_cast<double>(work.points.size());
  for (std::size_t i = 0; i < work.points.size(); ++i) {
    const auto begin = static_cast<double>(i);
    std::string step = std::to_string(i + 1) + " / " + std::to_string(work.points.size());
    if (work.scenes.size() > 1) step = of.name + ", " + step;
    const SweepPoint point =
        run_sweep_point(*scene, work.base, work.points[i], reference.get(),
                        running.part(begin / count, (begin + 1) / count).titled(step));
    if (i == 0) reference = point.estimate;
    work.tell(of.scene, point);
  }
}

bool run_all(const Work& work, const Progress& progress) {
  const auto count = static_cast<double>(work.scenes.size());
  for (std::size_t i = 0; i < work.scenes.size(); ++i) {
    const auto begin = static_cast<double>(i);
    run_scene(work, work.scenes[i], progress.part(begin / count, (begin + 1) / count));
  }
  return true;
}

}  // namespace

SweepRuns::SweepRuns(const Workbench& bench) : QObject(&bench.owner), bench_(bench) {
  bench.scenes.sweeps().on_changed([this] {
    if (isRunning() && !bench_.scenes.sweeps().find(sweep_)) bench_.jobs.cancel(job_);
  });
}

std::uint64_t SweepRuns::run(Sweep sweep, const std::vector<ParameterSet>& points) {
  Work work;
  work.base = sweep.base;
  work.points = points;
  for (const SweepScene& each : sweep.scenes) {
    const OpenScene& open = *bench_.session.find_scene(each.scene);
    work.scenes.push_back(
        {each.scene, each.name, scene_source(open, bench_.opener.cacheFolder(), true)});
  }
  const std::uint64_t only = work.scenes.size() == 1 ? work.scenes.front().scene : 0;
  QString title =
      tr("Sweep of %1").arg(QString::fromStdString(find_estimator(sweep.base.method).info.name));
  if (only != 0) title = job_title(title, *bench_.session.find_scene(only));
  const std::uint64_t id = bench_.scenes.sweeps().add(std::move(sweep));
  work.tell = [post = queued_post(&bench_.jobs), self = QPointer(this), id](
                  std::uint64_t scene, const SweepPoint& point) {
    post([self, id, scene, point] {
      if (self) self->bench_.scenes.sweeps().add_point(id, scene, point);
    });
  };
  sweep_ = id;
  job_ = bench_.jobs.start<bool>(
      Lane::Estimate, title,
      [work = std::move(work)](const Progress& progress) { return run_all(work, progress); },
      [](bool) {},
      [this, id] {
        job_ = 0;
        emit ended(id);
      });
  bench_.jobs.setScene(job_, only);
  return id;
}

}  // namespace episcope

#include "moc_sweep_runs.cpp"
