// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/view_stack.h"
#include "engine/core/light_field/scene.h"

#include <algorithm>
#include <string>

namespace episcope::io {

/// The views around the centre of a grid, so that the centre stays the centre.
[[nodiscard]] inline ViewCrop central_crop(GridShape stored, GridShape kept) {
  const ViewIndex center = stored.center();
  const ViewIndex inner = kept.center();
  return {stored, {center.v - inner.v, center.u - inner.u}, kept};
}

/// Reads the option `crop`, rows x columns: "9x9". Throws InvalidInput for other texts, and for
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

/// Parts of a ground truth likewise; regions belong to the centre view, which stays.
void crop_truth(GroundTruth& truth, const ViewCrop& crop);

/// What is painted on views that were kept, with their places among them.
[[nodiscard]] Scribbles cropped(Scribbles scribbles, const ViewCrop& crop);

/// The inverse: places among the views stored. Views that were left out keep what is painted on
/// them in `before`.
[[nodiscard]] Scribbles uncropped(Scribbles scribbles, Scribbles before, const ViewCrop& crop);

}  // namespace episcope::io
