// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/float_samples.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace episcope::io {
namespace {

constexpr float kMostOfUnitRange = 1.5F;
constexpr float kMostOfBytes = 255.5F;

void zero_odd_samples(ViewStack<float>& stack, ConventionReport& report) {
  std::size_t odd = 0;
  for (std::size_t i = 0; i < stack.size(); ++i) {
    if (std::isfinite(stack.data()[i])) continue;
    stack.data()[i] = 0;
    ++odd;
  }
  if (odd == 0) return;
  report.warnings.push_back(std::to_string(odd) + " of " + std::to_string(stack.size()) +
                            " samples of the views are NaN or infinite; they are read as 0.");
}

void scale_to_unit_range(ViewStack<float>& stack, ConventionReport& report) {
  const float largest = *std::max_element(stack.data(), stack.data() + stack.size());
  if (largest <= kMostOfUnitRange) return;
  const int divisor = largest > kMostOfBytes ? 65535 : 255;
  std::transform(stack.data(), stack.data() + stack.size(), stack.data(),
                 [&](float sample) { return sample / static_cast<float>(divisor); });
  report.warnings.push_back("Float samples of the views should lie in 0 … 1, but reach up to " +
                            std::to_string(std::lround(largest)) + "; they are divided by " +
                            std::to_string(divisor) + ".");
}

}  // namespace

void tidy_float_samples(LightField::Samples& samples, ConventionReport& report) {
  auto* stack = std::get_if<ViewStack<float>>(&samples);
  if (stack == nullptr || stack->empty()) return;
  zero_odd_samples(*stack, report);
  scale_to_unit_range(*stack, report);
}

}  // namespace episcope::io
