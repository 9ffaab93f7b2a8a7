// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <string>

namespace episcope::io {

using Direction = std::array<double, 3>;

[[nodiscard]] inline double dot(const Direction& a, const Direction& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
[[nodiscard]] inline Direction times(double factor, const Direction& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}

/// With the length 1.
[[nodiscard]] inline Direction normalized(const Direction& a) {
  return times(1 / std::sqrt(dot(a, a)), a);
}

/// Where a camera stood, in the coordinates of the scene, and what it saw as right, down and ahead:
/// vectors of length 1.
struct CameraPose {
  std::string image;  ///< Name of its file, as its file of poses states it; maybe without suffix.
  std::array<double, 3> center{};
  Direction right{};
  Direction down{};
  Direction ahead{};
  double focal_widths = 0;  ///< Focal length in widths of the image; 0 = not stated.

  [[nodiscard]] bool is_finite() const {
    for (const auto& vector : {center, right, down, ahead}) {
      for (const double value : vector) {
        if (!std::isfinite(value)) return false;
      }
    }
    return true;
  }
};

}  // namespace episcope::io
