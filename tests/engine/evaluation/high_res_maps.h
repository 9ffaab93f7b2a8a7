// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/error.h"
#include "engine/core/scene.h"
#include "tests/engine/evaluation/judged_maps.h"

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

/// Truth of ten times the resolution of maps to be evaluated.
namespace episcope::test {

using Mask = Image<std::uint8_t>;
using Masks = std::map<std::string, Mask>;

inline constexpr int kHigh = 10 * kSize;

/// High resolution in memory; a mask that is empty cannot be read.
class MemoryTruth : public HighResTruth {
 public:
  MemoryTruth(Image<float> disparity, Masks masks)
      : disparity_(std::move(disparity)), masks_(std::move(masks)) {}

  [[nodiscard]] Image<float> read_disparity() const override {
    if (disparity_.empty()) throw IoError("gt.pfm", "is damaged");
    return disparity_;
  }
  [[nodiscard]] std::vector<std::string> regions() const override {
    std::vector<std::string> names;
    for (const auto& [name, mask] : masks_) names.push_back(name);
    return names;
  }
  [[nodiscard]] Mask read_region(const std::string& name) const override {
    if (masks_.at(name).empty()) throw IoError(name, "is damaged");
    return masks_.at(name);
  }
  [[nodiscard]] std::string identity() const override { return "memory"; }

 private:
  Image<float> disparity_;
  Masks masks_;
};

inline Image<float> high(const PixelFunction& value) {
  return map_of(value, kHigh, kHigh);
}

inline Mask mask_of(const std::function<int(int y, int x)>& value, int size = kHigh) {
  Mask mask(size, size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) mask.at(y, x) = static_cast<std::uint8_t>(value(y, x));
  }
  return mask;
}

inline Mask everywhere_high() {
  return Mask(kHigh, kHigh, 1, 255);
}

inline Evaluation judge_high(const Image<float>& estimate, const HighResTruth& truth,
                             StratifiedScene scene,
                             InvalidEstimates invalid = InvalidEstimates::Bad,
                             const Masks& low = {}) {
  EvaluationOptions options{Protocol::Benchmark2016, invalid, {}};
  options.high_res = &truth;
  options.stratified = scene;
  return evaluate(whole(estimate), whole(constant(0)), low, options);
}

inline bool has(const Evaluation& evaluation, const char* key) {
  return find_metric(evaluation.metrics, key).has_value();
}

}  // namespace episcope::test
