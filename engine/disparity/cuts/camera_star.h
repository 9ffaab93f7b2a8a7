// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/core/light_field/light_field.h"

#include <cstdint>
#include <vector>

namespace episcope {

/// A view beside the reference view, in its row or its column of the camera grid, and where it sees
/// what the reference view sees at each label: a point of disparity d lies −d·distance pixels on
/// along that axis. Places are whole pixels, as in [KZ02]; what rounding leaves is kept.
struct SideView {
  ViewIndex view;
  bool is_vertical = false;     ///< The axis: y instead of x.
  std::vector<int> shift{};     ///< Pixels at each label, rounded.
  std::vector<float> beyond{};  ///< Exact minus rounded, in [−½, ½].

  /// Where the side view sees pixel (y, x) at `label`: perhaps beyond the image.
  [[nodiscard]] PixelIndex place(int y, int x, int label) const {
    return is_vertical ? PixelIndex{y + shift[label], x} : PixelIndex{y, x + shift[label]};
  }
  /// The reverse.
  [[nodiscard]] PixelIndex place_in_reference(int y, int x, int label) const {
    return is_vertical ? PixelIndex{y - shift[label], x} : PixelIndex{y, x - shift[label]};
  }
};

/// The views nearest to `distance` view steps left, right, above and below the reference: those
/// that the grid has. Labels are disparities, px per view step.
[[nodiscard]] std::vector<SideView> side_views(GridShape grid, ViewIndex reference, int distance,
                                               const std::vector<float>& labels);

/// The samples of a view in units of 1/255, one plane for each channel, its border repeated by
/// `kMargin` pixels on all sides; NaN where a pixel is not valid.
class CameraImage {
 public:
  static constexpr int kMargin = 2;

  CameraImage(const LightField& light_field, ViewIndex view);

  [[nodiscard]] int channels() const { return static_cast<int>(planes_.size()); }
  /// Pixel (y, 0) of a plane; y and x may leave the image by the margin.
  [[nodiscard]] const float* row(int channel, int y) const {
    return planes_[channel].row(y + kMargin) + kMargin;
  }
  [[nodiscard]] long pitch() const { return planes_[0].width(); }

 private:
  std::vector<Image<float>> planes_;
};

}  // namespace episcope
