// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/io/models/order/view_order.h"

#include <string>

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

/// The largest grid around the centre without the dark views at the corners of the stored one, as a
/// round pupil leaves them. All views where fewer than two corners are dark, and where no grid is
/// left: dark views among others (a camera that failed) make no crop.
[[nodiscard]] ViewCrop filled_crop(const ViewBrightness& brightness);

/// "12×12 of 14×14 views kept: outer views are dark (mean 2 % of the centre's); --crop all keeps
/// them", for the report.
[[nodiscard]] std::string crop_text(const ViewCrop& crop, const ViewBrightness& brightness);

/// Marks as invalid (0) the pixels of views that are dark where the centre views are not, within
/// the accuracy of a cell of `brightness`: vignetting, failed cameras. Darkness that the centre
/// views share counts as the scene's own. `valid` is made where there are such pixels; where there
/// are none it stays as it is.
/// Returns a sentence for the report; empty if nothing was marked. Throws Cancelled.
std::string mark_empty_pixels(const ViewBrightness& brightness, int height, int width,
                              ViewStack<std::uint8_t>& valid, const Progress& progress);

/// Marks as invalid (0) the black corners of views that a lens cut off: where at least three
/// corners of the centre view are black wedges, each shorter than 0.3 of both sides, and four
/// fifths of their pixels are black in the views as well: what a scene shows would move. `valid` is
/// made where there are such pixels. Returns a sentence for the report; empty if nothing was
/// marked. Throws Cancelled.
std::string mark_black_corners(const LightField::Samples& samples, ViewStack<std::uint8_t>& valid,
                               const Progress& progress);

}  // namespace episcope::io
