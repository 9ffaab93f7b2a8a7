// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"

namespace episcope::io {

/// How bright the views of a light field are, cell by cell, compared with its middle.
struct ViewBrightness {
  /// Mean samples in [0, 1] of the cells of every view, `[v][u][row][column]`; pixels that are not
  /// valid count as black.
  ViewStack<float> cells;
  /// The median of up to 3×3 views at the centre, `[row][column]`.
  Image<float> reference;
  /// The least reference of the 7×7 cells around: how bright a cell must be whatever parallax moves
  /// into it.
  Image<float> expected;

  /// Whether a cell of a view is empty: below a tenth of what is expected, where that is more than
  /// 2 % of full brightness.
  [[nodiscard]] bool is_empty(ViewIndex view, int row, int column) const;
  /// Mean brightness of a view over that of the reference; 1 where all is black.
  [[nodiscard]] double relative(ViewIndex view) const;
  /// Whether a view is filled: at least half as bright as the reference, and at most a quarter of
  /// its cells are empty.
  [[nodiscard]] bool is_filled(ViewIndex view) const;
  /// Whether any view is not filled or has an empty cell.
  [[nodiscard]] bool has_dark_parts() const;
};

/// How many rows are looked at: every second one, or one in the middle of each cell, for a first
/// look at samples that are on disk or of many views.
enum class BrightnessRows { EverySecond, Few };

/// A cell is a twentieth of the shorter side of the views, at least 8 px; every second pixel of the
/// rows is looked at. `valid` may be empty. Throws Cancelled.
[[nodiscard]] ViewBrightness measure_brightness(const LightField::Samples& samples,
                                                const ViewStack<std::uint8_t>& valid,
                                                BrightnessRows rows, const Progress& progress);

}  // namespace episcope::io
