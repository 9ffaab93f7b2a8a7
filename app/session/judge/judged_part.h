// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/pixel_rect.h"

#include <algorithm>
#include <cstdint>
#include <string>

namespace episcope {

/// Which pixels of the judged view metrics are of.
enum class JudgedPixels : std::uint8_t {
  Whole,
  Rectangle,
  Label,   ///< The current one.
  Common,  ///< Where all results have values.
  Mask     ///< Of a file.
};

/// The same with what it takes to find them.
struct JudgedPart {
  JudgedPixels pixels = JudgedPixels::Whole;
  PixelRect rectangle{};  ///< Stays while others are chosen; empty = none was drawn.
  std::string mask{};     ///< Path of an image; stays as well; empty = none was chosen.
  friend bool operator==(const JudgedPart&, const JudgedPart&) = default;
};

/// What of a rectangle lies in an image of this size; may be empty.
[[nodiscard]] inline PixelRect clipped(const PixelRect& rectangle, int height, int width) {
  return {std::max(rectangle.y0, 0), std::max(rectangle.x0, 0), std::min(rectangle.y1, height),
          std::min(rectangle.x1, width)};
}

}  // namespace episcope
