// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/disparity_field.h"
#include "engine/core/light_field/light_field.h"

#include <string>
#include <vector>

namespace episcope::io {

/// What numbers of a disparity map may mean: times `factor` they are px per view step.
struct MapUnit {
  double factor = 1;
  std::string text;  ///< "px per view step", "px over the 8 steps of the whole baseline", …
};

/// Units in use, the most common first, for maps of these views.
[[nodiscard]] std::vector<MapUnit> common_units(GridShape grid, int width);

/// How well a map explains the views next to its own.
struct Explanation {
  double error = 0;  ///< Mean grey error (0 … 255) after warping, each axis in its better order,
  double unwarped = 0;         ///< and without warping.
  bool is_transposed = false;  ///< Rows and columns of views are exchanged.
  bool reversed_u = false;     ///< The better order of each axis of the image,
  bool reversed_v = false;     ///< x and y.

  [[nodiscard]] bool is_good() const { return error < 0.9 * unwarped; }
};

/// Warps the neighbours of view `at` with the map times `factor`, in the stored order of views and
/// in the exchanged one. Linear in the pixels.
[[nodiscard]] Explanation explain_views(const LightField::Samples& samples, ViewIndex at,
                                        const DisparityView& map, double factor);

/// The unit that explains the views; the first one unless another explains them clearly better.
struct SettledUnit {
  MapUnit unit;
  Explanation explanation;
  Explanation first;  ///< By the first of the units, for comparison.
};
/// Precondition: `units` is not empty.
[[nodiscard]] SettledUnit settle_unit(const LightField::Samples& samples, ViewIndex at,
                                      const DisparityView& map, const std::vector<MapUnit>& units);

}  // namespace episcope::io
