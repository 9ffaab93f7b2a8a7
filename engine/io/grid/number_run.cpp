// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/number_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace episcope::io {

NumberRun::NumberRun(std::vector<long long> all) : values(std::move(all)) {
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  long long common = 0;
  for (const long long value : values) common = std::gcd(common, value - values.front());
  step = std::max(common, 1LL);
}

std::vector<long long> NumberRun::filled() const {
  if (is_scattered()) return values;
  std::vector<long long> all;
  for (long long value = values.front(); value <= values.back(); value += step) {
    all.push_back(value);
  }
  return all;
}

std::optional<std::size_t> NumberRun::place_of(long long value) const {
  const auto found = std::ranges::lower_bound(values, value);
  if (found == values.end() || *found != value) return std::nullopt;
  return static_cast<std::size_t>(found - values.begin());
}

std::string NumberRun::text() const {
  if (values.size() == 1) return std::to_string(values.front());
  if (values.size() == 2 || has_gaps()) {
    std::string text;
    for (std::size_t i = 0; i < std::min<std::size_t>(values.size(), 8); ++i) {
      text += fmt::format("{}{}", i == 0 ? "" : ", ", values[i]);
    }
    return values.size() > 8 ? text + fmt::format(" … {}", values.back()) : text;
  }
  if (step == 1) return fmt::format("{} … {}", values.front(), values.back());
  return fmt::format("{}, {} … {}", values.front(), values[1], values.back());
}

}  // namespace episcope::io
