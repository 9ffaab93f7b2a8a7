// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/point_cloud.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace episcope {

/// Clouds of one scene, shared with whoever made them.
using CloudParts = std::vector<CloudPart>;
using CloudPartsPtr = std::shared_ptr<const CloudParts>;

/// A point of one of them.
struct PickedPoint {
  std::size_t part = 0;
  std::size_t point = 0;
};

/// A named place among the clouds, in their coordinates; drawn over whatever lies in front.
struct CloudMark {
  std::array<double, 3> at{};
  std::string name{};
  bool is_emphasised = false;
  friend bool operator==(const CloudMark&, const CloudMark&) = default;
};

/// How clouds are drawn, whatever they are.
struct CloudLook {
  double z_stretch = 1;    ///< Factor on z, > 0.
  double point_size = 2;   ///< Logical pixels.
  bool is_shaded = false;  ///< Surfaces are lit from the viewer.
  /// What is drawn, as parts of the depth of the scene: 0 = nearest, 1 = farthest. At the ends
  /// nothing is cut.
  double clip_near = 0;
  double clip_far = 1;
  friend bool operator==(const CloudLook&, const CloudLook&) = default;
};

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

/// A surface for the 3D view, lit from the viewer: vertex i is position i, with y and z turned (a
/// mesh has y downwards and z forwards, like images). Faces are three indices of vertices. Linear.
[[nodiscard]] PointCloud make_mesh_cloud(std::span<const std::array<float, 3>> vertices,
                                         std::span<const std::array<std::uint32_t, 3>> faces);

}  // namespace episcope
