// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/tensor/structure_tensor_kernel.h"

#include <vector>

namespace episcope {

/// Scales of the structure tensor on epipolar plane images.
struct TensorScales {
  double inner = 0.5;   ///< σ_i in px and views: Gaussian before the derivatives.
  double outer = 1.0;   ///< σ_o in px: Gaussian over the products of derivatives, along the EPI.
  double views = 1.5;   ///< The same along the views.
  double across = 1.0;  ///< The same in px across neighbouring EPIs.
  double contrast = 2;  ///< Gradients above this are toned down, in 1/255; 255 = none are.
  double noise = 0.15;  ///< Contrast below which coherence fades, in 1/255.
};

/// The filters of a structure tensor over an EPI of some views, with the memory they live in.
struct TensorFilterSet {
  TensorFilters filters;  ///< Its rows point into the vectors below.
  Taps across;            ///< Average over neighbouring EPIs.
  int view_reach = 0;     ///< How many views away samples still matter for a result.
  std::vector<RowTaps> row_smooth, row_derivative, row_integrate;
};

/// Half the length of the Gaussian of that σ.
[[nodiscard]] int gaussian_radius(double sigma);

/// Gaussians cut at 2σ and normalised; along the views truncated at the first and last and
/// renormalised. σ = 0 leaves a filter out.
[[nodiscard]] TensorFilterSet make_tensor_filters(int rows, int channels,
                                                  const TensorScales& scales);

}  // namespace episcope
