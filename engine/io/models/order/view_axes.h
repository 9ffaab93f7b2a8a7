// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/io/models/order/warp_check.h"

#include <array>
#include <string>
#include <vector>

namespace episcope::io {

/// Evidence that motion between views runs along rows or along columns of the picture. Blocks are
/// matched one by one, so the evidence does not depend on the plane of zero disparity.
class AxisEvidence {
 public:
  /// Adds a pair of views of equal size. Matches the finest pictures with shifts of up to 6 px, the
  /// next ones with up to 12 px.
  void add(const MotionPictures& one, const MotionPictures& other);

  /// Share of the difference of the views that vanishes if blocks move along x, or along y, at the
  /// scale where the two differ more clearly.
  [[nodiscard]] double gone_along_x() const;
  [[nodiscard]] double gone_along_y() const;
  /// Standard scores by which x explains the blocks better than y; negative for y.
  [[nodiscard]] double score() const;

  [[nodiscard]] bool is_x() const;
  [[nodiscard]] bool is_y() const;
  [[nodiscard]] bool has_pairs() const { return scales_[0].blocks + scales_[1].blocks > 0; }
  [[nodiscard]] bool is_decided() const { return is_x() || is_y(); }

  /// Sums over blocks, of the roots of mean squared differences.
  struct Sums {
    double blocks = 0;
    double unmoved = 0;
    double along_x = 0;
    double along_y = 0;
    double squares = 0;  ///< Of the differences of the last two.

    [[nodiscard]] double score() const;
  };

 private:
  [[nodiscard]] const Sums& clearest() const;

  std::array<Sums, 2> scales_;
};

/// Image axes along which motion runs between the columns and between the rows of a grid of views.
/// Says nothing of an axis of a single view.
struct ViewAxes {
  AxisEvidence along_u;
  AxisEvidence along_v;

  /// Whether stored columns are rows, and vice versa, beyond doubt: u moves along y and v along x,
  /// or the only axis does.
  [[nodiscard]] bool are_swapped() const;
  /// "between columns 3 % of the difference is motion along x and 61 % along y, between rows …".
  [[nodiscard]] std::string evidence() const;
};

/// Compares the center view with up to four neighbors along each axis, and with farther ones where
/// the next ones do not decide. Throws Cancelled.
[[nodiscard]] ViewAxes find_view_axes(const LightField::Samples& samples, const Progress& progress);

/// Exchanges rows and columns of views: view (v, u) goes to (u, v). Copies a grid that is not
/// square.
void swap_view_axes(LightField::Samples& samples);
void swap_view_axes(ViewStack<std::uint8_t>& stack);
void swap_view_axes(GroundTruth& truth);
/// Exchanges positions that are stored row by row on the grid.
void swap_view_axes(std::vector<CameraPosition>& positions, GridShape stored);

/// Motion of points between views of a line: medians over squares of 16 px with texture in both
/// directions, in px of pictures of at most 512 px.
struct LineMotion {
  double along = 0;
  double across = 0;
  int step = 0;     ///< Between views so many apart;
  int squares = 0;  ///< of so many squares.

  /// Whether points also move across the line, as in a film of a camera that zooms or turns: by
  /// more than a quarter of a pixel, and by three tenths of their motion along it.
  [[nodiscard]] bool is_askew() const;
  /// A sentence about askew motion.
  [[nodiscard]] std::string warning() const;
};

/// Compares the view in the middle of a single row or column with a neighbor, or with farther views
/// if the next ones hardly move. Precondition: the grid is a line. Throws Cancelled.
[[nodiscard]] LineMotion measure_line_motion(const LightField::Samples& samples,
                                             const Progress& progress);

}  // namespace episcope::io
