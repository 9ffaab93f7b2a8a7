// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// The part of an EPI that one block searches, and the coordinates in which a disparity stands
/// upright.

#include "engine/cuda/tensor/best_tensors.cuh"

namespace episcope::cuda {

inline constexpr int kSearchLanes = 128;    ///< Of a view, for each block.
inline constexpr int kSearchThreads = 160;  ///< With the lanes that shears and filters reach.

struct SearchJob {
  EpiBand band;
  DerivativePlanes planes;
  TensorSearchFilters filters;
  WantedViews wanted;
  float* best;
  int tensor_pitch;  ///< Lanes from part to part of the tensors of a view.
};

/// What a block searches.
struct SearchPlace {
  int epi;    ///< Of the band.
  int first;  ///< Lane.
  int lanes;
  WantedViews views;
};

__device__ inline SearchPlace search_place(const SearchJob& job) {
  const int first = static_cast<int>(blockIdx.x) * kSearchLanes;
  const int view = job.wanted.first + static_cast<int>(blockIdx.z) * kViewsTogether;
  return {static_cast<int>(blockIdx.y),
          first,
          min(kSearchLanes, job.band.length - first),
          {view, min(view + kViewsTogether, job.wanted.last)}};
}

/// One shear: disparity k stands upright if view r is read at x − k·(r − centre).
struct ShearFrame {
  int half_steps, center;
  [[nodiscard]] __device__ int steps(int view) const { return half_steps * (view - center); }
  /// The lane of sheared coordinates at which lane 0 of a view stands, or half a pixel before it.
  [[nodiscard]] __device__ int start(int view) const { return steps(view) >> 1; }
  [[nodiscard]] __device__ bool is_half(int view) const { return (steps(view) & 1) != 0; }
  /// Where a view is read for lane 0 of sheared coordinates.
  [[nodiscard]] __device__ int source(int view) const { return -steps(view) >> 1; }
};

/// Lanes of sheared coordinates from `begin` on that the wanted views take in.
struct ShearWindow {
  int begin, count;
};

__device__ inline ShearWindow shear_window(const SearchJob& job, const SearchPlace& place,
                                           const ShearFrame& shear) {
  const int a = shear.start(place.views.first), b = shear.start(place.views.last - 1);
  const int taps = job.filters.along.count;
  return {place.first + min(a, b) - taps / 2, place.lanes + abs(a - b) + taps};
}

/// Tensors of a block in sheared coordinates, `[view][part][lane]`: place 0 of each view is the
/// first lane that filters along the EPI take in for its first lane.
struct ShearedTensors {
  float* values;
  int pitch;
  [[nodiscard]] __device__ float* of(int view) const { return values + 3 * view * pitch; }
};

}  // namespace episcope::cuda
