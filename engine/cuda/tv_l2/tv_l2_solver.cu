// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/tv_l2/tv_l2_iteration.cuh"
#include "engine/cuda/tv_l2/tv_l2_penalty.cuh"
#include "engine/cuda/tv_l2/tv_l2_run.cuh"
#include "engine/cuda/tv_l2/tv_l2_solver.cuh"
#include "engine/cuda/tv_l2/tv_l2_sums.cuh"
#include "engine/cuda/tv_l2/tv_l2_tail.cuh"

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope::cuda {
namespace {

// As engine/solvers/tv_l2/tv_l2.cpp.
constexpr float kMinWeight = 1e-4F;
constexpr int kCoarseIterations = 20;
constexpr int kPenaltyEvery = 10;
constexpr int kCheckEvery = 10;
constexpr float kPenaltyScale = 5.0F;
constexpr float kPenaltyKnee = 0.07F;
constexpr float kSafePace = 1.0F;

// The data term from images `[view][y][x]`.
struct Load {
  TvL2Level level;
  TvL2Images images;
  float inverse_lambda = 1;

  __device__ void operator()(int view, int y, int i) const {
    for_pixels(level, i, [&](int x) {
      const long from = (static_cast<long>(view) * level.height + y) * level.width + x;
      const long to = level.at(y, x);
      const float value = images.f[from];
      const bool known = isfinite(value);
      const float weight = known ? (images.w ? images.w[from] : 1.0F) : 0.0F;
      const float c = fmaxf(weight, kMinWeight) * inverse_lambda;
      level.of(TvL2Plane::C, view)[to] = c;
      level.of(TvL2Plane::Cf, view)[to] = known ? c * value : 0.0F;
      level.of(TvL2Plane::G, view)[to] = images.g ? fmaxf(images.g[from], kMinWeight) : 1.0F;
    });
  }
};

struct Centre {
  TvL2Level level;
  const TvL2View* views;

  __device__ void operator()(int view, int y, int i) const {
    for_pixels(level, i, [&](int x) {
      const long at = level.at(y, x);
      level.of(TvL2Plane::Cf, view)[at] -= views[view].offset * level.of(TvL2Plane::C, view)[at];
    });
  }
};

// u to an image `[view][y][x]`.
struct Unload {
  TvL2Level level;
  const TvL2View* views;
  float* u;

  __device__ void operator()(int view, int y, int i) const {
    for_pixels(level, i, [&](int x) {
      u[(static_cast<long>(view) * level.height + y) * level.width + x] =
          level.of(TvL2Plane::U, view)[level.at(y, x)] + views[view].offset;
    });
  }
};

}  // namespace

TvL2DeviceSolver::TvL2DeviceSolver(int height, int width, int views, const DeviceStream& stream)
    : stream_(stream), grids_(height, width, views, stream) {
  const TvL2Levels& levels = grids_.levels();
  while (first_of_tail_ + 1 < levels.count && !fits_in_tail(levels, first_of_tail_))
    ++first_of_tail_;
  const std::size_t count =
      static_cast<std::size_t>(views) * chunks_of(levels.level[0]) * kTvL2Sums;
  sums_ = DeviceArray<double>(count, stream);
  host_sums_.resize(count);
}

TvL2Level TvL2DeviceSolver::level(int k, int stage) const {
  TvL2Level level = grids_.levels().level[k];
  level.data_scale = static_cast<float>(1 << (k - stage));
  return level;
}

template <class Step>
void TvL2DeviceSolver::run(const char* name, const Step& step, const TvL2Level& level,
                           double floats, double operations) {
  run_on_grid(stream_, name, step, extent_of(level), grids_.views(), grids_.of_views(), floats,
              operations);
}

template <class Step>
void TvL2DeviceSolver::run_cells(const char* name, const Step& step, const TvL2Level& coarse,
                                 double floats, double operations) {
  run_on_grid(stream_, name, step, cells_of(coarse), grids_.views(), grids_.of_views(), floats,
              operations);
}

void TvL2DeviceSolver::load(const TvL2Images& problem) {
  views_.assign(grids_.views(), {});
  grids_.set_views(views_, stream_);
  const TvL2Level finest = level(0, 0);
  run("tv_l2: load", Load{finest, problem, static_cast<float>(1 / problem.lambda)}, finest, 12, 6);
  sum_moments(stream_, finest, grids_.views(), sums_.data());
  centre();
  for (int k = 1; k < grids_.levels().count; ++k) {
    run("tv_l2: coarser problem", CoarsenProblem{level(k - 1, k - 1), level(k, k)}, level(k, k), 30,
        24);
  }
}

// Takes the mean off the data, and fits the penalty to their spread.
void TvL2DeviceSolver::centre() {
  measure();
  const int chunks = chunks_of(level(0, 0));
  for (std::size_t v = 0; v < views_.size(); ++v) {
    double sums[kTvL2Sums] = {};
    for (int i = 0; i < chunks * kTvL2Sums; ++i) {
      sums[i % kTvL2Sums] += host_sums_[v * chunks * kTvL2Sums + i];
    }
    const double mean = sums[1] / sums[0], variance = sums[2] / sums[0] - mean * mean;
    const float spread = variance > 1e-12 ? static_cast<float>(std::sqrt(variance)) : 1.0F;
    views_[v].offset = static_cast<float>(mean);
    views_[v].scale = kPenaltyScale / spread;
    views_[v].knee = kPenaltyKnee * spread;
  }
  grids_.set_views(views_, stream_);
  run("tv_l2: centre", Centre{level(0, 0), grids_.of_views()}, level(0, 0), 6, 4);
}

// Brings the sums of all chunks to the host.
void TvL2DeviceSolver::measure() {
  check(cudaMemcpyAsync(host_sums_.data(), sums_.data(), sums_.byte_size(), cudaMemcpyDeviceToHost,
                        stream_.get()));
  stream_.wait();
}

void TvL2DeviceSolver::renew_penalty(int stage, bool first) {
  const TvL2Level solved = level(stage, stage);
  run("tv_l2: penalty", Penalise{solved, grids_.of_views(), first}, solved, 20, 60);
  for (int k = stage + 1; k < first_of_tail_; ++k) {
    run_cells("tv_l2: coarser penalty",
              CoarsenPenalty{level(k - 1, stage), level(k, stage), grids_.of_views()},
              level(k, stage), 6, 4);
    run("tv_l2: diagonal", InvertDiagonal{level(k, stage)}, level(k, stage), 8, 14);
  }
  renew_tail(stream_, {grids_.levels(), first_of_tail_, grids_.views(), grids_.of_views()}, stage);
}

// The correction of level stage + 1.
void TvL2DeviceSolver::correct(int stage) {
  for (int k = stage + 1; k < first_of_tail_; ++k) {
    descend_level(stream_, level(k, stage), level(k + 1, stage), grids_.views(), grids_.of_views());
  }
  correct_tail(stream_, {grids_.levels(), first_of_tail_, grids_.views(), grids_.of_views()},
               stage);
  for (int k = first_of_tail_; --k > stage;) {
    ascend_level(stream_, level(k, stage), level(k + 1, stage), grids_.views(), grids_.of_views());
  }
}

void TvL2DeviceSolver::iterate(int stage, int iteration, const Progress& progress) {
  progress.check();
  if (iteration % kPenaltyEvery == 0) renew_penalty(stage, iteration == 0);
  if (iteration > 0) correct(stage);
  const TvL2Level solved = level(stage, stage);
  const auto run = has_enough_strips(solved, grids_.views()) ? iterate_by_strips : iterate_by_tiles;
  run(stream_, solved, level(stage + 1, stage), grids_.views(), grids_.of_views(), iteration == 0);
  grids_.swap_moved(stage);
}

// Coarse to fine, up to the start of the finest level.
void TvL2DeviceSolver::climb(const Progress& progress) {
  const int count = grids_.levels().count;
  climb_tail(stream_, {grids_.levels(), first_of_tail_, grids_.views(), grids_.of_views()},
             kCoarseIterations, kPenaltyEvery);
  // Of a tail that is the single pixel alone, nothing was solved.
  int stage = std::min(first_of_tail_, count - 2);
  if (stage < first_of_tail_)
    run("tv_l2: start", StartFromData{level(stage, stage)}, level(stage, stage), 12, 2);
  for (; stage > 0; --stage) {
    if (stage < first_of_tail_) {
      for (int i = 0; i < kCoarseIterations; ++i) iterate(stage, i, progress);
      run("tv_l2: project", Project{level(stage, stage)}, level(stage, stage), 10, 14);
    }
    const TvL2Level fine = level(stage - 1, stage - 1);
    run("tv_l2: prolong", Prolong{level(stage, stage), fine}, fine, 12, 40);
    run("tv_l2: project", Project{fine}, fine, 10, 14);
  }
}

// Ends views that have converged, and slows those down whose gap grows.
void TvL2DeviceSolver::judge(double gap, std::vector<double>& gaps_before) {
  sum_energies(stream_, level(0, 0), grids_.views(), sums_.data());
  measure();
  const int chunks = chunks_of(level(0, 0));
  for (std::size_t v = 0; v < views_.size(); ++v) {
    TvL2Outcome& outcome = outcomes_[v];
    if (views_[v].is_active == 0) continue;
    double energy = 0, dual = 0;
    for (int i = 0; i < chunks; ++i) {
      energy += host_sums_[(v * chunks + i) * kTvL2Sums];
      dual += host_sums_[(v * chunks + i) * kTvL2Sums + 1];
    }
    outcome.energy = energy;
    outcome.gap = energy - dual;
    outcome.converged = outcome.gap <= gap * energy;
    if (outcome.converged) views_[v].is_active = 0;
    if (outcome.gap > 2 * gaps_before[v]) {
      views_[v].coarse_edge = views_[v].relaxation = kSafePace;
    }
    gaps_before[v] = outcome.gap;
  }
  grids_.set_views(views_, stream_);
}

std::vector<TvL2Outcome> TvL2DeviceSolver::solve(const TvL2Images& problem, int max_iterations,
                                                 double gap, const Progress& progress, float* u) {
  load(problem);
  climb(progress);
  outcomes_.assign(grids_.views(), {});
  std::vector<double> gaps_before(grids_.views(), std::numeric_limits<double>::infinity());
  const auto is_active = [](const TvL2View& view) { return view.is_active != 0; };
  bool is_last = false;
  for (int i = 0; !is_last && std::ranges::any_of(views_, is_active); ++i) {
    is_last = i + 1 >= max_iterations || progress.finish_requested();
    iterate(0, i, progress);
    for (std::size_t v = 0; v < views_.size(); ++v) outcomes_[v].iterations += views_[v].is_active;
    if (is_last || (i + 1) % kCheckEvery == 0) judge(gap, gaps_before);
    progress.report(static_cast<double>(i + 1) / max_iterations);
  }
  for (TvL2View& view : views_) view.is_active = 1;
  grids_.set_views(views_, stream_);
  run("tv_l2: unload", Unload{level(0, 0), grids_.of_views(), u}, level(0, 0), 4, 2);
  return outcomes_;
}

}  // namespace episcope::cuda
