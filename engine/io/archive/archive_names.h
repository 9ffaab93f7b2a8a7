// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope::io {

/// What Episcope adds to a light-field file of the archive form; other programs ignore it.

/// Attribute of the root: how depth becomes disparity, then the order of views.
inline constexpr const char* kConvention = "convention";
inline constexpr const char* kConventionText =
    "d = dH*focalLength/Z - shift; point at (x,y) in view (v,h) is at (x-d,y) in (v,h+1) and "
    "(x,y-d) in (v+1,h)";
/// Attribute of the root: x and y of the camera of each view, row by row; and their unit.
inline constexpr const char* kPositions = "camera_positions";
inline constexpr const char* kPositionUnit = "camera_position_unit";
/// Attribute of the root: the pinhole of the centre view: focal length, x and y of its centre in
/// px.
inline constexpr const char* kPinhole = "pinhole";
/// Dataset `[v][h][y][x]`, uint8: 0 = the pixel holds nothing that was seen.
inline constexpr const char* kValid = "VALID";
/// Datasets `[y][x]`, uint8: a region mask of the centre view, whose name follows.
inline constexpr const char* kRegionPrefix = "REGION_";

}  // namespace episcope::io
