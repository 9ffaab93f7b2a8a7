// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/surfaces_in_views.h"

#include "engine/core/parallel/parallel.h"

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

constexpr float kOverlap = 0.25F;

// The pixels of one axis that a point at `place` covers, within [0, extent).
struct Covered {
  int first = 0, last = 0;
};

Covered covered(float place, int extent) {
  const int whole = static_cast<int>(std::floor(place));
  const float t = place - static_cast<float>(whole);
  const int first = t > 1 - kOverlap ? whole + 1 : whole;
  const int last = t < kOverlap ? whole : whole + 1;
  return {std::max(first, 0), std::min(last, extent - 1)};
}

void cast_row(ImageView<const float> disparity, int y, ViewIndex step, ImageView<float> out) {
  for (int x = 0; x < disparity.width; ++x) {
    const float d = disparity.at(y, x);
    if (d <= kNothingNear) continue;
    const Covered rows =
        covered(static_cast<float>(y) - d * static_cast<float>(step.v), out.height);
    const Covered columns =
        covered(static_cast<float>(x) - d * static_cast<float>(step.u), out.width);
    for (int row = rows.first; row <= rows.last; ++row) {
      for (int column = columns.first; column <= columns.last; ++column) {
        out.at(row, column) = std::max(out.at(row, column), d);
      }
    }
  }
}

}  // namespace

ViewStack<float> surfaces_in_views(ImageView<const float> disparity, ViewIndex reference,
                                   GridShape grid, const Progress& progress) {
  ViewStack<float> surfaces(grid, disparity.height, disparity.width);
  parallel_for(grid.count(), progress, [&](int i) {
    const ViewIndex view = grid.view_at(i);
    const ImageView<float> out = surfaces.view(view);
    std::fill_n(out.data, out.size(), kNothingNear);
    for (int y = 0; y < disparity.height; ++y) {
      cast_row(disparity, y, {view.v - reference.v, view.u - reference.u}, out);
    }
  });
  return surfaces;
}

}  // namespace episcope
