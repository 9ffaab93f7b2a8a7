// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/ray_lines.h"

#include "engine/labeling/rays/ray_targets.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace episcope {
namespace {

// Place in the next view of a ray at `from`, on the line of slope d through the pixel centre that
// is nearest to it in the middle view, `steps` before this one.
float drawn_on(int from, float d, int steps) {
  const float center = std::floor(static_cast<float>(from) + d * static_cast<float>(steps) + 0.5F);
  return std::floor(center - d * static_cast<float>(steps + 1) + 0.5F);
}

// Two views and the way from one to the other.
struct Step {
  DisparityView here, there;
  bool is_across = false;
  int from_middle = 0;  // views between the middle column (row) and the first view
};

// Where the line through a pixel ends in the other view, −1 if it does not get there.
std::int32_t line_end(const Step& step, int y, int x) {
  const auto& [here, there, is_across, from_middle] = step;
  if (!here.is_valid(y, x)) return -1;
  const int width = here.disparity.width, height = here.disparity.height;
  const float d = here.disparity.at(y, x);
  const float at_x = is_across ? drawn_on(x, d, from_middle) : static_cast<float>(x);
  const float at_y = is_across ? static_cast<float>(y) : drawn_on(y, d, from_middle);
  // The comparison also drops what is too far off to be an int.
  if (!(at_x >= 0 && at_y >= 0 && at_x < static_cast<float>(width) &&
        at_y < static_cast<float>(height))) {
    return -1;
  }
  const PixelIndex end{static_cast<int>(at_y), static_cast<int>(at_x)};
  if (!there.is_valid(end.y, end.x)) return -1;
  const bool is_hidden = std::fabs(there.disparity.at(end.y, end.x) - d) > kSamePointTolerance_px;
  return is_hidden ? -1 : end.y * width + end.x;
}

}  // namespace

RayLines find_ray_lines(const RayLineSources& sources, ViewIndex view, ViewIndex next,
                        const Progress& progress) {
  const bool is_across = next.u != view.u;
  const Step step{sources.disparity.view(view), sources.disparity.view(next), is_across,
                  is_across ? view.u - sources.middle.u : view.v - sources.middle.v};
  const int height = step.here.disparity.height, width = step.here.disparity.width;
  RayLines lines{Image<std::int32_t>(height, width), Image<std::uint8_t>(height, width)};
  std::fill(lines.target.begin(), lines.target.end(), -1);
  std::fill(lines.weight.begin(), lines.weight.end(), std::uint8_t{0});
  std::vector<bool> is_taken(static_cast<std::size_t>(height) * width);
  for (int y = 0; y < height; ++y) {
    progress.check();
    const RayColors::Pair colors = sources.colors.pair(view, y, next);
    for (int x = 0; x < width; ++x) {
      const std::int32_t end = line_end(step, y, x);
      if (end < 0 || is_taken[end]) continue;
      const auto weight =
          static_cast<std::uint8_t>(255 * sources.colors.trust(colors, x, end) + 0.5F);
      if (weight == 0) continue;
      lines.target.at(y, x) = end;
      lines.weight.at(y, x) = weight;
      is_taken[end] = true;
    }
  }
  return lines;
}

}  // namespace episcope
