// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"

#include <algorithm>
#include <limits>

namespace episcope::io {

/// 8-bit RGB of one view, for the first look at a scene.
template <class T>
[[nodiscard]] Image<std::uint8_t> preview_rgb(ImageView<const T> view) {
  Image<std::uint8_t> rgb(view.height, view.width, 3);
  const auto to_byte = [](T value) {
    if constexpr (std::is_same_v<T, std::uint8_t>) return value;
    const double unit =
        static_cast<double>(value) /
        (std::is_integral_v<T> ? static_cast<double>(std::numeric_limits<T>::max()) : 1.0);
    return static_cast<std::uint8_t>(255 * std::clamp(unit, 0.0, 1.0) + 0.5);
  };
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      for (int c = 0; c < 3; ++c) rgb.at(y, x, c) = to_byte(view.at(y, x, c % view.channels));
    }
  }
  return rgb;
}

}  // namespace episcope::io
