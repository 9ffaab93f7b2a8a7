// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/maps/sample_range.h"

#include "engine/core/array/indices.h"
#include "engine/core/error.h"
#include "engine/io/maps/float_samples.h"
#include "engine/io/maps/parse_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

namespace episcope::io {
namespace {

constexpr int kOfBytes = 255;
constexpr int kOfWords = 65535;
constexpr int kOf14Bits = 16383;
constexpr int kMostOf13Bits = 9000;  ///< A little above: rather a bright picture of 14 bits.

int bits_of(int white) {
  return static_cast<int>(std::bit_width(static_cast<unsigned>(white)));
}

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
std::optional<int> white_of(const ViewStack<std::uint16_t>& stack) {
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
  const auto white = white_of(*stack);
  if (!white) return;
  report.samples =
      fmt::format("uint16, taken as gamma-encoded samples of {} bits; estimators see value/{}",
                  bits_of(*white), *white);
  report.warnings.push_back(fmt::format(
      "No sample of the views exceeds {} of 65535: they are taken as samples of {} bits. --levels "
      "0,65535 keeps them as they are.",
      *white, bits_of(*white)));
  if (*white == kOfBytes) {
    samples = as_bytes(*stack);
  } else {
    apply(*stack, {0, static_cast<double>(*white)});
  }
}

}  // namespace

int full_scale(double largest) {
  constexpr int k10Bits = 1023;
  constexpr int k12Bits = 4095;
  for (const int white : {kOfBytes, k10Bits, k12Bits}) {
    if (largest <= white) return white;
  }
  return kOfWords;
}

void settle_range(LightField::Samples& samples, const std::string& levels,
                  ConventionReport& report) {
  if (!levels.empty()) return apply_chosen(samples, parse_levels(levels), report);
  scale_float_samples(samples, report);
  settle_words(samples, report);
}

}  // namespace episcope::io
