// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/device/device_stream.cuh"
#include "engine/cuda/tv_l2/tv_l2_level.cuh"

namespace episcope::cuda {

/// Sums over the pixels of every view, `[view][chunk][which]`: always added in the same order.
inline constexpr int kTvL2Sums = 3;
inline constexpr int kTvL2ChunkRows = 8;
[[nodiscard]] inline int chunks_of(const TvL2Level& level) {
  return (level.height + kTvL2ChunkRows - 1) / kTvL2ChunkRows;
}

/// Σ c, Σ c·f, Σ c·f².
void sum_moments(const DeviceStream& stream, const TvL2Level& level, int views, double* sums);
/// P(u), D(p), and nothing.
void sum_energies(const DeviceStream& stream, const TvL2Level& level, int views, double* sums);

}  // namespace episcope::cuda
