// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/camera/rigid_pose.h"

#include <string>

namespace episcope::capture {

/// A point of the centre view and the same point of the mesh, picked by hand.
struct PointPair {
  std::string name;
  double x_px = 0;  ///< Centres of pixels have whole coordinates.
  double y_px = 0;
  Point3 point;            ///< In the frame of the mesh.
  bool is_locked = false;  ///< It is right: never a wrong pick, of full weight.
  friend bool operator==(const PointPair&, const PointPair&) = default;
};

}  // namespace episcope::capture
