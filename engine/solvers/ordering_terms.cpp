// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/ordering_terms.h"

#include "engine/core/indices.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope {
namespace {

// The two pixels that a line ends between, as offsets from the start of the image.
struct Taps {
  std::ptrdiff_t first = 0, second = 0;
  float weight = 0;  // of the second
};

template <class T>
float sample(const ImageView<T>& image, const Taps& taps) {
  const float first = image.data[taps.first];
  return first + taps.weight * (image.data[taps.second] - first);
}

template <bool kVertical, class Visit>
void for_each_line_along(const ImageView<const float>& slopes, const ImageView<const float>& to,
                         float step, const Visit& visit) {
  const int last = (kVertical ? to.height : to.width) - 1;
  const int last_first = std::max(last - 1, 0);
  const auto end = static_cast<float>(last);
  const std::ptrdiff_t stride = kVertical ? to.row_stride : 1;
  for (int y = 0; y < slopes.height; ++y) {
    const float* const slope = slopes.row(y);
    for (int x = 0; x < slopes.width; ++x) {
      const float at = static_cast<float>(kVertical ? y : x) + step * slope[x];
      if (!(at >= 0 && at <= end)) continue;
      const int tap = std::min(static_cast<int>(at), last_first);
      const std::ptrdiff_t first = (kVertical ? x : y * to.row_stride) + tap * stride;
      visit(PixelIndex{y, x},
            Taps{first, tap < last ? first + stride : first, at - static_cast<float>(tap)});
    }
  }
}

// Calls visit(pixel, taps) for every line that stays within the image.
template <class Visit>
void for_each_line(const ImageView<const float>& slopes, const ImageView<const float>& to,
                   LineStep line, const Visit& visit) {
  if (line.vertical) return for_each_line_along<true>(slopes, to, line.step, visit);
  for_each_line_along<false>(slopes, to, line.step, visit);
}

// Slope ψ' of the penalty, and c such that ψ(a + δ) ≤ ψ(a) + ψ'(a)·δ + ½·c·δ² for every δ: at most
// one division each time.
struct Bend {
  float rise, fall, softness, stiffness;

  explicit Bend(const OrderingPenalty& penalty)
      : rise(penalty.rise),
        fall(penalty.fall),
        softness(penalty.softness),
        stiffness(penalty.fall / penalty.softness) {}
  [[nodiscard]] float slope(float a) const { return std::clamp(a * stiffness, -fall, rise); }
  [[nodiscard]] float curvature(float a) const {
    const float size = std::fabs(a);
    return size <= softness ? stiffness : fall / size;
  }
};

}  // namespace

void line_differences(ImageView<const float> slopes, ImageView<const float> from,
                      ImageView<const float> to, LineStep step, ImageView<float> out) {
  for (int y = 0; y < out.height; ++y) {
    std::fill_n(out.row(y), out.width, std::numeric_limits<float>::quiet_NaN());
  }
  for_each_line(slopes, to, step, [&](PixelIndex p, const Taps& taps) {
    out.at(p.y, p.x) = sample(to, taps) - from.at(p.y, p.x);
  });
}

void add_pull_on_from(ImageView<const float> slopes, ImageView<const float> from,
                      ImageView<const float> to, LineStep step, const OrderingPenalty& penalty,
                      const OrderingPull& pull) {
  const Bend bend(penalty);
  for_each_line(slopes, to, step, [&](PixelIndex p, const Taps& taps) {
    const float a = sample(to, taps) - from.at(p.y, p.x);
    pull.curvature.at(p.y, p.x) += bend.curvature(a);
    pull.force.at(p.y, p.x) += bend.slope(a);
  });
}

void add_pull_on_to(ImageView<const float> slopes, ImageView<const float> from,
                    ImageView<const float> to, LineStep step, const OrderingPenalty& penalty,
                    const OrderingPull& pull) {
  const Bend bend(penalty);
  for_each_line(slopes, to, step, [&](PixelIndex p, const Taps& taps) {
    const float a = sample(to, taps) - from.at(p.y, p.x);
    const float curvature = bend.curvature(a);
    const float force = bend.slope(a);
    pull.curvature.data[taps.first] += (1 - taps.weight) * curvature;
    pull.curvature.data[taps.second] += taps.weight * curvature;
    pull.force.data[taps.first] -= (1 - taps.weight) * force;
    pull.force.data[taps.second] -= taps.weight * force;
  });
}

}  // namespace episcope
