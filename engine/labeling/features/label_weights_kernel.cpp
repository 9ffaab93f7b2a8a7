// SPDX-License-Identifier: BSD-3-Clause
// Compiled once for each instruction set: see engine/core/parallel/isa.h for what may stand here.
#include "engine/labeling/features/label_weights_kernel.h"

#include "engine/core/parallel/simd_math.h"

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

constexpr float kPerPower = 1.44269504F;  // log2 e

void misfits(const SurfaceRow& row, float* out) {
  for (int x = 0; x < row.width; ++x, out += row.pitch) {
    const float disparity = row.disparity[x], doubt = row.doubt[x];
    for (int l = 0; l < row.pitch; l += kLanes) {
      const Vec dx = static_cast<float>(x) - load(row.middle + l);
      const Vec spread = load(row.flat + l) + (load(row.slope + l) + load(row.bend + l) * dx) * dx;
      const Vec variance = load(row.variance + l) * (spread + 1.0F) + doubt;
      const Vec miss = disparity - load(row.at + l) - load(row.across + l) * dx;
      const Vec all = variance + miss * miss;
      const Vec misfit = 0.5F * natural_log(all * all / (variance * row.noise));
      const IntVec is_known = load(row.is_known + l) > 0.0F;
      store(out + l, choose(is_known, least(misfit, splat(row.most)), splat(0.5F * row.most)));
    }
  }
}

inline float least_of(const float* values, int count) {
  Vec all = load(values);
  for (int i = kLanes; i < count; i += kLanes) all = least(all, load(values + i));
  float found = all[0];
  for (int i = 1; i < kLanes; ++i) found = all[i] < found ? all[i] : found;
  return found;
}

void weigh(const WeighedRow& row, float* p) {
  const float* against = row.against;
  for (int x = 0; x < row.width; ++x, p += row.pitch, against += row.pitch) {
    const float best = least_of(against, row.pitch);
    const float power = -kPerPower * row.strength[x];
    Vec sums{};
    for (int l = 0; l < row.pitch; l += kLanes) {
      const Vec excess = least(load(against + l) - best, splat(row.most));
      const Vec weight = power_of_two(power * (excess * load(row.is_weighed + l)));
      const Vec value = (load(p + l) + load(row.floor + l)) * weight;
      store(p + l, value);
      sums += value;
    }
    float sum = 0;
    for (int i = 0; i < kLanes; ++i) sum += sums[i];
    if (!(sum > 0)) continue;
    for (int l = 0; l < row.pitch; l += kLanes) store(p + l, load(p + l) / sum);
  }
}

}  // namespace

const LabelWeightsKernel kLabelWeightsKernel = {misfits, weigh};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
