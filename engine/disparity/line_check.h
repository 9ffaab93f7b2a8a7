// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/schema.h"
#include "engine/core/view_stack.h"
#include "engine/disparity/estimator.h"
#include "engine/disparity/kernels/line_kernel.h"
#include "engine/disparity/view_samples.h"

#include <vector>

namespace episcope {

/// Computes how well rays agree with their lines, row by row of one view after the other; one per
/// thread. The residual of a ray of disparity d is the mean squared color difference (samples in
/// [0, 1], squares summed over channels) between it and its line in up to four neighboring views
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

/// The variance of the noise, summed over channels: the median residual of the center view, which
/// `disparity` must cover. 0 if no ray has a residual.
[[nodiscard]] float residual_noise(const PackedViews& views, const ViewStack<float>& disparity);
/// The median residual of another view.
[[nodiscard]] float residual_noise(const PackedViews& views, ViewIndex view,
                                   ImageView<const float> disparity);

/// Decides for every ray near a jump of disparity to which side of it the ray belongs. The window
/// of a structure tensor that straddles a silhouette reports the foreground's disparity for pixels
/// of the background (foreground fattening), where a line of the background is visible in half of
/// the views only.
///
/// Besides its own disparity d, a ray can take the least or the largest disparity of 12 neighbors,
/// 3 px away in the eight directions of the grid (diagonally 3 in x and y) and 6 px away in four;
/// the least only of neighbors that have 0.2 times its confidence.
/// Each of the three is judged by the residuals of its map (LineResiduals, which sees lines by
/// halves), at most 3·(n² + 1/255²), summed over 5×5 pixels with weights (1 − t/4)⁴,
/// t = |difference of color|²/(2σ²), σ² = (8/255)² + 2n², 0 where t > 4; n² is the median residual
/// of the center view (residual_noise). The far side wins if its sum is below 0.95 of the own one
/// and not above the near one's, else the near side if its sum is below 0.8 of the own one: windows
/// fatten the foreground, not the background. Sides less than 0.2 px from d do not count. The ray
/// takes disparity and confidence of the winner. A ray that stays more than 0.5 px in front of the
/// far side keeps only the part of its confidence that the lines support: 0.25 + 1.5·(far/own − 1)
/// of it, at most all, far and own being the sums. All rays are judged by the estimate before the
/// call, so the order of processing does not matter.
///
/// `estimate.field` and `estimate.confidence` cover the center view. Throws Cancelled. Evidence:
/// tests/accuracy/tuning.md.
void choose_sides(const PackedViews& packed_views, Estimate& estimate, const Progress& progress);

/// Chooses sides in maps of any views, given the noise n².
void choose_sides(const PackedViews& packed_views, float noise, ViewStack<float>& disparity,
                  ViewStack<float>& confidence, const Progress& progress);

/// Lowers the confidence of local estimates that the other views contradict: every element of
/// `estimate.confidence` is multiplied by (t_line·t_texture)^¼, each t in (0, 1]. The fourth root,
/// because a confidence to the power 6 becomes the data weight, and a stricter one would give up
/// bars that are one or two pixels wide. Both factors address the band beside a silhouette where a
/// window that straddles it reports the foreground's disparity for background pixels (foreground
/// fattening), which coherence alone does not detect.
///
/// t_line = s²/(s² + max(0, e − n²)): e is the mean squared color difference between the pixel and
/// its line in up to four neighboring views on one side, the minimum over the four sides. In an
/// opaque scene a line can only be hidden by something nearer, and seldom on all sides: a disparity
/// that no side confirms is wrong. n² is the median of e over the center view, the noise; s² =
/// (1/255)² + n².
///
/// t_texture = min(1, 4·(own + s²)/(window + s²)): `window` is the mean squared gradient over 5×5
/// px, `own` the gradient of the pixel, along each axis the smaller of its two differences. A pixel
/// without texture of its own beside a strong edge has been given the edge's orientation.
///
/// Pixels of other views that are not valid (LightField::valid) do not count for t_line.
///
/// The estimate must cover the center view. Memory: 4 bytes per ray of the light field. Throws
/// Cancelled. Evidence: tests/accuracy/tuning.md.
void reduce_confidence(const LightField& light_field, Estimate& estimate, const Progress& progress);

/// Takes views that are already packed (pack_views), for several estimates of one light field.
void reduce_confidence(const PackedViews& packed_views, Estimate& estimate,
                       const Progress& progress);

/// Lowers the confidence of maps of any views, given the noise n².
void reduce_confidence(const PackedViews& packed_views, float noise,
                       const ViewStack<float>& disparity, ViewStack<float>& confidence,
                       const Progress& progress);

/// Steps of a method where the views contradict a local estimate.
struct LineCheck {
  bool chooses_sides = true;  ///< choose_sides
  bool is_on = true;          ///< reduce_confidence
  [[nodiscard]] bool does_anything() const { return chooses_sides || is_on; }
};
[[nodiscard]] Schema<LineCheck> line_check_schema();

/// Runs the steps, sides first. Throws Cancelled.
void check_lines(const PackedViews& packed_views, const LineCheck& check, Estimate& estimate,
                 const Progress& progress);

/// Noise of the center view that a check of some views needs: first for choosing sides, then for
/// reducing confidence. `center` holds the maps of that view.
[[nodiscard]] std::vector<double> line_check_noise(const LightField& light_field,
                                                   const LineCheck& check, BlockMaps center,
                                                   const Progress& progress);
/// Checks whole maps of any views, given that noise; `packed_views` hold up to kMaxArmViews around
/// each. Throws Cancelled.
void check_lines(const PackedViews& packed_views, const LineCheck& check,
                 const std::vector<double>& noise, BlockMaps& maps, const Progress& progress);

/// Packs the views if need be and runs the steps on a device. Throws DeviceFailure, Cancelled.
void check_lines(const LightField& light_field, const LineCheck& check, Estimate& estimate,
                 const Progress& progress, Device device = Device::Cpu);

}  // namespace episcope
