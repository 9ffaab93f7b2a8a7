// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/sample_range.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/indices.h"
#include "engine/core/numbers.h"
#include "engine/io/base/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace episcope::io {
namespace {

constexpr int kOfBytes = 255;
constexpr int kOfWords = 65535;
constexpr int kOf14Bits = 16383;
constexpr int kMostOf13Bits = 9000;  ///< A little above: rather a bright picture of 14 bits.

int bits_of(int white) {
  return static_cast<int>(std::bit_width(static_cast<unsigned>(white)));
}

template <class T>
void apply(ViewStack<T>& stack, const Interval& levels) {
  const double scale = 1 / levels.length();
  const double full = std::is_floating_point_v<T> ? 1 : std::numeric_limits<T>::max();
  std::transform(stack.data(), stack.data() + stack.size(), stack.data(), [&](T sample) {
    const double unit = (static_cast<double>(sample) - levels.min) * scale;
    if constexpr (std::is_floating_point_v<T>) return static_cast<T>(unit);
    return static_cast<T>(std::clamp(unit, 0.0, 1.0) * full + 0.5);
  });
}

void apply_chosen(LightField::Samples& samples, const Interval& levels, ConventionReport& report) {
  std::visit(
      [&](auto& stack) {
        if (!stack.empty()) apply(stack, levels);
      },
      samples);
  report.samples =
      fmt::format("levels {:g} (black) to {:g} (white), as chosen by hand", levels.min, levels.max);
}

/// White of 16-bit samples of fewer bits; nothing if they fill their range, or are all 0.
std::optional<int> stored_white(const ViewStack<std::uint16_t>& stack) {
  const std::uint16_t* begin = stack.data();
  const std::uint16_t* end = begin + stack.size();
  const int largest = *std::max_element(begin, end);
  if (largest == 0) return std::nullopt;
  const int white = full_scale(largest);
  if (white < kOfWords) return white;
  const bool is_of_14_bits = largest > kMostOf13Bits && largest <= kOf14Bits;
  return is_of_14_bits ? std::optional(kOf14Bits) : std::nullopt;
}

ViewStack<std::uint8_t> as_bytes(const ViewStack<std::uint16_t>& stack) {
  ViewStack<std::uint8_t> bytes(stack.grid(), stack.height(), stack.width(), stack.channels(),
                                stack.first());
  std::transform(stack.data(), stack.data() + stack.size(), bytes.data(),
                 [](std::uint16_t sample) { return static_cast<std::uint8_t>(sample); });
  return bytes;
}

void settle_words(LightField::Samples& samples, ConventionReport& report) {
  auto* stack = std::get_if<ViewStack<std::uint16_t>>(&samples);
  if (stack == nullptr || stack->empty() || stack->kind() == LargeKind::File) return;
  const auto white = stored_white(*stack);
  if (!white) return;
  report.samples =
      fmt::format("uint16, taken as gamma-encoded samples of {} bits; estimators see value/{}",
                  bits_of(*white), *white);
  report.warnings.push_back(fmt::format(finding_text("samples.bits"), *white, bits_of(*white)));
  if (*white == kOfBytes) {
    samples = as_bytes(*stack);
  } else {
    apply(*stack, {0, static_cast<double>(*white)});
  }
}

}  // namespace

Interval parse_levels(const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma != std::string::npos) {
    const auto black = parse_number(text.substr(0, comma));
    const auto white = parse_number(text.substr(comma + 1));
    if (black && white && *black < *white) return {*black, *white};
  }
  throw InvalidInput("'" + text.substr(0, 40) +
                     "' are no levels of samples; give the values of black and white as stored, as "
                     "in 0,1023 or -1,1");
}

int full_scale(double largest) {
  constexpr int k10Bits = 1023;
  constexpr int k12Bits = 4095;
  for (const int white : {kOfBytes, k10Bits, k12Bits}) {
    if (largest <= white) return white;
  }
  return kOfWords;
}

bool settle_range(LightField::Samples& samples, const std::string& levels,
                  ConventionReport& report) {
  if (!levels.empty()) {
    apply_chosen(samples, parse_levels(levels), report);
    return false;
  }
  const bool is_disparity = scale_float_samples(samples, report);
  settle_words(samples, report);
  return is_disparity;
}

