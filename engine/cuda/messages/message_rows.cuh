// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// How rows of messages are worked on: a block takes a group of rows, each of its warps one of them
/// and a pixel behind the row before. A group waits for single values of the one before it, which
/// hold `kNotYet` until they are there.

#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/messages/message_sweeps.cuh"

#include <cuda_pipeline.h>

#include <algorithm>
#include <type_traits>

namespace episcope::cuda {

inline constexpr unsigned kAllLanes = 0xFFFFFFFFU;
inline constexpr int kNotYet = -1;  ///< The bits of a NaN that no operation gives.
inline constexpr float kFar = 1e30F;

/// Rows of a group, and pixels that are read ahead.
template <int kEach>
inline constexpr int kGroupRows = kEach <= 8 ? 8 : 4;
template <int kEach>
inline constexpr int kAhead = kEach <= 4 ? 4 : 2;

/// Floats of one pixel, one for each label of each lane.
template <int kEach>
inline constexpr int kPixelFloats = kEach * kWarp;

/// Labels of one pixel that a lane holds.
template <int kEach>
struct LaneLabels {
  float of[kEach] = {};

  __device__ void read(const float* from) {
#pragma unroll
    for (int k = 0; k < kEach; ++k) of[k] = from[k * kWarp + threadIdx.x];
  }
  __device__ void write(float* to) const {
#pragma unroll
    for (int k = 0; k < kEach; ++k) to[k * kWarp + threadIdx.x] = of[k];
  }
  __device__ void add(const LaneLabels& other) {
#pragma unroll
    for (int k = 0; k < kEach; ++k) of[k] += other.of[k];
  }
};

/// Begins to copy one pixel into shared memory; a whole warp calls it.
template <int kEach>
__device__ void begin_to_copy(float* to, const float* from) {
  for (int i = static_cast<int>(threadIdx.x); i < kPixelFloats<kEach> / 4; i += kWarp) {
    __pipeline_memcpy_async(to + 4 * i, from + 4 * i, 4 * sizeof(float));
  }
}

/// Numbers in the order of the floats that have the same bits but where the sign is set.
__device__ inline int ordered_bits(float value) {
  const int bits = __float_as_int(value);
  return bits ^ ((bits >> 31) & 0x7FFFFFFF);
}
__device__ inline float from_ordered_bits(int bits) {
  return __int_as_float(bits ^ ((bits >> 31) & 0x7FFFFFFF));
}

/// Groups that are on the device at the same time: one that waits must not keep out what it waits
/// for.
template <class Kernel>
unsigned groups_at_once(Kernel kernel, int rows, int height, std::size_t shared_bytes) {
  int device = 0, processors = 0, each = 0;
  check(cudaGetDevice(&device));
  check(cudaDeviceGetAttribute(&processors, cudaDevAttrMultiProcessorCount, device));
  check(cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize,
                             static_cast<int>(shared_bytes)));
  check(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&each, kernel, rows * kWarp, shared_bytes));
  const int groups = (height + rows - 1) / rows;
  return static_cast<unsigned>(std::min(groups, std::max(1, processors * each)));
}

/// Calls run(kEach) for the labels that each lane holds.
template <class Run>
void with_labels(const MessageField& field, const Run& run) {
  switch (field.each()) {
    case 1: return run(std::integral_constant<int, 1>());
    case 2: return run(std::integral_constant<int, 2>());
    case 3: return run(std::integral_constant<int, 3>());
    case 4: return run(std::integral_constant<int, 4>());
    case 8: return run(std::integral_constant<int, 8>());
    default: return run(std::integral_constant<int, kMostEach>());
  }
}

}  // namespace episcope::cuda
