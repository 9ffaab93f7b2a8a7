// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments/arguments.h"
#include "app/cli/arguments/usage_error.h"
#include "engine/core/parameter/parameter.h"

#include <charconv>
#include <cmath>

namespace episcope::cli {
namespace {

template <class Number>
std::optional<Number> number_in(const std::string& text) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, number);
  if (result.ec != std::errc{} || result.ptr != end) return std::nullopt;
  return number;
}

[[noreturn]] void refuse(const std::string& option, const std::string& text,
                         const std::string& expected) {
  throw UsageError(option + " is '" + text + "', but must be " + expected);
}

template <class Number>
struct Pair {
  Number first;
  Number second;
};

template <class Number>
std::optional<Pair<Number>> pair_in(const std::string& text, const std::string& separator) {
  const auto place = text.find(separator);
  if (place == std::string::npos) return std::nullopt;
  const auto first = number_in<Number>(text.substr(0, place));
  const auto second = number_in<Number>(text.substr(place + separator.size()));
  if (!first || !second) return std::nullopt;
  return Pair<Number>{*first, *second};
}

}  // namespace

int parse_integer(const std::string& option, const std::string& text, int min, int max) {
  const auto number = number_in<int>(text);
  if (!number || *number < min || *number > max) {
    refuse(option, text,
           "a whole number from " + std::to_string(min) + " to " + std::to_string(max));
  }
  return *number;
}

double parse_real(const std::string& option, const std::string& text, double min, double max) {
  const auto number = number_in<double>(text);
  if (!number || !(*number >= min && *number <= max)) {
    refuse(option, text, "a number from " + to_text(min) + " to " + to_text(max));
  }
  return *number;
}

Interval parse_interval(const std::string& option, const std::string& text) {
  const auto ends = pair_in<double>(text, ",");
  if (!ends || !std::isfinite(ends->first) || !std::isfinite(ends->second) ||
      !(ends->first < ends->second)) {
    refuse(option, text, "two numbers A,B with A < B");
  }
  return {ends->first, ends->second};
}

ViewIndex parse_view(const std::string& option, const std::string& text) {
  const auto place = pair_in<int>(text, ",");
  if (!place || place->first < 0 || place->second < 0) {
    refuse(option, text, "camera row and column V,U, both from 0");
  }
  return {place->first, place->second};
}

Extent parse_extent(const std::string& option, const std::string& text, int max) {
  auto extent = pair_in<int>(text, "x");
  if (!extent) extent = pair_in<int>(text, "×");
  if (!extent || extent->first < 1 || extent->second < 1 || extent->first > max ||
      extent->second > max) {
    refuse(option, text, "two whole numbers AxB from 1 to " + std::to_string(max));
  }
  return {extent->first, extent->second};
}

}  // namespace episcope::cli
