// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/light_field.h"
#include "engine/core/scene.h"
#include "engine/core/view_stack.h"

#include <algorithm>
#include <string>
#include <vector>

namespace episcope::io {

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
