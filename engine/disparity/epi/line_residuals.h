// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/view_stack.h"
#include "engine/disparity/common/packed_views.h"
#include "engine/disparity/epi/line_residual_kernel.h"

#include <vector>

namespace episcope {

/// Computes how well rays agree with their lines, row by row of one view after the other; one per
/// thread. The residual of a ray of disparity d is the mean squared colour difference (samples in
/// [0, 1], squares summed over channels) between it and its line in up to four neighbouring views
/// on one side, the minimum over the four sides; infinite where too few views on every side show
/// the line. In an opaque scene a line can only be hidden by something nearer, and seldom on all
/// sides.
class LineResiduals {
 public:
  explicit LineResiduals(const PackedViews& views);

  void begin(ViewIndex view);

  /// `width` residuals of row y for these disparities, valid until the next call.
  [[nodiscard]] const float* row(int y, const float* disparity);

 private:
  const PackedViews& views_;
  const ResidualKernel& kernel_;
  std::vector<std::uint32_t> own_;
  std::vector<float> slopes_, residual_;
  ViewIndex view_;
  ResidualRow row_;
};

/// The variance of the noise, summed over channels: the median residual of the centre view, which
/// `disparity` must cover. 0 if no ray has a residual.
[[nodiscard]] float residual_noise(const PackedViews& views, const ViewStack<float>& disparity);
/// The median residual of another view.
[[nodiscard]] float residual_noise(const PackedViews& views, ViewIndex view,
                                   ImageView<const float> disparity);

}  // namespace episcope
