// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/isa.h"
#include "engine/disparity/kernels/structure_tensor_kernel.h"

namespace episcope {

/// Filters of the second-order tensor, made by `double_orientation.cpp`. Orders of derivation are
/// 0, 1, 2; along the image axis the pre-smoothing is part of the filter.
struct SecondOrderFilters {
  Taps along[3];  ///< Smoothing, first and second derivative along the image axis: one radius.
  Taps views[3];  ///< The same along the views, derivatives by u or v.
  Taps integrate;
  Taps across;
  const float* row_weights = nullptr;  ///< [row][product row]: integration along the views.
  /// The derivatives f_xx, f_xu, f_uu are made uncorrelated and of unit variance under white noise:
  /// w = (scale[0] f_xx, scale[1] f_xu, scale[2] f_uu + mix f_xx).
  float scale[3] = {1, 1, 1};
  float mix = 0;
  float contrast_energy = 0;  ///< Energy of w at which its weight in the tensor is halved.
  float noise_energy = 0;     ///< Second eigenvalue at which confidence is halved.
};

/// Buffers and geometry of one tile: planes of one view each, `[y][x]` with all margins, flattened
/// to `lanes`. The image axis of the EPI is x (horizontal EPIs) or y: neighbors along it lie
/// `along` lanes apart, neighboring EPIs `across` lanes. All buffers belong to the caller and have
/// slack on either side.
struct DoubleBlock {
  int rows = 0;                             ///< Views along the EPI.
  int first_product = 0, last_product = 0;  ///< Views [first, last) where derivatives exist.
  int channels = 0;
  int along = 1, across = 1;
  long lanes = 0;  ///< Of one plane, without its slack.
  long pitch = 0;  ///< Lanes from plane to plane.

  float* samples = nullptr;  ///< [c][row] planes; NaN = invalid, if `has_invalid`.
  /// Whether samples may be NaN: derivatives that one of them enters then count nothing.
  bool has_invalid = false;
  float* derivative[3] = {};  ///< [c][row] planes by order along the image axis.
  float* product[6] = {};     ///< [product row] planes: xx, xu, xU, uu, uU, UU (U = f_uu).
  float* scratch = nullptr;   ///< One plane.
};

/// Disparities near this shear, whole px per view step, are measured.
struct DoubleShear {
  int step = 0;
  float limit = 0;         ///< Largest |mean of both disparities − step| accepted.
  float min = 0, max = 0;  ///< Disparities beyond are not accepted.
  float min_distance = 0;  ///< Of both disparities.
};

/// One run of lanes of one view, and where the best answer so far is kept.
struct DoubleRun {
  int row = 0;
  long begin = 0;  ///< Lane of the planes.
  int count = 0;
  float* near = nullptr;
  float* far = nullptr;
  float* confidence = nullptr;  ///< The better answer has the larger; 0 = none.
};

struct DoubleOrientationKernel {
  /// Fills `derivative` from `samples`.
  void (*differentiate)(const DoubleBlock&, const SecondOrderFilters&);
  /// Fills `product` for one shear: integrated along the image axis and across EPIs, not yet along
  /// the views. Only lanes whose sources are inside the plane are right.
  void (*accumulate)(const DoubleBlock&, const SecondOrderFilters&, int step);
  /// Integrates along the views, solves for both disparities and keeps the better answer.
  void (*select)(const DoubleBlock&, const SecondOrderFilters&, const DoubleShear&,
                 const DoubleRun&);
};

EPISCOPE_DECLARE_KERNEL(extern const DoubleOrientationKernel kDoubleOrientationKernel);

}  // namespace episcope
