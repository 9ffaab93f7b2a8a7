// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/ray_targets.h"

#include <cmath>

namespace episcope {

void find_ray_targets(const DisparityView& from, const DisparityView& to, ViewIndex step, int y,
                      std::int32_t* targets) {
  const int width = from.disparity.width, height = from.disparity.height;
  const float* const row = from.disparity.row(y);
  for (int x = 0; x < width; ++x) {
    targets[x] = -1;
    if (!from.is_valid(y, x)) continue;
    const float d = row[x];
    const float at_x = static_cast<float>(x) - d * static_cast<float>(step.u) + 0.5F;
    const float at_y = static_cast<float>(y) - d * static_cast<float>(step.v) + 0.5F;
    // The comparison also drops what is too far off to be an int.
    if (!(at_x >= 0 && at_y >= 0 && at_x < static_cast<float>(width) &&
          at_y < static_cast<float>(height))) {
      continue;
    }
    const PixelIndex there{static_cast<int>(at_y), static_cast<int>(at_x)};
    if (!to.is_valid(there.y, there.x)) continue;
    if (std::fabs(to.disparity.at(there.y, there.x) - d) > kSamePointTolerance_px) continue;
    targets[x] = there.y * width + there.x;
  }
}

}  // namespace episcope
