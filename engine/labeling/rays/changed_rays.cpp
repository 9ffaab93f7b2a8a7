// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/changed_rays.h"

#include "engine/core/parallel/parallel.h"
#include "engine/labeling/rays/ray_targets.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

namespace episcope {
namespace {

struct Pixel {
  int y = 0, x = 0;
};

std::vector<Pixel> differing(ImageView<const std::int32_t> before,
                             ImageView<const std::int32_t> after) {
  std::vector<Pixel> found;
  for (int y = 0; y < before.height; ++y) {
    for (int x = 0; x < before.width; ++x) {
      if (before.at(y, x) != after.at(y, x)) found.push_back({y, x});
    }
  }
  return found;
}

// The pixels, at least 0 and below `size`, whose rays may arrive at `at` of the view `step` away.
std::pair<int, int> sources(int at, float disparity, int step, int size) {
  const float center = static_cast<float>(at) + disparity * static_cast<float>(step);
  // Half a pixel of rounding, and some for that of floats.
  const float reach = 0.51F + kSamePointTolerance_px * static_cast<float>(std::abs(step));
  const float last = static_cast<float>(size - 1);
  if (!(center + reach >= 0 && center - reach <= last)) return {0, 0};
  return {static_cast<int>(std::ceil(std::max(center - reach, 0.0F))),
          static_cast<int>(std::floor(std::min(center + reach, last))) + 1};
}

void mark(const std::vector<Pixel>& changed, const DisparityView& there, ViewIndex step,
          ImageView<std::uint8_t> marks) {
  for (const Pixel& at : changed) {
    const float disparity = there.disparity.at(at.y, at.x);
    if (!std::isfinite(disparity) || !there.is_valid(at.y, at.x)) continue;
    const auto [top, bottom] = sources(at.y, disparity, step.v, marks.height);
    const auto [left, right] = sources(at.x, disparity, step.u, marks.width);
    for (int y = top; y < bottom; ++y) std::fill(marks.row(y) + left, marks.row(y) + right, 1);
  }
}

}  // namespace

ViewStack<std::uint8_t> changed_rays(const ViewStack<std::int32_t>& before,
                                     const ViewStack<std::int32_t>& after,
                                     const DisparityField& disparity, const Progress& progress) {
  const GridShape grid = before.grid();
  ViewStack<std::uint8_t> marks(grid, before.height(), before.width(), 1, before.first(),
                                allocate_large_zeros);
  std::vector<std::vector<Pixel>> changed(static_cast<std::size_t>(grid.count()));
  parallel_for(grid.count(), progress, [&](int i) {
    const ViewIndex view = before.view_at(i);
    changed[static_cast<std::size_t>(i)] = differing(before.view(view), after.view(view));
  });
  parallel_for(grid.count(), progress, [&](int i) {
    const ViewIndex view = before.view_at(i);
    const ImageView<std::uint8_t> here = marks.view(view);
    for (const Pixel& own : changed[static_cast<std::size_t>(i)]) here.at(own.y, own.x) = 1;
    for (int j = 0; j < grid.count(); ++j) {
      const ViewIndex other = before.view_at(j);
      if (other == view || (other.v != view.v && other.u != view.u)) continue;
      mark(changed[static_cast<std::size_t>(j)], disparity.view(other),
           {other.v - view.v, other.u - view.u}, here);
    }
  });
  return marks;
}

}  // namespace episcope
