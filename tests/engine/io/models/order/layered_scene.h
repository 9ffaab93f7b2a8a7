// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"

#include <functional>

namespace episcope::test {

/// Textured discs in front of a textured plane, both parallel to the image: what is nearer hides
/// what is farther. Canonical order of views.
struct LayeredOptions {
  GridShape grid{5, 5};
  int height = 96;
  int width = 128;
  double background_px = -0.6;  ///< Disparities,
  double foreground_px = 0.9;
  int discs = 9;
  double noise = 0;  ///< standard deviation in grey levels,
  double gain = 1;   ///< factor of all grey levels before rounding.
  unsigned seed = 1;
};

[[nodiscard]] ViewStack<std::uint8_t> layered_views(const LayeredOptions& options);

/// Views in another order: view number i of the result, row by row, is `source(i)`.
[[nodiscard]] ViewStack<std::uint8_t> rearranged(const ViewStack<std::uint8_t>& views,
                                                 GridShape grid,
                                                 const std::function<ViewIndex(int)>& source);

}  // namespace episcope::test