namespace {

constexpr float kMaxUnitSample = 1.5F;
constexpr float kLargestDisparity = 64;
constexpr float kMaxByteSample = 255.5F;
// Of samples around 0: share of the amplitude below which a sample is negative, not one that a
// filter made overshoot, and the share of all samples that are.
constexpr float kClearlyNegative = 0.02F;
constexpr double kFewestNegative = 0.01;
constexpr float kMaxSignedSample = 1.01F;
// Noise around black reaches less far below 0 than this part of white, and where a sample is
// clearly negative, the next one of its channel is so too in less than this share of cases; of dark
// pictures nearly always.
constexpr float kFarBelow = 0.5F;
constexpr double kAlone = 0.75;
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
  float smallest = 0;
  double negative_share = 0;
  double beside_negative = 0;  ///< Of the clearly negative ones, the share beside another.
  double whole_share = 0;      ///< Of the samples that are not 0.
  float median = 0;
  float shadow = 0;     ///< The quantile of 0.1 %,
  float highlight = 0;  ///< and of 99.9 %.
};

/// Of the finite samples, at least from 0 to 0.
std::pair<float, float> extremes_of(const ViewStack<float>& stack) {
  float smallest = 0;
  float largest = 0;
  std::for_each(stack.data(), stack.data() + stack.size(), [&](float sample) {
    if (!std::isfinite(sample)) return;
    smallest = std::min(smallest, sample);
    largest = std::max(largest, sample);
  });
  return {smallest, largest};
}

FloatSpread spread_of(const ViewStack<float>& stack, float smallest, float largest) {
  constexpr std::size_t kJudged = 1000000;
  // Odd, so that it does not keep to one channel or one column.
  const std::size_t step = stack.size() / kJudged / 2 * 2 + 1;
  const float negative = -kClearlyNegative * std::max(largest, -smallest);
  std::vector<float> values;
  std::size_t whole = 0;
  std::size_t below = 0;
  std::size_t beside = 0;
  const auto channels = static_cast<std::size_t>(stack.channels());
  for (std::size_t i = 0; i < stack.size(); i += step) {
    const float value = stack.data()[i];
    if (!std::isfinite(value) || value == 0) continue;
    values.push_back(value);
    whole += value == std::round(value) ? 1 : 0;
    if (!(value < negative)) continue;
    ++below;
    const bool has_next = i + channels < stack.size();
    beside += has_next && stack.data()[i + channels] < negative ? 1 : 0;
  }
  FloatSpread spread{.largest = largest, .smallest = smallest};
  if (values.empty()) return spread;
  spread.whole_share = static_cast<double>(whole) / static_cast<double>(values.size());
  spread.negative_share = static_cast<double>(below) / static_cast<double>(values.size());
  if (below > 0) spread.beside_negative = static_cast<double>(beside) / static_cast<double>(below);
  spread.median = quantile(values, 0.5);
  spread.shadow = quantile(values, 0.001);
  spread.highlight = quantile(values, 0.999);
  return spread;
}

/// Of views from which a dark frame was taken.
bool is_noise_around_black(const FloatSpread& spread) {
  return spread.shadow > -kFarBelow * spread.highlight && spread.beside_negative < kAlone;
}

/// So that `black` becomes 0 and `white` 1.
void map_levels(ViewStack<float>& stack, float black, float white) {
  std::transform(stack.data(), stack.data() + stack.size(), stack.data(),
                 [=](float sample) { return (sample - black) / (white - black); });
}

/// Samples around 0, as networks are fed with.
void scale_signed(ViewStack<float>& stack, const FloatSpread& spread, ConventionReport& report) {
  const float amplitude = std::max(spread.largest, -spread.smallest);
  const bool is_of_bytes = spread.whole_share >= kMostlyWhole && spread.smallest >= -128 &&
                           spread.largest <= 127 && amplitude > kMaxSignedSample;
  float black = spread.shadow;
  float white = std::max(spread.highlight, std::nextafter(spread.shadow, spread.largest));
  std::string_view meaning = finding_text("samples.normalized");
  if (amplitude <= kMaxSignedSample) {
    black = -1;
    white = 1;
    meaning = finding_text("samples.unit");
  } else if (is_of_bytes) {
    black = -128;
    white = 127;
    meaning = finding_text("samples.shifted_bytes");
  }
  map_levels(stack, black, white);
  report.samples = fmt::format("float32 around 0; estimators see (value − {0:.4g})/{1:.4g}", black,
                               white - black);
  report.warnings.push_back(fmt::format(finding_text("samples.signed"), spread.smallest,
                                        spread.largest, black, white, meaning));
}

