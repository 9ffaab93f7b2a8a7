// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"

#include <memory>
#include <vector>

namespace episcope {

/// Scales of the structure tensor on epipolar plane images.
struct TensorScales {
  double inner = 0.8;  ///< σ_i in px and views, Gaussian before the derivatives.
  double outer = 0.8;  ///< σ_o in px and views, Gaussian over the products of derivatives.
  double noise = 2;    ///< Standard deviation of the sample noise in units of 1/255.
};

/// Where orientation is looked for.
struct TensorSearch {
  Interval range;  ///< Disparities in px per view step.
  /// Shears in half pixels per view step; every disparity of the range must lie within `limit` of
  /// one.
  std::vector<int> half_step_shears;
  double limit = 0.6;
};

/// Shears that cover `range`, `step_half_px` half pixels apart, 0 among them if it lies inside.
[[nodiscard]] TensorSearch cover_range(Interval range, int step_half_px);

/// A stretch of parallel EPIs, and which of their rows are wanted.
struct EpiStretch {
  int line = 0;    ///< Horizontal: camera row v. Vertical: camera column u.
  int first = 0;   ///< Horizontal: image row y. Vertical: first image column of a block.
  int first_row = 0, last_row = 0;  ///< Wanted rows [first, last): u or v.
};

/// Disparity and coherence of the rows of an EPI by the structure tensor: smoothing with σ_i,
/// derivatives (central difference along, Scharr's [3,10,3]/16 across), products summed over
/// colour channels, integration with σ_o, orientation d = −2Jxs/(Jxx − Jss + √((Jxx − Jss)² + 4Jxs²))
/// and coherence r = √((Jxx − Jss)² + 4Jxs²)/(Jxx + Jss + n²), n² the energy of the noise.
///
/// The EPI is sheared to each of the shears, and the most coherent answer is kept; unlike in the
/// original, each row is integrated in coordinates of its own, so that every view of the light
/// field gets its estimate at whole pixels. Filters are truncated at the first and last view and
/// renormalised, so that slopes at the border come out right.
/// Source: Bigün and Granlund 1987 [BG87]; Wanner and Goldluecke 2012 [WG12].
///
/// Not thread-safe: one object for each thread. Takes about 1 MB.
class StructureTensor {
 public:
  enum class Direction { Horizontal, Vertical };
  /// Columns of one block of vertical EPIs.
  static constexpr int kColumns = 16;

  /// Throws InvalidInput if the grid has fewer than 2 views in that direction.
  StructureTensor(const LightField& light_field, Direction direction, const TensorScales& scales,
                  const TensorSearch& search);
  ~StructureTensor();
  StructureTensor(StructureTensor&&) noexcept;

  /// Estimates the rows wanted, payload pixels [begin, end) along the EPI (x, or y of a block).
  void estimate(const EpiStretch& stretch, int begin, int end);

  /// Results of the last call, row r of the EPI: pixel `begin + i` is at [i] (horizontal) or its
  /// column j at [i·kColumns + j] (vertical). Coherence 0 = no orientation found in the range.
  [[nodiscard]] const float* disparity(int row) const;
  [[nodiscard]] const float* coherence(int row) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace episcope
