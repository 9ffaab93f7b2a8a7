// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/epi.h"

#include "engine/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

void require_inside(const LightField& light_field, ViewIndex view, int line, int count,
                    const char* axis) {
  if (!light_field.grid().contains(view) || line < 0 || line >= count) {
    throw InvalidInput(
        fmt::format("there is no EPI through view ({}, {}) at {} {}: the light field has {}×{} "
                    "views of {}×{} pixels",
                    view.v, view.u, axis, line, light_field.grid().v, light_field.grid().u,
                    light_field.width(), light_field.height()));
  }
}

// out(i) = in(i + offset), linear, clamped.
void shift_row(const float* in, int width, int channels, double offset, float* out) {
  const double whole = std::floor(offset);
  const auto fraction = static_cast<float>(offset - whole);
  const int step = static_cast<int>(whole);
  for (int x = 0; x < width; ++x) {
    const int left = std::clamp(x + step, 0, width - 1) * channels;
    const int right = std::clamp(x + step + 1, 0, width - 1) * channels;
    for (int c = 0; c < channels; ++c) {
      out[x * channels + c] = (1 - fraction) * in[left + c] + fraction * in[right + c];
    }
  }
}

template <class ReadLine>
Image<float> gather(int rows, int width, int channels, int fixed_row, double focus_px,
                    const ReadLine& read_line) {
  Image<float> epi(rows, width, channels);
  std::vector<float> line(static_cast<std::size_t>(width) * channels);
  for (int s = 0; s < rows; ++s) {
    if (focus_px == 0 || s == fixed_row) {
      read_line(s, epi.row(s));
      continue;
    }
    read_line(s, line.data());
    // A point of disparity d appears at x − d·(u − u_c): fetching there puts it upright.
    shift_row(line.data(), width, channels, -focus_px * (s - fixed_row), epi.row(s));
  }
  return epi;
}

}  // namespace

Image<float> horizontal_epi(const LightField& lf, ViewIndex view, int y, double focus_px) {
  require_inside(lf, view, y, lf.height(), "row");
  for (int u = 0; u < lf.grid().u; ++u) lf.fetch_samples({view.v, u}, y, y + 1);
  return gather(lf.grid().u, lf.width(), lf.channels(), view.u, focus_px, [&](int u, float* out) {
    lf.read_row({view.v, u}, y, 0, lf.width(), out);
  });
}

Image<float> vertical_epi(const LightField& lf, ViewIndex view, int x, double focus_px) {
  require_inside(lf, view, x, lf.width(), "column");
  // Whole views: reading a little of each row would take the disk as long.
  for (int v = 0; v < lf.grid().v; ++v) lf.fetch_samples({v, view.u}, 0, lf.height());
  return gather(lf.grid().v, lf.height(), lf.channels(), view.v, focus_px, [&](int v, float* out) {
    lf.read_column({v, view.u}, x, 0, lf.height(), out);
  });
}

}  // namespace episcope
