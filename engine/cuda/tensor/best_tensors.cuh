// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/tensor/derivative_planes.cuh"
#include "engine/cuda/tensor/orientations.h"

#include <algorithm>
#include <cstdlib>

namespace episcope::cuda {

/// Views whose tensors a block finds together.
inline constexpr int kViewsTogether = 9;

/// What is looked for in the EPIs of one direction, on the device.
struct TensorSearchFilters {
  const ViewFilter* smooth = nullptr;  ///< One for each view, likewise those below.
  const ViewFilter* derivative = nullptr;
  const ViewFilter* integrate = nullptr;
  int first_shear = 0, shear_step = 0, shear_count = 0;  ///< In half pixels.
  LaneTaps along, along_half;
  float contrast_energy = 0, noise_energy = 0;
  float limit = 0, min = 0, max = 0;
  bool eigenvector = false;

  /// Of their absolute values.
  [[nodiscard]] int largest_shear() const {
    const int last = first_shear + (shear_count - 1) * shear_step;
    return std::max(std::abs(first_shear), std::abs(last));
  }
  [[nodiscard]] bool has_half_shear() const { return ((first_shear | shear_step) & 1) != 0; }
};

/// The same for nine views, by value: [of][from] along the views.
struct NineViewFilters {
  bool fits = false;  ///< Whether the views are nine, and the filters short enough.
  int reach = 0;      ///< Of the filters before products.
  float smooth[9][9] = {}, derivative[9][9] = {}, integrate[9][9] = {};
};
[[nodiscard]] NineViewFilters nine_view_filters(const ViewFilters& filters);

/// Lanes beyond both ends of a view that `find_best_tensors` reads.
[[nodiscard]] int needed_margin(const ViewFilters& filters, int largest_shear, int smooth_radius,
                                int integrate_radius);

/// Views [first, last) of an EPI whose tensors are wanted.
struct WantedViews {
  int first = 0, last = 0;
  [[nodiscard]] __host__ __device__ int count() const { return last - first; }
};

/// Writes the tensor of the most coherent shear, back in unsheared coordinates, to `best`:
/// `[wanted view][Jxx, Jxs, Jss][EPI][lane]`, 0 where no shear is accepted; see TensorKernel,
/// OrientationKernel::select and EigenvectorKernel.
void find_best_tensors(const EpiBand& band, const DerivativePlanes& planes,
                       const TensorSearchFilters& filters, const NineViewFilters& nine,
                       WantedViews wanted, float* best, const DeviceStream& stream);

}  // namespace episcope::cuda
