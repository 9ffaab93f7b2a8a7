// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/camera.h"
#include "engine/core/image.h"
#include "engine/core/progress.h"

#include <cstddef>
#include <vector>

namespace episcope::capture {

enum class LensLattice { Square, Hexagonal };
[[nodiscard]] inline const char* lattice_name(LensLattice lattice) {
  return lattice == LensLattice::Hexagonal ? "hexagonal" : "square";
}

/// Where the lenses of an array stand on the sensor. Lens (i, j) stands at i·a + j·b from the
/// first, bent by a polynomial in i and j: rotation, pitch, perspective and radial distortion.
/// `a` points to the right along a row of lenses; `b` to the next row below, for a hexagonal
/// array half a pitch further to the right. A hexagonal array whose straight rows stand upright is
/// the transposed one: `a` points down along a column, `b` to the next column on the right.
struct LensGrid {
  LensLattice lattice = LensLattice::Square;
  bool has_columns = false;  ///< Rows of the array stand upright on the sensor.
  int degree = 1;            ///< Of the polynomial.
  /// Coefficients of x and y: of i^p·j^q, p + q ≤ degree, i and j divided by `scale`.
  std::vector<PlanePoint> terms;
  double scale = 1;
  double pitch_px = 0;          ///< |a| at the center of the picture,
  double row_distance_px = 0;   ///< and the distance of two rows.
  double rotation_degrees = 0;  ///< Of a against rows (columns) of the sensor, clockwise as seen.
  double residual_px = 0;       ///< Root mean square distance of measured centers from the fit,
  std::size_t lenses = 0;       ///< of so many lenses,
  std::size_t measured = 0;     ///< of so many that were measured; the others do not fit.

  double raw_off_px = 0;  ///< Distance of the raw picture's lenses, if this is a white picture's.

  /// Center of a lens in px; fractions of i and j lie between lenses.
  [[nodiscard]] PlanePoint center(double i, double j) const;
};

/// What the lenses of a picture shade.
enum class LensLight {
  Even,  ///< A white area: each lens is measured by itself.
  Scene  ///< A raw picture, whose texture is averaged out over many lenses around each.
};

/// Fits the grid of lenses to a picture in which each lens shows as a bright spot: a white picture,
/// or a raw one whose vignetting shows the lenses. `picture`: one channel, colors evened out.
/// The lattice is found in the spectrum of the middle; then each lens is measured by the phases of
/// the lattice's base frequencies around it, and the polynomial fitted to all, without outliers.
/// Throws InvalidInput for a picture without an array of lenses; Cancelled.
[[nodiscard]] LensGrid fit_lens_grid(const Image<float>& picture, const Progress& progress,
                                     LensLight light = LensLight::Even);

/// Distance in px of the lenses that a raw picture itself shows by its shading from those of a
/// grid; three quarters are farther away, as parts of a scene may be dark. Throws Cancelled.
[[nodiscard]] double distance_from_lenses(const Image<float>& picture, const LensGrid& grid,
                                          const Progress& progress);

/// Lenses of a grid whose centers lie within a picture, at least `border` px from its edges: the
/// largest upright block. Column c of row j is lens i = c − shift(j).
struct LensBlock {
  int first_row = 0;
  int rows = 0;
  double first_column = 0;  ///< In pitches along the row, from the line through the first lens that
  double columns = 0;       ///< is vertical on the array; the last column is at first + columns.
};
[[nodiscard]] LensBlock lens_block(const LensGrid& grid, int height, int width, double border);

/// Index i along row j of the place in column `column`, in pitches.
[[nodiscard]] inline double lens_at(const LensGrid& grid, double column, int row) {
  return grid.lattice == LensLattice::Hexagonal ? column - row / 2.0 : column;
}

}  // namespace episcope::capture
