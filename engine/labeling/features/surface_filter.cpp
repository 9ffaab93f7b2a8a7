// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/features/surface_filter.h"

#include "engine/core/parallel/parallel.h"
#include "engine/labeling/features/surface_filter_kernel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace episcope {
namespace {

constexpr int kVectorLanes = 16;

// A plane with as many pixels around it as the filter looks at, equal to those at the border.
class Padded {
 public:
  Padded(const Image<float>& plane, int margin)
      : margin_(margin),
        pitch_(plane.width() + 2 * margin + kVectorLanes),
        values_(static_cast<std::size_t>(pitch_) * (plane.height() + 2 * margin) + kVectorLanes) {
    for (int y = -margin; y < plane.height() + margin; ++y) {
      const float* const from = plane.row(std::clamp(y, 0, plane.height() - 1));
      float* const to = values_.data() + (y + margin) * pitch_;
      std::fill_n(to, margin, from[0]);
      std::copy_n(from, plane.width(), to + margin);
      std::fill_n(to + margin + plane.width(), margin, from[plane.width() - 1]);
    }
  }
  [[nodiscard]] const float* row(int y) const {
    return values_.data() + (y + margin_) * pitch_ + margin_;
  }
  [[nodiscard]] long pitch() const { return pitch_; }

 private:
  int margin_;
  long pitch_;
  std::vector<float> values_;
};

struct Neighbours {
  std::vector<long> offsets;
  std::vector<float> nearness;
};

Neighbours neighbours_of(const SurfaceFilter& filter, long pitch) {
  Neighbours all;
  const double share = std::numbers::log2e / (2 * filter.scale_px * filter.scale_px);
  for (int y = -filter.radius_px; y <= filter.radius_px; ++y) {
    for (int x = -filter.radius_px; x <= filter.radius_px; ++x) {
      const int square = x * x + y * y;
      if (square > filter.radius_px * filter.radius_px) continue;
      all.offsets.push_back(y * pitch + x);
      all.nearness.push_back(static_cast<float>(-square * share));
    }
  }
  return all;
}

}  // namespace

ColorPlanes filter_surfaces(const ColorPlanes& colors, const SurfaceFilter& filter,
                            const Progress& progress) {
  const SurfaceKernel& kernel = EPISCOPE_CHOOSE_KERNEL(filter.isa, kSurfaceKernel);
  const int height = colors[0].height(), width = colors[0].width();
  const std::array<Padded, 3> padded{Padded(colors[0], filter.radius_px),
                                     Padded(colors[1], filter.radius_px),
                                     Padded(colors[2], filter.radius_px)};
  const Neighbours neighbours = neighbours_of(filter, padded[0].pitch());
  ColorPlanes out{Image<float>(height, width), Image<float>(height, width),
                  Image<float>(height, width)};
  const std::size_t size = static_cast<std::size_t>(width) + kVectorLanes;
  parallel_for_workers(height, progress, [&] {
    return [&, rows = std::vector<float>(3 * size)](int y) mutable {
      SurfaceTaps taps;
      float* to[3];
      for (std::size_t c = 0; c < 3; ++c) {
        taps.channels[c] = padded[c].row(y);
        to[c] = rows.data() + c * size;
      }
      taps.offsets = neighbours.offsets.data();
      taps.nearness = neighbours.nearness.data();
      taps.count = static_cast<int>(neighbours.offsets.size());
      taps.contrast =
          static_cast<float>(std::numbers::log2e / (2 * filter.contrast * filter.contrast));
      taps.width = width;
      kernel.filter(taps, to);
      for (std::size_t c = 0; c < 3; ++c) std::copy_n(to[c], width, out[c].row(y));
    };
  });
  return out;
}

}  // namespace episcope
