// SPDX-License-Identifier: BSD-3-Clause
// Compiled once for each instruction set: see engine/core/parallel/isa.h for what may stand here.
#include "engine/disparity/epi/line_trust_kernel.h"

#include "engine/core/parallel/simd.h"
#include "engine/disparity/common/packed_pixel.h"

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

constexpr float kUnit = 1.0F / static_cast<float>(kPackedMost);

struct Colour {
  IntVec channel[3];
};

inline Colour load_colour(const std::uint32_t* from) {
  IntVec packed;
  __builtin_memcpy(&packed, from, sizeof packed);
  return {{packed & kPackedMost, (packed >> kPackedBits) & kPackedMost,
           (packed >> (2 * kPackedBits)) & kPackedMost}};
}

inline Vec squared_difference(const Colour& a, const Colour& b) {
  IntVec sum{};
  for (int c = 0; c < 3; ++c) {
    const IntVec off = a.channel[c] - b.channel[c];
    sum += off * off;
  }
  return convert<float>(sum) * (kUnit * kUnit);
}

void gradients(const GradientRow& row) {
  for (int x = 0; x < row.width; x += kLanes) {
    const Colour here = load_colour(row.here + x);
    const Vec left = squared_difference(here, load_colour(row.here + x - 1));
    const Vec right = squared_difference(here, load_colour(row.here + x + 1));
    const Vec up = squared_difference(here, load_colour(row.above + x));
    const Vec down = squared_difference(here, load_colour(row.below + x));
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

}  // namespace

extern const TrustKernel kTrustKernel;
const TrustKernel kTrustKernel{gradients, trust};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
