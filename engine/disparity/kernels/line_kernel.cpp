// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/kernels/line_kernel.h"

#include "engine/core/simd.h"

// Compiled once for each instruction set: see engine/core/isa.h for what may stand here.

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

constexpr float kUnit = 1.0F / static_cast<float>(kPackedMost);

struct Color {
  Vec channel[3];
};

inline Color unpack(IntVec packed) {
  Color color;
  for (int c = 0; c < 3; ++c) {
    color.channel[c] = convert<float>((packed >> (kPackedBits * c)) & kPackedMost);
  }
  return color;
}

inline IntVec gather(const std::uint32_t* from, IntVec index) {
  IntVec values;
  for (int i = 0; i < kLanes; ++i) values[i] = static_cast<int>(from[index[i]]);
  return values;
}

inline IntVec is_valid(IntVec packed) {
  return (packed >> kPackedInvalidBit & 1) == 0;
}

// The least number of all lanes in each of them.
inline Vec lowest(Vec value) {
  for (int step = kLanes / 2; step > 0; step /= 2) {
    IntVec turned;
    for (int i = 0; i < kLanes; ++i) turned[i] = (i + step) % kLanes;
    value = least(value, shuffled(value, value, turned));
  }
  return value;
}

// The pixels of a vector: lanes from column x, what they hold, and the range of their disparities.
struct Pixels {
  int x = 0;
  IntVec column;
  Color own;
  Vec disparity;
  float low = 0, high = 0;
};

// Where the lines of some pixels meet a view.
struct Meeting {
  IntVec tap;     // of the first of two samples, along the arm
  Vec weight;     // of the second
  IntVec inside;  // elsewhere tap and weight are 0
};

inline Meeting meet(const ResidualRow& row, const LineArm& arm, float step, const Pixels& pixels) {
  const Vec last = splat(static_cast<float>((arm.vertical ? row.height : row.width) - 1));
  const Vec start = arm.vertical ? splat(static_cast<float>(row.y)) : convert<float>(pixels.column);
  const Vec at = start + pixels.disparity * step;
  const IntVec inside = (at >= 0.0F) & (at <= last);
  const Vec known = choose(inside, at, splat(0));
  const IntVec tap = convert<int>(known);
  return {tap, known - convert<float>(tap), inside};
}

// The samples on either side of where lines meet a view.
struct SamplePair {
  IntVec first, second;
};

inline SamplePair gather_pair(const ResidualRow& row, const LineArm& arm, const std::uint32_t* view,
                              const Pixels& pixels, IntVec tap) {
  const int last = (arm.vertical ? row.height : row.width) - 1;
  const IntVec next = least(tap + 1, IntVec{} + last);
  if (arm.vertical) {
    return {gather(view, pixels.column + tap * row.width),
            gather(view, pixels.column + next * row.width)};
  }
  const std::uint32_t* const line = view + static_cast<long>(row.y) * row.width;
  return {gather(line, tap), gather(line, next)};
}

inline IntVec load_packed(const std::uint32_t* from) {
  IntVec packed;
  __builtin_memcpy(&packed, from, sizeof packed);
  return packed;
}

// The same where disparities differ little: few runs of samples hold all that is looked for, and
// reading them whole is faster than lane by lane. `reach` are their offsets from the pixels.
struct Reach {
  int begin = 0, end = 0;
};

inline SamplePair sweep_pair(const std::uint32_t* from, long stride, IntVec offset, Reach reach) {
  SamplePair pair{};
  IntVec before = IntVec{} == IntVec{} + 1;
  for (int i = reach.begin; i < reach.end; ++i) {
    const IntVec packed = load_packed(from + i * stride);
    const IntVec here = offset == i;
    pair.first = here ? packed : pair.first;
    pair.second = before ? packed : pair.second;
    before = here;
  }
  return pair;
}

// More runs than this cost as much as gathering.
constexpr int kMaxRuns = 10;

