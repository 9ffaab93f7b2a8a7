// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/ground_truth.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/io/models/order/grey_picture.h"

#include <array>
#include <string>
#include <vector>

namespace episcope::io {

/// Whether what moves between views moves along rows or along columns of the picture. Blocks are
/// matched one by one, so the evidence does not depend on where the plane of zero disparity lies.
class AxisEvidence {
 public:
  /// Adds a pair of views of equal size. The finest pictures are matched with shifts of up to 6 px,
  /// the next ones with up to 12 px.
  void add(const MotionPictures& one, const MotionPictures& other);

  /// Share of the difference of the views that goes when blocks are moved along x, or along y, at
  /// the scale where the two differ more clearly.
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

/// How points move between views of a line: medians over squares of 16 px with texture in both
/// directions, in px of pictures of at most 512 px.
struct LineMotion {
  double along = 0;
  double across = 0;
  int step = 0;     ///< Between views so many apart;
  int squares = 0;  ///< of so many squares.

  /// Whether points move across the line as well, as in a film of a camera that zooms or turns:
  /// by more than a quarter of a pixel, and by three tenths of how they move along it.
  [[nodiscard]] bool is_askew() const;
  /// A sentence about that.
  [[nodiscard]] std::string warning() const;
};

/// Looks at the view in the middle of a single row or column and one beside it, farther ones where
/// those next to it hardly move. Precondition: the grid is a line. Throws Cancelled.
[[nodiscard]] LineMotion measure_line_motion(const LightField::Samples& samples,
                                             const Progress& progress);

}  // namespace episcope::io
