// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/ray_lines.h"

#include "engine/labeling/rays/ray_targets.h"

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

// Place in the next view of a ray at `from`, on the line of slope d through the pixel centre that
// is nearest to it in the middle view, `steps` before this one.
float drawn_on(int from, float d, int steps) {
  const float center = std::floor(static_cast<float>(from) + d * static_cast<float>(steps) + 0.5F);
  return std::floor(center - d * static_cast<float>(steps + 1) + 0.5F);
}

}  // namespace

RayLines find_ray_lines(const RayLineSources& sources, ViewIndex view, ViewIndex next,
                        const Progress& progress) {
  const DisparityView here = sources.disparity.view(view), there = sources.disparity.view(next);
  const int height = here.disparity.height, width = here.disparity.width;
  RayLines lines{Image<std::int32_t>(height, width), Image<std::uint8_t>(height, width)};
  std::fill(lines.weight.begin(), lines.weight.end(), std::uint8_t{0});
  Image<std::uint8_t> is_taken(height, width);
  std::fill(is_taken.begin(), is_taken.end(), std::uint8_t{0});
  const bool is_across = next.u != view.u;
  for (int y = 0; y < height; ++y) {
    progress.check();
    const RayColors::Pair colors = sources.colors.pair(view, y, next);
    for (int x = 0; x < width; ++x) {
      lines.target.at(y, x) = -1;
      if (!here.is_valid(y, x)) continue;
      const float d = here.disparity.at(y, x);
      const float at_x =
          is_across ? drawn_on(x, d, view.u - sources.middle.u) : static_cast<float>(x);
      const float at_y =
          is_across ? static_cast<float>(y) : drawn_on(y, d, view.v - sources.middle.v);
      // The comparison also drops what is too far off to be an int.
      if (!(at_x >= 0 && at_y >= 0 && at_x < static_cast<float>(width) &&
            at_y < static_cast<float>(height))) {
        continue;
      }
      const PixelIndex end{static_cast<int>(at_y), static_cast<int>(at_x)};
      if (!there.is_valid(end.y, end.x) || is_taken.at(end.y, end.x) != 0) continue;
      if (std::fabs(there.disparity.at(end.y, end.x) - d) > kSamePointTolerance_px) continue;
      const float trust = sources.colors.trust(colors, x, end.y * width + end.x);
      const auto weight = static_cast<std::uint8_t>(255 * trust + 0.5F);
      if (weight == 0) continue;
      lines.target.at(y, x) = end.y * width + end.x;
      lines.weight.at(y, x) = weight;
      is_taken.at(end.y, end.x) = 1;
    }
  }
  return lines;
}

}  // namespace episcope
