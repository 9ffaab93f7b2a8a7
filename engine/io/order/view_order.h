// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/view_stack.h"
#include "engine/core/light_field/disparity_field.h"
#include "engine/core/light_field/scene.h"

#include <algorithm>
#include <string>

namespace episcope::io {

/// Which view axes of a file are opposite to the canonical order.
struct ViewFlip {
  bool u = false;
  bool v = false;
  friend bool operator==(const ViewFlip&, const ViewFlip&) = default;
};

/// The flip that was undone while reading.
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

/// Reverses the order of views, in memory unless it is that of a file; `grid` is that of the whole
/// light field, of which `stack` may cover a part, which then moves to its mirrored place.
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

}  // namespace episcope::io
