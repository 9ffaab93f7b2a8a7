// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/tv_l2/tv_l2_penalty.cuh"
#include "engine/cuda/tv_l2/tv_l2_run.cuh"
#include "engine/cuda/tv_l2/tv_l2_tail.cuh"

namespace episcope::cuda {
namespace {

constexpr int kTailThreads = 512;

// Level k as it serves while `stage` is solved: a multigrid cell weighs as much as its pixels
// together; CoarsenProblem halves that.
__device__ TvL2Level level_of(const TvL2Tail& tail, int k, int stage) {
  TvL2Level level = tail.levels.level[k];
  level.data_scale = static_cast<float>(1 << (k - stage));
  return level;
}

__device__ void coarsen_penalties(const TvL2Tail& tail, int view, int stage, int begin) {
  for (int k = begin; k < tail.levels.count; ++k) {
    const TvL2Level fine = level_of(tail, k - 1, stage), coarse = level_of(tail, k, stage);
    run_in_block(CoarsenPenalty{fine, coarse, tail.of_views}, cells_of(coarse), view);
    run_in_block(InvertDiagonal{coarse}, extent_of(coarse), view);
  }
}

// From b of level `begin` to its u.
__device__ void correct(const TvL2Tail& tail, int view, int stage, int begin) {
  const int last = tail.levels.count - 1;
  for (int k = begin; k < last; ++k) {
    const TvL2Level fine = level_of(tail, k, stage), coarse = level_of(tail, k + 1, stage);
    run_in_block(RelaxFromZero{fine}, extent_of(fine), view);
    run_in_block(RelaxColour{fine, 1}, extent_of(fine), view);
    run_in_block(Restrict{fine, coarse}, cells_of(coarse), view);
  }
  // The last level is a single pixel, of colour 0.
  run_in_block(RelaxFromZero{level_of(tail, last, stage)}, {1, 1}, view);
  for (int k = last; --k >= begin;) {
    const TvL2Level fine = level_of(tail, k, stage), coarse = level_of(tail, k + 1, stage);
    run_in_block(CorrectAndRelax{fine, coarse}, extent_of(fine), view);
    run_in_block(RelaxColour{fine, 0}, extent_of(fine), view);
  }
}

__device__ void iterate(const TvL2Tail& tail, int view, int stage, int iteration,
                        int penalty_every) {
  const TvL2Level level = level_of(tail, stage, stage), coarse = level_of(tail, stage + 1, stage);
  if (iteration % penalty_every == 0) {
    run_in_block(Penalise{level, tail.of_views, iteration == 0}, extent_of(level), view);
    run_in_block(InvertDiagonal{level}, extent_of(level), view);
    coarsen_penalties(tail, view, stage, stage + 1);
  }
  if (iteration > 0) {
    correct(tail, view, stage, stage + 1);
    run_in_block(CorrectAndRelax{level, coarse}, extent_of(level), view);
    run_in_block(RelaxColour{level, 0}, extent_of(level), view);
  }
  run_in_block(MoveDual{level, tail.of_views}, extent_of(level), view);
  run_in_block(RenewAndRelax{level}, extent_of(level), view);
  run_in_block(RelaxColour{level, 1}, extent_of(level), view);
  run_in_block(Restrict{level, coarse}, cells_of(coarse), view);
}

__global__ void climb(TvL2Tail tail, int iterations, int penalty_every) {
  const int view = static_cast<int>(blockIdx.x);
  int stage = tail.levels.count - 2;
  if (stage < tail.first) return;
  run_in_block(StartFromData{tail.levels.level[stage]}, extent_of(tail.levels.level[stage]), view);
  for (;; --stage) {
    for (int i = 0; i < iterations; ++i) iterate(tail, view, stage, i, penalty_every);
    const TvL2Level level = tail.levels.level[stage];
    run_in_block(Project{level}, extent_of(level), view);
    if (stage == tail.first) return;
    const TvL2Level fine = tail.levels.level[stage - 1];
    run_in_block(Prolong{level, fine}, extent_of(fine), view);
    run_in_block(Project{fine}, extent_of(fine), view);
  }
}

__global__ void renew(TvL2Tail tail, int stage) {
  const int view = static_cast<int>(blockIdx.x);
  if (tail.of_views[view].is_active != 0) coarsen_penalties(tail, view, stage, tail.first);
}

__global__ void correct_all(TvL2Tail tail, int stage) {
  const int view = static_cast<int>(blockIdx.x);
  if (tail.of_views[view].is_active != 0) correct(tail, view, stage, tail.first);
}

}  // namespace

void climb_tail(const DeviceStream& stream, const TvL2Tail& tail, int iterations,
                int penalty_every) {
  launch(stream, {"tv_l2: small levels, climb"}, [&] {
    climb<<<tail.views, kTailThreads, 0, stream.get()>>>(tail, iterations, penalty_every);
  });
}

void renew_tail(const DeviceStream& stream, const TvL2Tail& tail, int stage) {
  launch(stream, {"tv_l2: small levels, penalty"},
         [&] { renew<<<tail.views, kTailThreads, 0, stream.get()>>>(tail, stage); });
}

void correct_tail(const DeviceStream& stream, const TvL2Tail& tail, int stage) {
  launch(stream, {"tv_l2: small levels, correction"},
         [&] { correct_all<<<tail.views, kTailThreads, 0, stream.get()>>>(tail, stage); });
}

}  // namespace episcope::cuda
