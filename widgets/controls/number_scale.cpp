// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/number_scale.h"

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

constexpr int kSteps = 200;

int slider_steps(const ParameterDescription& description) {
  const bool is_integer = std::holds_alternative<int>(description.default_value);
  const double length = description.max - description.min;
  return is_integer && !description.logarithmic && length <= 1000 ? static_cast<int>(length)
                                                                  : kSteps;
}

}  // namespace

NumberScale::NumberScale(double min, double max, bool logarithmic, int steps)
    : min_(min), max_(max), logarithmic_(logarithmic && max > min), steps_(std::max(1, steps)) {
  constexpr double kDecades = 1e-4;  // Below this part of the domain, steps are even again.
  if (logarithmic_ && min <= 0) offset_ = (max - min) * kDecades - min;
}

NumberScale::NumberScale(const ParameterDescription& description)
    : NumberScale(description.min, description.max, description.logarithmic,
                  slider_steps(description)) {}

int NumberScale::position(double value) const {
  if (!(max_ > min_)) return 0;
  const double clamped = std::clamp(value, min_, max_);
  const double part = logarithmic_ ? std::log((clamped + offset_) / (min_ + offset_)) /
                                         std::log((max_ + offset_) / (min_ + offset_))
                                   : (clamped - min_) / (max_ - min_);
  return static_cast<int>(std::lround(part * steps_));
}

double NumberScale::value(int position) const {
  if (position <= 0) return min_;
  if (position >= steps_) return max_;
  const double part = 1.0 * position / steps_;
  if (!logarithmic_) return min_ + part * (max_ - min_);
  return (min_ + offset_) * std::pow((max_ + offset_) / (min_ + offset_), part) - offset_;
}

int NumberScale::decimals() const {
  const double smallest = logarithmic_ && min_ > 0 ? min_ : (max_ - min_) / 100;
  if (!(smallest > 0)) return 2;
  return std::clamp(1 - static_cast<int>(std::floor(std::log10(smallest))), 1, 7);
}

}  // namespace episcope
