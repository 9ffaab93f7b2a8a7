// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/packed_views.h"

#include "engine/core/parallel/parallel.h"

#include <algorithm>
#include <vector>

namespace episcope {
namespace {

std::uint32_t quantised(float sample) {
  return static_cast<std::uint32_t>(std::clamp(sample, 0.0F, 1.0F) * 1023 + 0.5F);
}

void pack_row(const float* samples, int width, int channels, std::uint32_t* out) {
  const int second = channels == 3 ? 1 : 0;
  for (int x = 0; x < width; ++x) {
    const float* const s = samples + static_cast<std::ptrdiff_t>(x) * channels;
    out[x] = quantised(s[0]) | quantised(s[second]) << 10 | quantised(s[2 * second]) << 20;
  }
}

}  // namespace

ViewStack<std::uint32_t> pack_views(const LightField& lf, const Progress& progress) {
  ViewStack<std::uint32_t> packed(lf.grid(), lf.height(), lf.width());
  parallel_for(lf.grid().count(), progress, [&](int i) {
    const ViewIndex view = lf.grid().view_at(i);
    const ImageView<std::uint32_t> out = packed.view(view);
    std::vector<float> row(static_cast<std::size_t>(lf.width()) * lf.channels());
    for (int y = 0; y < lf.height(); ++y) {
      lf.read_row(view, y, 0, lf.width(), row.data());
      pack_row(row.data(), lf.width(), lf.channels(), out.row(y));
    }
  });
  return packed;
}

}  // namespace episcope
