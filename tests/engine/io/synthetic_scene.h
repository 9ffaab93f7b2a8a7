// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/scene.h"

#include <cstdint>
#include <filesystem>

namespace episcope::test {

/// A textured slanted plane seen by a grid of cameras, exact in every view: disparity is
/// `d0 + slope_x·(x − w/2) + slope_y·(y − h/2)` in the center view.
struct PlaneOptions {
  GridShape grid{5, 5};
  int height = 64;
  int width = 80;
  double d0 = 0.3;
  double slope_x = 0.02;
  double slope_y = -0.01;
  int channels = 3;
};

/// Scene with a camera (baseline·focal length 60, zero disparity at depth 12), disparity of all
/// views, labels of all views (1 left, 2 right) and scribbles on the center view.
[[nodiscard]] Scene plane_scene(const PlaneOptions& options = {});

/// The views of a scene as they are, for writing to files by hand, `[v][u][y][x][c]` in bytes.
[[nodiscard]] const ViewStack<std::uint8_t>& bytes_of(const Scene& scene);

/// Largest absolute difference of the values that both fields hold; infinite if they differ in
/// views or in which pixels are valid.
[[nodiscard]] double largest_difference(const DisparityField& a, const DisparityField& b);

/// A sample-wise comparison of two light fields.
[[nodiscard]] bool has_same_samples(const Scene& a, const Scene& b);

/// Sentences for the report of a failing test.
[[nodiscard]] std::string describe(const ConventionReport& report);

}  // namespace episcope::test
