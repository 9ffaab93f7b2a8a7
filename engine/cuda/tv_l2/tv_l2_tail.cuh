// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/device/device_stream.cuh"
#include "engine/cuda/tv_l2/tv_l2_level.cuh"

namespace episcope::cuda {

/// The levels of few pixels, from `first` on: a block for each view goes through all of them.
struct TvL2Tail {
  TvL2Levels levels;
  int first = 1;
  int views = 0;
  TvL2View* of_views = nullptr;
};

/// Whether the levels from `first` on are few enough pixels for that.
[[nodiscard]] bool fits_in_tail(const TvL2Levels& levels, int first);
/// Solves the levels of the tail, coarse to fine; z of the first is projected at the end.
void climb_tail(const DeviceStream& stream, const TvL2Tail& tail, int iterations,
                int penalty_every);
/// Penalties and diagonals of the tail, from those of the level before, for a solution of `stage`.
void renew_tail(const DeviceStream& stream, const TvL2Tail& tail, int stage);
/// The multigrid correction u of the tail's first level, from its b.
void correct_tail(const DeviceStream& stream, const TvL2Tail& tail, int stage);

}  // namespace episcope::cuda
