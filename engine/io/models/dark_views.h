// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/io/models/order/view_axes.h"

#include <string>

namespace episcope::io {

/// Brightness of every view, cell by cell, compared with the center views.
struct ViewBrightness {
  /// Mean samples in [0, 1] of the cells of every view, `[v][u][row][column]`. Invalid pixels count
  /// as black.
  ViewStack<float> cells;
  /// Median of up to 3×3 views at the center, `[row][column]`.
  Image<float> reference;
  /// Minimum of the reference over 7×7 cells: the brightness that a cell has at least, whatever
  /// parallax moves into it.
  Image<float> expected;

  /// Whether a cell is empty: below a tenth of `expected`, where that exceeds 2 % of full
  /// brightness.
  [[nodiscard]] bool is_empty(ViewIndex view, int row, int column) const;
  /// Mean brightness of a view divided by the mean of the reference; 1 where all is black.
  [[nodiscard]] double relative(ViewIndex view) const;
  /// Whether a view is filled: at least half as bright as the reference, with at most a quarter of
  /// its cells empty.
  [[nodiscard]] bool is_filled(ViewIndex view) const;
  /// Whether any view is not filled or has an empty cell.
  [[nodiscard]] bool has_dark_parts() const;
};

/// Rows to sample: every second one, or one in the middle of each cell (a first look at samples on
/// disk or at many views).
enum class BrightnessRows { EverySecond, Few };

/// Measures the brightness of all views. A cell is a twentieth of the shorter side of the views, at
/// least 8 px. Samples every second pixel of the rows. `valid` may be empty. Throws Cancelled.
[[nodiscard]] ViewBrightness measure_brightness(const LightField::Samples& samples,
                                                const ViewStack<std::uint8_t>& valid,
                                                BrightnessRows rows, const Progress& progress);

/// Largest grid around the center without dark views at the corners, as a round pupil leaves them.
/// Keeps all views if fewer than two corners are dark or if no grid would be left. A failed camera
/// among other views causes no crop.
[[nodiscard]] ViewCrop filled_crop(const ViewBrightness& brightness);

/// "Using the inner 12×12 of 14×14 views …: 52 outer views are dark (mean 2 % of the center's);
/// --crop all keeps them", for the report.
[[nodiscard]] std::string crop_text(const ViewCrop& crop, const ViewBrightness& brightness);

/// Marks pixels as invalid (0) that are dark where the center views are not: vignetting, failed
/// cameras. Accurate to a cell of `brightness`. Darkness in the center views belongs to the scene.
/// Creates `valid` only if there are such pixels. Returns a sentence for the report, empty if
/// nothing was marked. Throws Cancelled.
std::string mark_empty_pixels(const ViewBrightness& brightness, int height, int width,
                              ViewStack<std::uint8_t>& valid, const Progress& progress);

/// Marks the black corners of a lens as invalid (0). At least three corners of the center view must
/// be black wedges, each shorter than 0.3 of both sides. Four fifths of their pixels must be black
/// in the other views too: parts of a scene would move. Brighter pixels that black ones enclose are
/// noise. Creates `valid` only if there are such
/// pixels. Returns a sentence for the report, empty if nothing was marked. Throws Cancelled.
std::string mark_black_corners(const LightField::Samples& samples, ViewStack<std::uint8_t>& valid,
                               const Progress& progress);

}  // namespace episcope::io
