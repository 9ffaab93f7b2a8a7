// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/evaluation/metrics.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>

/// Disparity maps to be evaluated.
namespace episcope::test {

inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
inline constexpr int kSize = 50;  // 20×20 px inside the border of benchmark2016

using PixelFunction = std::function<double(int y, int x)>;

inline Image<float> map_of(const PixelFunction& value, int height = kSize, int width = kSize) {
  Image<float> map(height, width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) map.at(y, x) = static_cast<float>(value(y, x));
  }
  return map;
}

inline Image<float> constant(float value) {
  return map_of([value](int, int) { return value; });
}

inline DisparityView whole(const Image<float>& map) {
  return {map.view(), {}};
}

inline Evaluation judge(const Image<float>& estimate, const Image<float>& truth, Protocol protocol,
                        InvalidEstimates invalid = InvalidEstimates::Bad,
                        const std::map<std::string, Image<std::uint8_t>>& regions = {}) {
  return evaluate(whole(estimate), whole(truth), regions, {protocol, invalid, {}});
}

inline double metric(const Evaluation& evaluation, const char* key) {
  return find_metric(evaluation.metrics, key).value_or(std::numeric_limits<double>::infinity());
}

inline std::map<std::string, Image<std::uint8_t>> everywhere(const char* region) {
  return {{region, Image<std::uint8_t>(kSize, kSize, 1, 1)}};
}

/// A bumpy pair of truth and estimate with some missing values.
inline Image<float> wavy_truth() {
  return map_of([](int y, int x) { return std::sin(0.3 * x) + 0.2 * std::cos(0.7 * y); });
}
inline Image<float> rough_estimate() {
  return map_of([](int y, int x) {
    return (x * y) % 17 == 3 ? kNan : std::sin(0.3 * x + 0.02 * y) + 0.1 * ((x * 7 + y * 3) % 5);
  });
}

}  // namespace episcope::test
