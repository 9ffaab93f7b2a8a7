// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/packed_views.h"

#include "engine/core/parallel/parallel.h"

#include <algorithm>
#include <vector>

namespace episcope {
namespace {

constexpr std::uint32_t kInvalid = 1U << kPackedInvalidBit;

std::uint32_t quantised(float sample) {
  return static_cast<std::uint32_t>(std::clamp(sample, 0.0F, 1.0F) * kPackedMost + 0.5F);
}

void pack_row(const float* samples, int width, int channels, std::uint32_t* out) {
  const int second = channels == 3 ? 1 : 0;
  for (int x = 0; x < width; ++x) {
    const float* const s = samples + static_cast<std::ptrdiff_t>(x) * channels;
    out[x] = quantised(s[0]) | quantised(s[second]) << kPackedBits |
             quantised(s[2 * second]) << (2 * kPackedBits);
  }
}

void mark_invalid(const std::uint8_t* valid, int width, std::uint32_t* out) {
  for (int x = 0; x < width; ++x) {
    if (valid[x] == 0) out[x] = kInvalid;
  }
}

// From the row `first_row` on, as many as `packed` has.
void pack_view(const LightField& lf, ViewIndex view, int first_row, PackedViews& packed) {
  const ImageView<std::uint32_t> out = packed.pixels.view(view);
  std::vector<float> row(static_cast<std::size_t>(lf.width()) * lf.channels());
  for (int i = 0; i < out.height; ++i) {
    const int y = first_row + i;
    lf.read_row(view, y, 0, lf.width(), row.data());
    pack_row(row.data(), lf.width(), lf.channels(), out.row(i));
    if (packed.has_invalid) mark_invalid(lf.valid().view(view).row(y), lf.width(), out.row(i));
  }
}

// How far outside [first, first + count) a place is.
int beyond(int place, int first, int count) {
  return std::max({first - place, place - (first + count - 1), 0});
}

}  // namespace

PackedViews pack_views(const LightField& lf, const Progress& progress) {
  return pack_rows(lf, 0, lf.height(), progress);
}

PackedViews pack_rows(const LightField& lf, int first_row, int end_row, const Progress& progress) {
  PackedViews packed{ViewStack<std::uint32_t>(lf.grid(), end_row - first_row, lf.width()),
                     !lf.valid().empty()};
  parallel_for(lf.grid().count(), progress,
               [&](int i) { pack_view(lf, lf.grid().view_at(i), first_row, packed); });
  return packed;
}

PackedViews pack_around(const LightField& lf, const ViewRectangle& views, int reach,
                        const Progress& progress) {
  const ViewIndex from{std::max(views.first.v - reach, 0), std::max(views.first.u - reach, 0)};
  const ViewIndex to{std::min(views.first.v + views.grid.v + reach, lf.grid().v),
                     std::min(views.first.u + views.grid.u + reach, lf.grid().u)};
  PackedViews packed{ViewStack<std::uint32_t>({to.v - from.v, to.u - from.u}, lf.height(),
                                              lf.width(), 1, from, allocate_large_zeros),
                     !lf.valid().empty()};
  parallel_for(packed.pixels.grid().count(), progress, [&](int i) {
    const ViewIndex view = packed.pixels.view_at(i);
    const bool is_beside = beyond(view.v, views.first.v, views.grid.v) == 0 ||
                           beyond(view.u, views.first.u, views.grid.u) == 0;
    if (is_beside) pack_view(lf, view, 0, packed);
  });
  return packed;
}

}  // namespace episcope
