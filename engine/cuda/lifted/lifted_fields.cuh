// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/volume.h"
#include "engine/cuda/device/device_stream.cuh"

namespace episcope::cuda {

/// As of engine/solvers/simplex/pair_duals.h and lifted_labeling_kernel.h.
inline constexpr int kLiftedPairs = 4;
inline constexpr int kLiftedThresholdCount = 3;

/// The unknowns of the solver and what they are held against, for kernels. φ, `ahead` and each
/// pair's duals are `[y][layer][x]`, the limits of each pair `[y][x]`.
struct LiftedFields {
  VolumeView<const float> cost;  ///< One layer more.
  float* phi = nullptr;
  float* ahead = nullptr;
  float* duals[kLiftedPairs] = {};
  float* limits[kLiftedPairs] = {};
  int* cuts[kLiftedThresholdCount] = {};  ///< Labels at each threshold, `[y][x]`.
  int steps = 0;                          ///< Layers of φ: labels − 1.
  float primal_step = 0, dual_step = 0;

  [[nodiscard]] __host__ __device__ int height() const { return cost.height; }
  [[nodiscard]] __host__ __device__ int width() const { return cost.width; }
  [[nodiscard]] __host__ __device__ long pixel(int y, int x) const {
    return static_cast<long>(y) * cost.width + x;
  }
  /// Where layer 0 of a pixel is among the unknowns, and among the costs.
  [[nodiscard]] __host__ __device__ long unknown(int y, int x) const {
    return static_cast<long>(y) * steps * cost.width + x;
  }
  [[nodiscard]] __host__ __device__ long costs_of(int y, int x) const {
    return static_cast<long>(y) * cost.layers * cost.width + x;
  }
};

/// The limits of the pairs' duals, as PairLimits has them.
void fill_limits(const LiftedFields& fields, const float* g, float weight,
                 const DeviceStream& stream);
/// φ becomes the step at the cheapest label, which is every cut; duals 0.
void start_lifting(const LiftedFields& fields, const DeviceStream& stream);
/// One iteration: φ and `ahead`, then the duals.
void iterate_lifting(const LiftedFields& fields, const DeviceStream& stream);

/// Sums that a check of the gap needs: of a bound and of the energy of each cut.
inline constexpr int kLiftedSums = 1 + kLiftedThresholdCount;
/// Parts that each of them is made of.
[[nodiscard]] int lifted_parts(const LiftedFields& fields);
/// Fills the cuts and the parts of the bound, which are to be added in their order;
void measure_bound(const LiftedFields& fields, double* parts, const DeviceStream& stream);
/// those of the energy of each cut, `[cut][part]`.
void measure_energies(const LiftedFields& fields, double* parts, const DeviceStream& stream);

}  // namespace episcope::cuda
