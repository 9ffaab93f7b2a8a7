// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/array/quantile.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace episcope {

float quantile(std::span<float> values, double share) {
  assert(!values.empty());
  const double last = static_cast<double>(values.size() - 1);
  const auto place = values.begin() + std::lround(std::clamp(share, 0.0, 1.0) * last);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace episcope
