// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/pose/point_pair.h"

#include <string>
#include <vector>

namespace episcope {

/// What a user has prepared to find the pose of a mesh before a light field.
struct CaptureWork {
  std::string mesh{};  ///< File; empty = none was opened.
  std::vector<capture::PointPair> pairs{};

  [[nodiscard]] bool empty() const { return mesh.empty() && pairs.empty(); }
  friend bool operator==(const CaptureWork&, const CaptureWork&) = default;
};

}  // namespace episcope
