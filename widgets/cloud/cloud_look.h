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

/// Clouds of one scene, shared with their creator.
using CloudParts = std::vector<CloudPart>;
using CloudPartsPtr = std::shared_ptr<const CloudParts>;

struct PickedPoint {
  std::size_t part = 0;
  std::size_t point = 0;
};

/// A named mark among the clouds, in their coordinates; never hidden.
struct CloudMark {
  std::array<double, 3> at{};
  std::string name{};
  bool is_emphasised = false;
  friend bool operator==(const CloudMark&, const CloudMark&) = default;
};

/// How clouds are drawn.
struct CloudLook {
  double z_stretch = 1;    ///< Factor on z, > 0.
  double point_size = 2;   ///< Logical pixels.
  bool is_shaded = false;  ///< Surfaces are lit from the viewer.
  /// Visible range as fractions of the scene's depth: 0 = nearest, 1 = farthest. The defaults clip
  /// nothing.
  double clip_near = 0;
  double clip_far = 1;
  friend bool operator==(const CloudLook&, const CloudLook&) = default;
};

enum class CloudColoring { Image, Disparity, Error, Labels, Distance, Source };

/// What is shown together with the result.
enum class CloudCompanion { None, Truth, Other };

/// The user's choice in the 3D view.
struct CloudChoice {
  CloudColoring coloring = CloudColoring::Image;
  CloudCompanion companion = CloudCompanion::None;
  bool is_beside = false;   ///< Both side by side; else at their places.
  bool is_surface = false;  ///< Joined to a surface; else points.
  double jump_px = 0.1;     ///< Where the surface is cut: px of disparity per pixel.
  friend bool operator==(const CloudChoice&, const CloudChoice&) = default;
};

/// Surface for the 3D view, lit from the viewer. Vertex i is position i with y and z negated, since
/// a mesh has y downwards and z forwards, like images. Faces are three vertex indices. Linear.
[[nodiscard]] PointCloud make_mesh_cloud(std::span<const std::array<float, 3>> vertices,
                                         std::span<const std::array<std::uint32_t, 3>> faces);

}  // namespace episcope
