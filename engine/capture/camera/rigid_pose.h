// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace episcope::capture {

/// A point in space, in the unit of the mesh.
struct Point3 {
  double x = 0;
  double y = 0;
  double z = 0;
  friend bool operator==(const Point3&, const Point3&) = default;
};

/// Where an object lies: X_camera = R·X_object + t. The frame of the camera has x to the right, y
/// downwards and z forwards; its origin is the pinhole of the centre view.
struct RigidPose {
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< R row by row.
  std::array<double, 3> translation{};                        ///< t in the unit of the mesh.

  [[nodiscard]] Point3 apply(const Point3& p) const {
    const auto& r = rotation;
    const auto& t = translation;
    return {r[0] * p.x + r[1] * p.y + r[2] * p.z + t[0],
            r[3] * p.x + r[4] * p.y + r[5] * p.z + t[1],
            r[6] * p.x + r[7] * p.y + r[8] * p.z + t[2]};
  }
};

}  // namespace episcope::capture
