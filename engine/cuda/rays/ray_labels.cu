// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/rays/ray_labels.h"

#include "engine/cuda/device/transfer.cuh"
#include "engine/cuda/rays/ray_costs.cuh"
#include "engine/cuda/rays/ray_votes.cuh"
#include "engine/cuda/rays/view_rays.cuh"
#include "engine/cuda/simplex/simplex_batch.cuh"

#include <algorithm>
#include <utility>

namespace episcope::cuda {
namespace {

// Chains that are solved side by side: as many as half of the free memory holds.
int chains_at_once(const RayLabelsTask& task) {
  std::size_t free = 0, all = 0;
  check(cudaMemGetInfo(&free, &all));
  const auto& view = task.views.front().probabilities;
  const std::size_t each = SimplexBatch::bytes_of_problem(view.height, view.layers, view.width);
  const auto most = std::min<std::size_t>(kMostProblems, task.chains.size());
  return static_cast<int>(std::clamp<std::size_t>(free / 2 / each, 1, most));
}

class Labeling {
 public:
  Labeling(const RayLabelsTask& task, const Progress& progress)
      : task_(task),
        memory_(task, stream_, progress),
        rays_(memory_.rays()),
        at_once_(chains_at_once(task)),
        batch_(at_once_, rays_.height, rays_.layers, rays_.width, stream_),
        places_(static_cast<std::size_t>(rays_.pixels() * at_once_), stream_),
        labels_(static_cast<std::size_t>(rays_.pixels() * rays_.grid.count()), stream_) {}

  RayLabelsAnswer solve(const Progress& progress);
  void vote();
  void download(const Progress& progress, ViewStack<std::int32_t>& labels) {
    cuda::download(labels, labels_, stream_, progress);
  }

 private:
  void solve_link(const ProblemViews& views, bool is_first, const Progress& progress,
                  RayLabelsAnswer& sum);
  void solve_chains(std::size_t begin, std::size_t end, const Progress& progress,
                    RayLabelsAnswer& sum);

  const RayLabelsTask& task_;
  DeviceStream stream_;
  ViewRaysMemory memory_;
  const ViewRays& rays_;
  int at_once_;
  SimplexBatch batch_;
  DeviceArray<std::int32_t> places_, labels_;
};

// One view of each chain.
void Labeling::solve_link(const ProblemViews& views, bool is_first, const Progress& progress,
                          RayLabelsAnswer& sum) {
  fill_problems(rays_, views, task_.near_views, batch_.fields(), stream_);
  const std::int32_t* places = nullptr;
  if (!is_first && rays_.disparity != nullptr) {
    find_places(rays_, views, places_.data(), stream_);
    places = places_.data();
  }
  const SimplexSettings settings{task_.smoothness, task_.gap, task_.max_iterations,
                                 task_.check_every, task_.racing_iterations};
  for (const SimplexAnswer& answer : batch_.solve(views.count, places, settings, progress)) {
    sum.energy += answer.energy;
    sum.bound += answer.bound;
    sum.iterations = std::max(sum.iterations, answer.iterations);
  }
  for (int i = 0; i < views.count; ++i) {
    check(cudaMemcpyAsync(labels_.data() + views.view[i] * rays_.pixels(),
                          batch_.labels() + i * rays_.pixels(),
                          static_cast<std::size_t>(rays_.pixels()) * sizeof(std::int32_t),
                          cudaMemcpyDeviceToDevice, stream_.get()));
  }
}

void Labeling::solve_chains(std::size_t begin, std::size_t end, const Progress& progress,
                            RayLabelsAnswer& sum) {
  const auto longest = [&] {
    std::size_t length = 0;
    for (std::size_t i = begin; i < end; ++i) length = std::max(length, task_.chains[i].size());
    return length;
  }();
  for (std::size_t link = 0; link < longest; ++link) {
    ProblemViews views;
    // Those that go on keep their places.
    for (std::size_t i = begin; i < end; ++i) {
      const std::vector<int>& chain = task_.chains[i];
      if (link >= chain.size()) continue;
      views.view[views.count] = static_cast<std::int16_t>(chain[link]);
      views.last[views.count] = static_cast<std::int16_t>(chain[link > 0 ? link - 1 : 0]);
      ++views.count;
    }
    solve_link(views, link == 0, progress, sum);
    progress.report(static_cast<double>(begin + (end - begin) * (link + 1) / longest) /
                    static_cast<double>(task_.chains.size()));
  }
}

RayLabelsAnswer Labeling::solve(const Progress& progress) {
  RayLabelsAnswer sum;
  const auto step = static_cast<std::size_t>(at_once_);
  for (std::size_t begin = 0; begin < task_.chains.size(); begin += step) {
    solve_chains(begin, std::min(begin + step, task_.chains.size()), progress, sum);
  }
  return sum;
}

void Labeling::vote() {
  for (int round = 0; round < task_.votes; ++round) {
    DeviceArray<std::int32_t> decided(labels_.size(), stream_);
    vote_along_rays(rays_, labels_.data(), decided.data(), stream_);
    labels_ = std::move(decided);
  }
}

}  // namespace

RayLabelsAnswer label_rays(const RayLabelsTask& task, const Progress& progress,
                           ViewStack<std::int32_t>& labels) {
  Labeling labeling(task, progress.part(0, 0));
  const RayLabelsAnswer answer = labeling.solve(progress.part(0, 0.9));
  labeling.vote();
  labeling.download(progress.part(1, 1), labels);
  return answer;
}

}  // namespace episcope::cuda
