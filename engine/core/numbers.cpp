// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/numbers.h"

#include <algorithm>
#include <cassert>

namespace episcope {
namespace {

template <class T>
T ranked(std::span<T> values, double share) {
  const auto place = values.begin() + quantile_rank(values.size(), share);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

std::ptrdiff_t quantile_rank(std::size_t count, double share) {
  assert(count > 0);
  return std::lround(std::clamp(share, 0.0, 1.0) * static_cast<double>(count - 1));
}

float quantile(std::span<float> values, double share) {
  return ranked(values, share);
}

double quantile(std::span<double> values, double share) {
  return ranked(values, share);
}

double median(std::vector<double> values) {
  return values.empty() ? 0 : quantile(values, 0.5);
}

}  // namespace episcope
