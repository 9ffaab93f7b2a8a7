// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/order/pair_gain.h"

#include "engine/core/array/quantile.h"

#include <algorithm>
#include <cmath>

namespace episcope::io {
namespace {

constexpr float kDark = 4;
constexpr float kNearlyEven = 0.02F;
constexpr std::size_t kFewest = 50;

}  // namespace

void PairGain::add(float here, float there) {
  if (std::min(here, there) > kDark) ratios_.push_back(here / there);
}

float PairGain::value() {
  if (ratios_.size() < kFewest) return 1;
  const float gain = quantile(ratios_, 0.5);
  return std::abs(gain - 1) > kNearlyEven ? gain : 1;
}

}  // namespace episcope::io
