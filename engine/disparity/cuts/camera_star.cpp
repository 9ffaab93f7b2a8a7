// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/cuts/camera_star.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope {
namespace {

SideView side_view(ViewIndex view, ViewIndex reference, const std::vector<float>& labels) {
  SideView side{.view = view, .is_vertical = view.v != reference.v};
  const int steps = side.is_vertical ? view.v - reference.v : view.u - reference.u;
  for (const float label : labels) {
    const float exact = -label * static_cast<float>(steps);
    side.shift.push_back(static_cast<int>(std::lround(exact)));
    side.beyond.push_back(exact - static_cast<float>(side.shift.back()));
  }
  return side;
}

}  // namespace

std::vector<SideView> side_views(GridShape grid, ViewIndex reference, int distance,
                                 const std::vector<float>& labels) {
  std::vector<SideView> sides;
  const auto add = [&](int v, int u) {
    const ViewIndex view{std::clamp(v, 0, grid.v - 1), std::clamp(u, 0, grid.u - 1)};
    if (view != reference) sides.push_back(side_view(view, reference, labels));
  };
  add(reference.v, reference.u - distance);
  add(reference.v, reference.u + distance);
  add(reference.v - distance, reference.u);
  add(reference.v + distance, reference.u);
  return sides;
}

CameraImage::CameraImage(const LightField& lf, ViewIndex view) {
  const int height = lf.height(), width = lf.width(), channels = lf.channels();
  const Image<float> samples = lf.view_as_float(view);
  for (int c = 0; c < channels; ++c) {
    Image<float>& plane = planes_.emplace_back(height + 2 * kMargin, width + 2 * kMargin);
    for (int row = 0; row < plane.height(); ++row) {
      const int y = std::clamp(row - kMargin, 0, height - 1);
      for (int column = 0; column < plane.width(); ++column) {
        const int x = std::clamp(column - kMargin, 0, width - 1);
        plane.at(row, column) = lf.is_valid(view, y, x) ? 255 * samples.at(y, x, c)
                                                        : std::numeric_limits<float>::quiet_NaN();
      }
    }
  }
}

}  // namespace episcope
