// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/view_stack.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace episcope {

/// Disparity of one view, borrowed: px per view step, positive = nearer than the zero plane.
struct DisparityView {
  ImageView<const float> disparity;
  ImageView<const std::uint8_t> valid;  ///< 0 = no value there; empty = all valid.

  [[nodiscard]] bool is_valid(int y, int x) const {
    return (valid.empty() || valid.at(y, x) != 0) && std::isfinite(disparity.at(y, x));
  }
};

/// Disparity maps of all views or of one, `[v][u][y][x]`, with the validity mask beside them. NaN
/// exists in files only: readers turn it into the mask, writers turn it back.
struct DisparityField {
  ViewStack<float> disparity;
  ViewStack<std::uint8_t> valid;  ///< Same shape, 0 = invalid; empty = all valid.

  [[nodiscard]] bool empty() const { return disparity.empty(); }
  [[nodiscard]] bool contains(ViewIndex view) const { return !empty() && disparity.contains(view); }
  /// Precondition: `contains(view)`.
  [[nodiscard]] DisparityView view(ViewIndex view) const {
    return {disparity.view(view),
            valid.empty() ? ImageView<const std::uint8_t>{} : valid.view(view)};
  }
  [[nodiscard]] DisparityField clone() const { return {disparity.clone(), valid.clone()}; }
  /// Makes the mask, all pixels valid, unless there is one.
  void require_mask() {
    if (!valid.empty()) return;
    valid = ViewStack<std::uint8_t>(disparity.grid(), disparity.height(), disparity.width(), 1,
                                    disparity.first());
    std::fill_n(valid.data(), valid.size(), std::uint8_t{1});
  }

  /// Disparity 0 of which no pixel is valid.
  [[nodiscard]] static DisparityField unknown(GridShape grid, int height, int width,
                                              ViewIndex first) {
    DisparityField field{ViewStack<float>(grid, height, width, 1, first),
                         ViewStack<std::uint8_t>(grid, height, width, 1, first)};
    std::fill_n(field.disparity.data(), field.disparity.size(), 0.0F);
    std::fill_n(field.valid.data(), field.valid.size(), std::uint8_t{0});
    return field;
  }
};

/// Further results of a method that estimates two layers (transparent scenes).
struct LayeredDisparity {
  DisparityField foreground;
  DisparityField background;
  ViewStack<std::uint8_t> layers;  ///< 1 or 2 surfaces per pixel; 0 = unknown.
};

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
