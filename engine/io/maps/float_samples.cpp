// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/maps/float_samples.h"

#include "engine/core/array/quantile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace episcope::io {
namespace {

constexpr float kMaxUnitSample = 1.5F;
constexpr float kMaxByteSample = 255.5F;
constexpr float kMaxWordSample = 65535.5F;
constexpr double kMostlyWhole = 0.95;
// Of samples of 8 or 16 bits: share of the range that half of them exceed.
constexpr float kLeastMedian = 0.02F;

ViewStack<float>* floats_of(LightField::Samples& samples) {
  auto* stack = std::get_if<ViewStack<float>>(&samples);
  return stack == nullptr || stack->empty() ? nullptr : stack;
}

// What tells which range float samples were stored in.
struct FloatSpread {
  float largest = 0;
  double whole_share = 0;  ///< Of the samples that are not 0.
  float median = 0;
  float highlight = 0;  ///< The quantile of 99.9 %.
};

float largest_of(const ViewStack<float>& stack) {
  float largest = 0;
  std::for_each(stack.data(), stack.data() + stack.size(), [&](float sample) {
    if (std::isfinite(sample)) largest = std::max(largest, sample);
  });
  return largest;
}

FloatSpread spread_of(const ViewStack<float>& stack, float largest) {
  constexpr std::size_t kJudged = 1000000;
  // Odd, so that it does not keep to one channel or one column.
  const std::size_t step = stack.size() / kJudged / 2 * 2 + 1;
  std::vector<float> values;
  std::size_t whole = 0;
  for (std::size_t i = 0; i < stack.size(); i += step) {
    const float value = stack.data()[i];
    if (!std::isfinite(value) || value == 0) continue;
    values.push_back(value);
    whole += value == std::round(value) ? 1 : 0;
  }
  if (values.empty()) return {largest};
  FloatSpread spread{largest, static_cast<double>(whole) / static_cast<double>(values.size())};
  spread.median = quantile(values, 0.5);
  spread.highlight = quantile(values, 0.999);
  return spread;
}

void divide(ViewStack<float>& stack, float divisor) {
  std::transform(stack.data(), stack.data() + stack.size(), stack.data(),
                 [=](float sample) { return sample / divisor; });
}

void scale_linear(ViewStack<float>& stack, const FloatSpread& spread, ConventionReport& report) {
  report.samples =
      fmt::format("float32, taken as linear with highlights up to {:.3g}; ", spread.largest);
  if (spread.highlight <= kMaxUnitSample) {
    report.samples += "estimators see the values";
    return;
  }
  divide(stack, spread.highlight);
  report.samples += fmt::format(
      "divided by {:.4g}, which 99.9 % of the samples do not exceed; "
      "estimators see the quotient",
      spread.highlight);
  report.warnings.push_back(fmt::format(
      "Float samples of the views reach up to {:.3g} with a median of {:.2g}: they are taken as "
      "linear, and divided by {:.4g} so that 99.9 % lie in 0 … 1.",
      spread.largest, spread.median, spread.highlight));
}

}  // namespace

void scale_float_samples(LightField::Samples& samples, ConventionReport& report) {
  ViewStack<float>* stack = floats_of(samples);
  if (stack == nullptr) return;
  const float largest = largest_of(*stack);
  if (largest <= kMaxUnitSample) return;
  const FloatSpread spread = spread_of(*stack, largest);
  const int divisor = largest > kMaxByteSample ? 65535 : 255;
  const bool is_scaled = spread.whole_share >= kMostlyWhole ||
                         spread.median > kLeastMedian * static_cast<float>(divisor);
  if (!is_scaled || largest > kMaxWordSample) return scale_linear(*stack, spread, report);
  divide(*stack, static_cast<float>(divisor));
  report.samples = fmt::format("float32, taken as samples of {} bits; estimators see value/{}",
                               divisor == 255 ? 8 : 16, divisor);
  report.warnings.push_back(fmt::format(
      "Float samples of the views should lie in 0 … 1, but reach up to {}; they are divided by {}.",
      std::lround(largest), divisor));
}

void zero_nonfinite_samples(LightField::Samples& samples, ConventionReport& report) {
  ViewStack<float>* stack = floats_of(samples);
  if (stack == nullptr) return;
  std::size_t odd = 0;
  std::for_each(stack->data(), stack->data() + stack->size(), [&](float& sample) {
    if (std::isfinite(sample)) return;
    sample = 0;
    ++odd;
  });
  if (odd == 0) return;
  report.warnings.push_back(
      fmt::format("{} of {} samples of the views are NaN or infinite; they are read as 0.", odd,
                  stack->size()));
}

}  // namespace episcope::io
