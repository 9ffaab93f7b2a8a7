// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/depth/depth_edges.h"

#include "engine/core/parallel/parallel.h"

#include <cmath>

namespace episcope::capture {
namespace {

/// Whether the surface jumps between (y, x) and its neighbour to the right or, if `is_down`, below.
bool is_crack(const ViewSurface& view, int y, int x, bool is_down, float jump) {
  const int ny = is_down ? y + 1 : y;
  const int nx = is_down ? x : x + 1;
  if (ny >= view.state.height() || nx >= view.state.width()) return false;
  if (view.state.at(y, x) != ViewSurface::Seen || view.state.at(ny, nx) != ViewSurface::Seen) {
    return false;
  }
  const Image<float>& slope = is_down ? view.by_y : view.by_x;
  const float own = view.inverse_depth.at(y, x) + slope.at(y, x) / 2;
  const float other = view.inverse_depth.at(ny, nx) - slope.at(ny, nx) / 2;
  return std::abs(own - other) >= jump;
}

}  // namespace

void mark_cracks(ViewSurface& view, double jump, const Progress& progress) {
  const int height = view.state.height();
  const int width = view.state.width();
  const auto least = static_cast<float>(jump);
  Image<std::uint8_t> cracked(height, width);
  const auto crack = [&](int y, int x, bool is_down) {
    return y >= 0 && x >= 0 && is_crack(view, y, x, is_down, least);
  };
  parallel_for(height, progress, [&](int y) {
    for (int x = 0; x < width; ++x) {
      cracked.at(y, x) = crack(y, x, false) || crack(y, x, true) || crack(y, x - 1, false) ||
                         crack(y - 1, x, true);
    }
  });
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (cracked.at(y, x) != 0) view.state.at(y, x) = ViewSurface::Unsure;
    }
  }
}

}  // namespace episcope::capture
