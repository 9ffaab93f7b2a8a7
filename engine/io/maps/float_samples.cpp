// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/maps/float_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace episcope::io {
namespace {

constexpr float kMaxUnitSample = 1.5F;
constexpr float kMaxByteSample = 255.5F;

ViewStack<float>* floats_of(LightField::Samples& samples) {
  auto* stack = std::get_if<ViewStack<float>>(&samples);
  return stack == nullptr || stack->empty() ? nullptr : stack;
}

}  // namespace

void scale_float_samples(LightField::Samples& samples, ConventionReport& report) {
  ViewStack<float>* stack = floats_of(samples);
  if (stack == nullptr) return;
  float largest = 0;
  std::for_each(stack->data(), stack->data() + stack->size(), [&](float sample) {
    if (std::isfinite(sample)) largest = std::max(largest, sample);
  });
  if (largest <= kMaxUnitSample) return;
  const int divisor = largest > kMaxByteSample ? 65535 : 255;
  std::transform(stack->data(), stack->data() + stack->size(), stack->data(),
                 [&](float sample) { return sample / static_cast<float>(divisor); });
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
