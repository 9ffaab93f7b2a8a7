// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/space/point_cloud.h"

#include <array>
#include <cstddef>
#include <memory>
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

}  // namespace episcope
