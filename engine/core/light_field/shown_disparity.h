// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/disparity_field.h"

namespace episcope {

/// Disparity of one view without the pixels that its light field does not show.
class ShownDisparity {
 public:
  /// `shown`: 0 = the pixel holds nothing (LightField::valid_of), of the size of `map`; empty = all
  /// are shown, and `map` stays as it is. Both are borrowed.
  ShownDisparity(const DisparityView& map, ImageView<const std::uint8_t> shown) : view_(map) {
    if (shown.empty()) return;
    valid_ = Image<std::uint8_t>(shown.height, shown.width);
    for (int y = 0; y < shown.height; ++y) {
      for (int x = 0; x < shown.width; ++x) {
        valid_.at(y, x) = shown.at(y, x) != 0 && map.is_valid(y, x) ? 1 : 0;
      }
    }
    view_.valid = valid_.view();
  }
  ShownDisparity(const ShownDisparity&) = delete;
  ShownDisparity& operator=(const ShownDisparity&) = delete;

  /// Valid as long as this object.
  [[nodiscard]] const DisparityView& view() const { return view_; }

 private:
  Image<std::uint8_t> valid_;
  DisparityView view_;
};

}  // namespace episcope
