// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/view_stack.h"

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
};

}  // namespace episcope