inline SamplePair sample_pair(const ResidualRow& row, const LineArm& arm, int k, float step,
                              const Pixels& pixels, IntVec tap) {
  const std::uint32_t* const view = arm.views[k];
  const float low = step > 0 ? pixels.low : pixels.high;
  const float high = step > 0 ? pixels.high : pixels.low;
  const int position = arm.vertical ? row.y : pixels.x;
  const int last = (arm.vertical ? row.height : row.width) - 1;
  // Sums of positions and shifts are rounded.
  const float rounding = 1e-6F * static_cast<float>(last + 1);
  const auto floor_of = [](float value) { return static_cast<int>(__builtin_floorf(value)); };
  if (!((high - low) * (step > 0 ? step : -step) < kMaxRuns)) {
    return gather_pair(row, arm, view, pixels, tap);
  }
  Reach reach{floor_of(low * step - rounding), floor_of(high * step + rounding) + 2};
  long stride = 1;
  if (arm.vertical) {
    stride = row.width;
    if (reach.begin < -position) reach.begin = -position;
    if (reach.end > last - position + 1) reach.end = last - position + 1;
  }
  const long from = static_cast<long>(row.y) * row.width + pixels.x;
  const bool within =
      from + reach.begin * stride >= 0 &&
      from + (reach.end - 1) * stride + kLanes <= static_cast<long>(row.height) * row.width;
  if (!within) return gather_pair(row, arm, view, pixels, tap);
  const IntVec offset = arm.vertical ? tap - row.y : tap - pixels.column;
  return sweep_pair(view + from, stride, offset, reach);
}

inline Vec squared_difference(const Color& own, const SamplePair& pair, Vec weight) {
  const Color first = unpack(pair.first);
  const Color second = unpack(pair.second);
  Vec sum{};
  for (int c = 0; c < 3; ++c) {
    const Vec off =
        first.channel[c] - own.channel[c] + weight * (second.channel[c] - first.channel[c]);
    sum += off * off;
  }
  return sum;
}

// Mean squared difference along an arm; infinite where it does not count.
template <bool kHasInvalid>
inline Vec arm_residual(const ResidualRow& row, const LineArm& arm, const Pixels& pixels) {
  Vec sum{}, count{};
  IntVec seen = ~IntVec{};
  for (int k = 0; k < arm.count; ++k) {
    const auto step = static_cast<float>(arm.step * (k + 1));
    const Meeting where = meet(row, arm, step, pixels);
    seen &= where.inside;
    const SamplePair pair = sample_pair(row, arm, k, step, pixels, where.tap);
    IntVec known = seen;
    if constexpr (kHasInvalid) known &= is_valid(pair.first) & is_valid(pair.second);
    sum += choose(known, squared_difference(pixels.own, pair, where.weight), splat(0));
    count += choose(known, splat(1), splat(0));
  }
  return choose(count >= static_cast<float>(row.min_views), sum / greatest(count, splat(1)),
                splat(__builtin_inff()));
}

template <bool kHasInvalid>
void fill_row(const ResidualRow& row) {
  const Vec infinity = splat(__builtin_inff());
  IntVec lane;
  for (int i = 0; i < kLanes; ++i) lane[i] = i;
  for (int x = 0; x < row.width; x += kLanes) {
    const IntVec packed = load_packed(row.own + x);
    const Vec disparity = load(row.disparity + x);
    const Pixels pixels{x,
                        least(lane + x, IntVec{} + (row.width - 1)),
                        unpack(packed),
                        disparity,
                        lowest(disparity)[0],
                        -lowest(-disparity)[0]};
    Vec best = infinity;
    for (int a = 0; a < row.arm_count; ++a) {
      best = least(best, arm_residual<kHasInvalid>(row, row.arms[a], pixels));
    }
    if constexpr (kHasInvalid) best = choose(is_valid(packed), best, infinity);
    store(row.residual + x, best * (kUnit * kUnit));
  }
}

void residual_row(const ResidualRow& row) {
  if (row.has_invalid) return fill_row<true>(row);
  fill_row<false>(row);
}

struct PackedColor {
  IntVec channel[3];
};

inline PackedColor load_color(const std::uint32_t* from) {
  const IntVec packed = load_packed(from);
  return {{packed & kPackedMost, (packed >> kPackedBits) & kPackedMost,
           (packed >> (2 * kPackedBits)) & kPackedMost}};
}

inline Vec squared_difference(const PackedColor& a, const PackedColor& b) {
  IntVec sum{};
  for (int c = 0; c < 3; ++c) {
    const IntVec off = a.channel[c] - b.channel[c];
    sum += off * off;
  }
  return convert<float>(sum) * (kUnit * kUnit);
}

void gradients(const GradientRow& row) {
  for (int x = 0; x < row.width; x += kLanes) {
    const PackedColor here = load_color(row.here + x);
    const Vec left = squared_difference(here, load_color(row.here + x - 1));
    const Vec right = squared_difference(here, load_color(row.here + x + 1));
    const Vec up = squared_difference(here, load_color(row.above + x));
    const Vec down = squared_difference(here, load_color(row.below + x));
    store(row.mean + x, 0.5F * (left + right) + 0.5F * (up + down));
    store(row.own + x, least(left, right) + least(up, down));
  }
}

