// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi/replace_occluded.h"

#include "engine/core/parallel/parallel.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace episcope {
namespace {

constexpr int kReach = 4;  // views to each side
constexpr int kMinViews = 2;
constexpr float kFarther = 0.1F;

// One view that lines of another reach, by `steps` in its row or column of the grid.
struct Reached {
  ImageView<const float> disparity, confidence;
  bool vertical = false;
  float steps = 0;
};

std::vector<Reached> views_reached(const ViewStack<float>& disparity,
                                   const ViewStack<float>& confidence, ViewIndex from) {
  std::vector<Reached> reached;
  for (int k = -kReach; k <= kReach; ++k) {
    if (k == 0) continue;
    for (const bool vertical : {false, true}) {
      const ViewIndex view{from.v + (vertical ? k : 0), from.u + (vertical ? 0 : k)};
      if (!disparity.contains(view)) continue;
      reached.push_back(
          {disparity.view(view), confidence.view(view), vertical, static_cast<float>(k)});
    }
  }
  return reached;
}

// What lies farther than a ray at the ends of its line.
struct Farther {
  std::array<float, 4 * kReach> disparity;
  int count = 0;

  float median() {
    const auto middle = disparity.begin() + count / 2;
    std::nth_element(disparity.begin(), middle, disparity.begin() + count);
    return *middle;
  }
};

void look_along(const Reached& view, PixelIndex p, float disparity, float confidence,
                Farther& farther) {
  const int last = (view.vertical ? view.disparity.height : view.disparity.width) - 1;
  const float at = static_cast<float>(view.vertical ? p.y : p.x) - disparity * view.steps;
  if (!(at >= 0 && at <= static_cast<float>(last))) return;
  const int nearest = static_cast<int>(at + 0.5F);
  const int y = view.vertical ? nearest : p.y, x = view.vertical ? p.x : nearest;
  const float met = view.disparity.at(y, x);
  if (met < disparity - kFarther && view.confidence.at(y, x) >= confidence) {
    farther.disparity[farther.count++] = met;
  }
}

long replace_occluded_row(const std::vector<Reached>& reached, const float* disparity,
                          const float* confidence, int y, ImageView<float> out) {
  long changed = 0;
  for (int x = 0; x < out.width; ++x) {
    Farther farther;
    for (const Reached& view : reached) {
      look_along(view, {y, x}, disparity[x], confidence[x], farther);
    }
    if (farther.count < kMinViews) continue;
    out.at(y, x) = farther.median();
    ++changed;
  }
  return changed;
}

}  // namespace

long replace_occluded(ViewStack<float>& disparity, const ViewStack<float>& confidence,
                      const Progress& progress) {
  const ViewStack<float> before = disparity.clone();
  const GridShape grid = before.grid();
  std::vector<long> changed(grid.count());
  parallel_for(grid.count(), progress, [&](int i) {
    const ViewIndex view = grid.view_at(i);
    const std::vector<Reached> reached = views_reached(before, confidence, view);
    for (int y = 0; y < before.height(); ++y) {
      if (y % 16 == 0) progress.check();
      changed[i] += replace_occluded_row(reached, before.view(view).row(y),
                                         confidence.view(view).row(y), y, disparity.view(view));
    }
  });
  return std::accumulate(changed.begin(), changed.end(), 0L);
}

}  // namespace episcope
