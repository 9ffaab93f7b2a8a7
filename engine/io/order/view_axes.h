// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/ground_truth.h"
#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"
#include "engine/io/order/parallax_axis.h"

#include <string>
#include <vector>

namespace episcope::io {

/// Along which image axes the motion runs between the columns and between the rows of a grid of
/// views. Nothing is said of an axis of a single view.
struct ViewAxes {
  AxisEvidence along_u;
  AxisEvidence along_v;

  /// Whether what is stored as columns are rows, and vice versa, without doubt: u moves along y
  /// and v along x, or the only axis does.
  [[nodiscard]] bool are_swapped() const;
  /// "between columns 3 % of the difference is motion along x and 61 % along y, between rows …".
  [[nodiscard]] std::string evidence() const;
};

/// Looks at the view at the centre of the grid and up to four neighbours along each axis, farther
/// ones where the next ones do not decide. Throws Cancelled.
[[nodiscard]] ViewAxes find_view_axes(const LightField::Samples& samples, const Progress& progress);

/// Makes rows of columns of views: view (v, u) goes to (u, v). A grid that is not square is copied.
void swap_view_axes(LightField::Samples& samples);
void swap_view_axes(ViewStack<std::uint8_t>& stack);
void swap_view_axes(GroundTruth& truth);
/// Of positions row by row on the grid as stored.
void swap_view_axes(std::vector<CameraPosition>& positions, GridShape stored);

}  // namespace episcope::io
