// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/ray_targets.h"

#include <cmath>

namespace episcope {
namespace {

// The pixel at which each ray of a row arrives, −1 outside the image. Without branches, so that
// the compiler takes several pixels at once.
void project_row(const DisparityView& from, ViewIndex step, int y, std::int32_t* targets) {
  const int width = from.disparity.width;
  const auto end_x = static_cast<float>(width), end_y = static_cast<float>(from.disparity.height);
  const auto step_x = static_cast<float>(step.u), step_y = static_cast<float>(step.v);
  const auto here_y = static_cast<float>(y);
  const float* const row = from.disparity.row(y);
  for (int x = 0; x < width; ++x) {
    const float at_x = static_cast<float>(x) - row[x] * step_x + 0.5F;
    const float at_y = here_y - row[x] * step_y + 0.5F;
    // Of what is too far off to be an int, or no number, the comparisons do not hold.
    const bool is_inside = (at_x >= 0) & (at_x < end_x) & (at_y >= 0) & (at_y < end_y);
    const int to_x = static_cast<int>(is_inside ? at_x : 0.0F);
    const int to_y = static_cast<int>(is_inside ? at_y : 0.0F);
    targets[x] = is_inside ? to_y * width + to_x : -1;
  }
}

}  // namespace

void find_ray_targets(const DisparityView& from, const DisparityView& to, ViewIndex step, int y,
                      std::int32_t* targets) {
  const int width = from.disparity.width;
  project_row(from, step, y, targets);
  const float* const here = from.disparity.row(y);
  const float* const there = to.disparity.data;
  for (int x = 0; x < width; ++x) {
    // Values that are not numbers are not within any tolerance.
    const float other = there[targets[x] < 0 ? 0 : targets[x]];
    if (!(std::fabs(other - here[x]) <= kSamePointTolerance_px)) targets[x] = -1;
  }
  if (!from.valid.empty()) {
    const std::uint8_t* const is_valid = from.valid.row(y);
    for (int x = 0; x < width; ++x) targets[x] = is_valid[x] != 0 ? targets[x] : -1;
  }
  if (!to.valid.empty()) {
    for (int x = 0; x < width; ++x) {
      if (targets[x] >= 0 && to.valid.data[targets[x]] == 0) targets[x] = -1;
    }
  }
}

}  // namespace episcope
