// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/pixel_rect.h"

#include <vector>

namespace episcope {

/// The pixels [x0, x1) of row y.
struct PixelSpan {
  int y = 0;
  int x0 = 0;
  int x1 = 0;
  [[nodiscard]] PixelRect rect() const { return {y, x0, y + 1, x1}; }
  friend bool operator==(const PixelSpan&, const PixelSpan&) = default;
};

/// A set of pixels of one view.
using PixelRegion = std::vector<PixelSpan>;

}  // namespace episcope
