// SPDX-License-Identifier: BSD-3-Clause
// Compiled once for each instruction set: see engine/core/parallel/isa.h for what may stand here.
#include "engine/disparity/epi/line_residual_kernel.h"

#include "engine/core/parallel/simd.h"

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

constexpr int kBits = 10;
constexpr int kMask = (1 << kBits) - 1;
constexpr float kUnit = 1.0F / static_cast<float>(kMask);

struct Colour {
  Vec channel[3];
};

inline Colour unpack(IntVec packed) {
  Colour colour;
  for (int c = 0; c < 3; ++c) {
    colour.channel[c] = convert<float>((packed >> (kBits * c)) & kMask);
  }
  return colour;
}

inline IntVec gather(const std::uint32_t* from, IntVec index) {
  IntVec values;
  for (int i = 0; i < kLanes; ++i) values[i] = static_cast<int>(from[index[i]]);
  return values;
}

inline IntVec is_valid(IntVec packed) {
  return (packed >> (3 * kBits) & 1) == 0;
}

// Where the lines of some pixels meet a view.
struct Meeting {
  IntVec first, second;  // taps, as offsets from the start of the view
  Vec weight;            // of the second
  IntVec inside;
};

inline Meeting meet(const ResidualRow& row, const LineArm& arm, Vec shift, IntVec column) {
  const int last = (arm.vertical ? row.height : row.width) - 1;
  const Vec start = arm.vertical ? splat(static_cast<float>(row.y)) : convert<float>(column);
  const Vec at = start + shift;
  const Vec end = splat(static_cast<float>(last));
  const Vec clamped = least(greatest(at, splat(0)), end);
  const IntVec tap = least(convert<int>(clamped), IntVec{} + (last > 0 ? last - 1 : 0));
  const int stride = arm.vertical ? row.width : 1;
  const IntVec begin = arm.vertical ? column : IntVec{} + row.y * row.width;
  const IntVec first = begin + tap * stride;
  return {first, first + (last > 0 ? stride : 0), clamped - convert<float>(tap),
          (at >= 0.0F) & (at <= end)};
}

inline Vec squared_difference(const Colour& own, const std::uint32_t* view, const Meeting& where) {
  const Colour first = unpack(gather(view, where.first));
  const Colour second = unpack(gather(view, where.second));
  Vec sum{};
  for (int c = 0; c < 3; ++c) {
    const Vec off =
        first.channel[c] - own.channel[c] + where.weight * (second.channel[c] - first.channel[c]);
    sum += off * off;
  }
  return sum;
}

inline IntVec both_valid(const std::uint32_t* view, const Meeting& where) {
  return is_valid(gather(view, where.first)) & is_valid(gather(view, where.second));
}

template <bool kHasInvalid>
void fill_row(const ResidualRow& row) {
  const float infinity = __builtin_inff();
  IntVec lane;
  for (int i = 0; i < kLanes; ++i) lane[i] = i;
  for (int x = 0; x < row.width; x += kLanes) {
    const IntVec column = least(lane + x, IntVec{} + (row.width - 1));
    const Vec disparity = load(row.disparity + x);
    const IntVec packed = gather(row.own + x, lane);
    const Colour own = unpack(packed);
    Vec best = splat(infinity);
    for (int a = 0; a < row.arm_count; ++a) {
      const LineArm& arm = row.arms[a];
      Vec sum{}, count{};
      IntVec seen = ~IntVec{};
      for (int k = 0; k < arm.count; ++k) {
        const Vec shift = disparity * static_cast<float>(arm.step * (k + 1));
        const Meeting where = meet(row, arm, shift, column);
        seen &= where.inside;
        const Vec square = squared_difference(own, arm.views[k], where);
        IntVec known = seen;
        if constexpr (kHasInvalid) known &= both_valid(arm.views[k], where);
        sum += choose(known, square, splat(0));
        count += choose(known, splat(1), splat(0));
      }
      const Vec mean = sum / greatest(count, splat(1));
      const IntVec counts = count >= static_cast<float>(row.min_views);
      best = choose(counts, least(best, mean), best);
    }
    if constexpr (kHasInvalid) best = choose(is_valid(packed), best, splat(infinity));
    store(row.residual + x, best * (kUnit * kUnit));
  }
}

void residual_row(const ResidualRow& row) {
  if (row.has_invalid) return fill_row<true>(row);
  fill_row<false>(row);
}

}  // namespace

const ResidualKernel kResidualKernel = {residual_row};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