void trust(const TrustRow& row) {
  for (int x = 0; x < row.width; x += kLanes) {
    const Vec residual = load(row.residual + x);
    const Vec beyond = greatest(residual - row.variance, splat(0));
    const Vec line =
        choose(residual < __builtin_inff(), row.noise / (row.noise + beyond), splat(1));
    const Vec share =
        row.texture_gain * (load(row.own + x) + row.noise) / (load(row.window + x) + row.noise);
    store(row.trust + x, square_root(square_root(line * least(share, splat(1)))));
  }
}

void gather_neighbors(const NeighborRow& row) {
  for (int x = 0; x < row.width; x += kLanes) {
    Vec far = load(row.own_disparity + x), near = far;
    Vec far_confidence = load(row.own_confidence + x), near_confidence = far_confidence;
    const Vec least_trust = row.far_trust * far_confidence;
    for (int k = 0; k < kSideNeighbors; ++k) {
      const Vec d = load(row.disparity[k] + x), r = load(row.confidence[k] + x);
      const IntVec is_farther = (d < far) & (r >= least_trust);
      far_confidence = choose(is_farther, r, far_confidence);
      near_confidence = choose(d > near, r, near_confidence);
      far = choose(is_farther, d, far);
      near = greatest(near, d);
    }
    store(row.far + x, far);
    store(row.near + x, near);
    store(row.far_confidence + x, far_confidence);
    store(row.near_confidence + x, near_confidence);
  }
}

struct Votes {
  Vec own{}, far{}, near{};
};

// Sums of residuals of the pixels around, by similarity of color.
inline Votes collect(const SideRow& row, int x) {
  Vec own_color[3];
  for (int c = 0; c < 3; ++c) own_color[c] = load(row.color[c][kVoteRadius] + x);
  Votes votes;
  for (int j = 0; j < kVoteRows; ++j) {
    for (int i = x - kVoteRadius; i <= x + kVoteRadius; ++i) {
      Vec square{};
      for (int c = 0; c < 3; ++c) {
        const Vec off = load(row.color[c][j] + i) - own_color[c];
        square += off * off;
      }
      // (1 − t/4)⁴ for exp(−t)
      const Vec root = greatest(1.0F - row.sharpness * square, splat(0));
      const Vec weight = root * root * root * root;
      votes.own += weight * load(row.residual[0][j] + i);
      votes.far += weight * load(row.residual[1][j] + i);
      votes.near += weight * load(row.residual[2][j] + i);
    }
  }
  return votes;
}

// What is left of the confidence of rays that keep their disparity.
inline Vec kept_share(const SideRow& row, const Votes& votes) {
  const Vec excess = votes.far / greatest(votes.own, splat(1e-20F)) - 1.0F;
  return least(greatest(row.doubtful_share + row.relief * excess, splat(0)), splat(1));
}

void choose_side(const SideRow& row) {
  for (int x = 0; x < row.width; x += kLanes) {
    const Vec own = load(row.disparity + x), far = load(row.far + x), near = load(row.near + x);
    const IntVec has_far = own - far > row.least_step, has_near = near - own > row.least_step;
    if (!any(has_far | has_near)) continue;
    const Votes votes = collect(row, x);
    const IntVec takes_far = has_far & (votes.far < row.far_advantage * votes.own) &
                             (~has_near | (votes.far <= votes.near));
    const IntVec takes_near = has_near & (votes.near < row.near_advantage * votes.own) & ~takes_far;
    const IntVec is_doubtful = own - far > row.doubtful_step;
    const Vec confidence = load(row.confidence + x);
    const Vec kept = choose(is_doubtful, confidence * kept_share(row, votes), confidence);
    store(row.disparity + x, choose(takes_far, far, choose(takes_near, near, own)));
    store(row.confidence + x, choose(takes_far, load(row.far_confidence + x),
                                     choose(takes_near, load(row.near_confidence + x), kept)));
  }
}

}  // namespace

const ResidualKernel kResidualKernel = {residual_row};

extern const TrustKernel kTrustKernel;
const TrustKernel kTrustKernel{gradients, trust};

const SideKernel kSideKernel = {gather_neighbors, choose_side};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
