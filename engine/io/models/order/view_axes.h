// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/core/view_stack.h"
#include "engine/io/models/order/motion_pictures.h"

#include <algorithm>
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
  bool is_grid = false;  ///< There are rows and columns.

  /// Standard scores by which motion fits columns and rows as stored, better than exchanged ones.
  [[nodiscard]] double score() const;
  /// Whether motion along an axis runs as stored, and along the other not the other way.
  [[nodiscard]] bool are_straight() const;
  /// Likewise, for columns that are rows and vice versa.
  [[nodiscard]] bool are_crossed() const;
  /// Whether there are both, and motion does not tell them apart.
  [[nodiscard]] bool are_unclear() const;
  /// Whether stored columns are rows, and vice versa, beyond doubt: u moves along y and v along x,
  /// or the only axis does.
  [[nodiscard]] bool are_swapped() const;
  /// "between columns 3 % of the difference is motion along x and 61 % along y, between rows …".
  [[nodiscard]] std::string evidence() const;
};

/// Compares the center view with its neighbors along each axis, and with farther ones where the
/// next ones do not decide; then up to eight pairs of views of the line through the center. Throws
/// Cancelled.
[[nodiscard]] ViewAxes find_view_axes(const LightField::Samples& samples, const Progress& progress);

/// What became of rows and columns of views.
struct AxesFinding {
  std::string swapped;       ///< Why they were exchanged; empty = they were not.
  bool are_unclear = false;  ///< Motion between the views of a grid does not tell them apart.
};

/// Exchanges rows and columns of views: view (v, u) goes to (u, v). Copies a grid that is not
/// square.
void swap_view_axes(LightField::Samples& samples);
void swap_view_axes(ViewStack<std::uint8_t>& stack);
void swap_view_axes(ViewStack<std::int32_t>& stack);
void swap_view_axes(DisparityField& field);
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

/// View axes of a file that run against the canonical order.
struct ViewFlip {
  bool u = false;
  bool v = false;
  friend bool operator==(const ViewFlip&, const ViewFlip&) = default;
};

/// Flip that was undone while reading.
[[nodiscard]] inline ViewFlip flip_of(const ConventionReport& report) {
  return {report.reversed_u, report.reversed_v};
}

/// "as stored", "u reversed", "v reversed", "u and v reversed".
[[nodiscard]] inline std::string flip_text(ViewFlip flip) {
  if (flip.u && flip.v) return "u and v reversed";
  if (flip.u) return "u reversed";
  return flip.v ? "v reversed" : "as stored";
}

/// Maps a stored view to its place in the canonical order, and vice versa.
[[nodiscard]] inline ViewIndex flipped(ViewIndex view, GridShape grid, ViewFlip flip) {
  return {flip.v ? grid.v - 1 - view.v : view.v, flip.u ? grid.u - 1 - view.u : view.u};
}

/// Reverses the order of views, in memory unless they are in a file; `grid` is the grid of the
/// whole light field, of which `stack` may cover a part, which then moves to its mirrored place.
template <class T>
void reverse_views(ViewStack<T>& stack, GridShape grid, ViewFlip flip) {
  if (stack.empty() || flip == ViewFlip{}) return;
  const GridShape part = stack.grid();
  const ViewIndex first = stack.first();
  if (stack.kind() == LargeKind::File && part == grid)
    return stack.reverse_in_place(flip.v, flip.u);
  for (int v = 0; v < part.v; ++v) {
    for (int u = 0; u < part.u; ++u) {
      const ViewIndex other = flipped({v, u}, part, flip);
      if (other.v * part.u + other.u <= v * part.u + u) continue;
      T* a = stack.view({first.v + v, first.u + u}).data;
      T* b = stack.view({first.v + other.v, first.u + other.u}).data;
      std::swap_ranges(a, a + stack.view_size(), b);
    }
  }
  if (part == grid) return;
  const ViewIndex last{first.v + part.v - 1, first.u + part.u - 1};
  const ViewIndex a = flipped(first, grid, flip);
  const ViewIndex b = flipped(last, grid, flip);
  ViewStack<T> moved(part, stack.height(), stack.width(), stack.channels(),
                     {std::min(a.v, b.v), std::min(a.u, b.u)});
  std::copy_n(stack.data(), stack.size(), moved.data());
  stack = std::move(moved);
}

inline void reverse_views(DisparityField& field, GridShape grid, ViewFlip flip) {
  reverse_views(field.disparity, grid, flip);
  reverse_views(field.valid, grid, flip);
}

/// Reverses positions, row by row on the grid, along with their views.
void reverse_positions(std::vector<CameraPosition>& positions, GridShape grid, ViewFlip flip);

/// Describes how positions change from view to view in canonical order: "camera right = smaller X,
/// camera down = larger Y". Empty if there are none, or if they do not change.
[[nodiscard]] std::string position_directions(const std::vector<CameraPosition>& positions,
                                              GridShape grid);

/// Views around the center of a grid, such that the center stays the center.
[[nodiscard]] inline ViewCrop central_crop(GridShape stored, GridShape kept) {
  const ViewIndex center = stored.center();
  const ViewIndex inner = kept.center();
  return {stored, {center.v - inner.v, center.u - inner.u}, kept};
}

/// Parses the option `crop`, rows x columns: "9x9". Throws InvalidInput for other texts and for
/// more views than there are.
[[nodiscard]] ViewCrop parse_crop(const std::string& text, GridShape stored);

/// The kept part of a stack that covers all views or some; empty if it holds none of them.
template <class T>
[[nodiscard]] ViewStack<T> cropped(ViewStack<T> stack, const ViewCrop& crop) {
  if (stack.empty()) return {};
  const GridShape grid = stack.grid();
  const ViewIndex from{std::max(stack.first().v, crop.first.v),
                       std::max(stack.first().u, crop.first.u)};
  const ViewIndex to{std::min(stack.first().v + grid.v, crop.first.v + crop.kept.v),
                     std::min(stack.first().u + grid.u, crop.first.u + crop.kept.u)};
  if (from.v >= to.v || from.u >= to.u) return {};
  const GridShape left{to.v - from.v, to.u - from.u};
  const ViewIndex first{from.v - crop.first.v, from.u - crop.first.u};
  if (stack.kind() == LargeKind::File) {
    stack.keep_in_place(from, left, first);
    return stack;
  }
  ViewStack<T> kept(left, stack.height(), stack.width(), stack.channels(), first);
  for (int i = 0; i < kept.grid().count(); ++i) {
    const ViewIndex view = kept.view_at(i);
    const ViewIndex stored{view.v + crop.first.v, view.u + crop.first.u};
    std::copy_n(stack.view(stored).data, stack.view_size(), kept.view(view).data);
  }
  return kept;
}

/// Crops a ground truth. Regions belong to the center view, which stays.
void crop_truth(GroundTruth& truth, const ViewCrop& crop);

/// Keeps the scribbles of the kept views, with their new places.
[[nodiscard]] Scribbles cropped(Scribbles scribbles, const ViewCrop& crop);

/// Inverse of `cropped`: returns scribbles at their stored places. Views outside the crop keep
/// their scribbles in `before`.
[[nodiscard]] Scribbles uncropped(Scribbles scribbles, Scribbles before, const ViewCrop& crop);

}  // namespace episcope::io
