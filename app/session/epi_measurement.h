// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/camera_grid.h"
#include "engine/core/epi.h"

#include <optional>
#include <string>
#include <vector>

namespace episcope {

/// A disparity that was measured along a line in an EPI.
struct EpiMeasurement {
  std::string name{};
  EpiDirection direction = EpiDirection::Horizontal;
  ViewIndex view{};    ///< Whose row or column of views the EPI runs through,
  PixelIndex pixel{};  ///< and where the line meets it.
  double disparity_px = 0;
  friend bool operator==(const EpiMeasurement&, const EpiMeasurement&) = default;
};

/// Those that are kept with a scene.
struct Measurements {
  std::vector<EpiMeasurement> list;
  int current = -1;  ///< Index of the one that is chosen; −1 = none.
  friend bool operator==(const Measurements&, const Measurements&) = default;
};

/// The one that is chosen; null if none is.
[[nodiscard]] const EpiMeasurement* current_of(const Measurements& measurements);

/// Depth of a measured point, in the unit of the camera's baseline; none if the camera is not known
/// or no point in front of it has that disparity.
[[nodiscard]] std::optional<double> depth_of(const EpiMeasurement& measurement,
                                             const CameraGrid& camera);

/// A table with a header line: name, direction (row or column of views), view v and u, pixel y and
/// x, slope of the line in px per view step, disparity in px per view step, depth where it is
/// known.
[[nodiscard]] std::string measurements_csv(const std::vector<EpiMeasurement>& list,
                                           const CameraGrid& camera);

}  // namespace episcope
