// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

enum class CloudColoring { Image, Disparity, Error, Labels, Distance, Source };

/// What is shown with the result.
enum class CloudCompanion { None, Truth, Other };

/// What a user chose to see in 3D.
struct CloudChoice {
  CloudColoring coloring = CloudColoring::Image;
  CloudCompanion companion = CloudCompanion::None;
  bool is_beside = false;   ///< Both side by side; else at their places.
  bool is_surface = false;  ///< Joined to a surface; else points.
  double jump_px = 0.1;     ///< Where the surface is cut: px of disparity per pixel.
  friend bool operator==(const CloudChoice&, const CloudChoice&) = default;
};

}  // namespace episcope