void scale_linear(ViewStack<float>& stack, const FloatSpread& spread, ConventionReport& report) {
  report.samples =
      fmt::format("float32, taken as linear with highlights up to {:.3g}; ", spread.largest);
  if (spread.highlight <= kMaxUnitSample) {
    report.samples += "estimators see the values";
    return;
  }
  map_levels(stack, 0, spread.highlight);
  report.samples += fmt::format(
      "divided by {:.4g}, which 99.9 % of the samples do not exceed; "
      "estimators see the quotient",
      spread.highlight);
  report.warnings.push_back(
      fmt::format(finding_text("samples.linear"), spread.largest, spread.median, spread.highlight));
}

// Samples that are not from 0 to 1 alone.
void scale_by_spread(ViewStack<float>& stack, const FloatSpread& spread, ConventionReport& report) {
  const float largest = spread.largest;
  if (spread.negative_share >= kFewestNegative) {
    if (!is_noise_around_black(spread)) return scale_signed(stack, spread, report);
    report.warnings.push_back(
        fmt::format(finding_text("samples.noise"), 100 * spread.negative_share, spread.smallest));
  }
  if (largest <= kMaxUnitSample) return;
  const bool is_whole = spread.whole_share >= kMostlyWhole;
  const int divisor = is_whole ? full_scale(largest) : largest > kMaxByteSample ? 65535 : 255;
  const bool is_scaled = is_whole || spread.median > kLeastMedian * static_cast<float>(divisor);
  if (!is_scaled || largest > kMaxWordSample) return scale_linear(stack, spread, report);
  map_levels(stack, 0, static_cast<float>(divisor));
  report.samples = fmt::format("float32, taken as samples of {} bits; estimators see value/{}",
                               std::bit_width(static_cast<unsigned>(divisor)), divisor);
  report.warnings.push_back(
      fmt::format(finding_text("samples.divided"), std::lround(largest), divisor));
}

bool can_be_disparity(const ViewStack<float>& stack, const FloatSpread& spread) {
  if (stack.channels() > 1 || stack.grid().count() < 2) return false;
  if (std::max(spread.largest, -spread.smallest) > kLargestDisparity) return false;
  if (spread.whole_share >= kMostlyWhole) return false;
  const bool is_signed = spread.negative_share >= kFewestNegative && !is_noise_around_black(spread);
  return is_signed || spread.largest > kMaxUnitSample;
}

}  // namespace

bool scale_float_samples(LightField::Samples& samples, ConventionReport& report) {
  ViewStack<float>* stack = floats_of(samples);
  if (stack == nullptr) return false;
  const auto [smallest, largest] = extremes_of(*stack);
  if (largest <= kMaxUnitSample && smallest == 0) return false;
  const FloatSpread spread = spread_of(*stack, smallest, largest);
  scale_by_spread(*stack, spread, report);
  return can_be_disparity(*stack, spread);
}

ViewStack<std::uint8_t> all_valid(GridShape grid, int height, int width) {
  ViewStack<std::uint8_t> valid(grid, height, width);
  std::fill_n(valid.data(), valid.size(), std::uint8_t{1});
  return valid;
}

void drop_nonfinite_samples(LightField::Samples& samples, ViewStack<std::uint8_t>& valid,
                            ConventionReport& report) {
  ViewStack<float>* stack = floats_of(samples);
  if (stack == nullptr) return;
  const auto channels = static_cast<std::size_t>(stack->channels());
  std::size_t odd = 0;
  for (std::size_t i = 0; i < stack->size(); ++i) {
    float& sample = stack->data()[i];
    if (std::isfinite(sample)) continue;
    if (valid.empty()) valid = all_valid(stack->grid(), stack->height(), stack->width());
    sample = 0;
    valid.data()[i / channels] = 0;
    ++odd;
  }
  if (odd == 0) return;
  report.warnings.push_back(fmt::format(finding_text("samples.not_finite"), odd, stack->size()));
}

}  // namespace episcope::io
