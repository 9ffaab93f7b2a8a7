// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments/option_value.h"

#include "app/cli/arguments/usage_error.h"
#include "engine/core/parameter/parameter.h"
#include "engine/core/text/join.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace episcope::cli {
namespace {

template <class Number>
std::optional<Number> number_in(std::string text) {
  if (text.starts_with('+')) text.erase(0, 1);
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

OptionValue<std::string> text_value(const std::string& name) {
  return {name, [](const std::string&, const std::string& text) { return text; }};
}

OptionValue<int> integer_value(const std::string& name, int min, int max) {
  return {name, [min, max](const std::string& option, const std::string& text) {
            const auto number = number_in<int>(text);
            if (!number || *number < min || *number > max) {
              refuse(option, text, fmt::format("a whole number from {} to {}", min, max));
            }
            return *number;
          }};
}

OptionValue<double> real_value(const std::string& name, double min, double max) {
  return {name, [min, max](const std::string& option, const std::string& text) {
            const auto number = number_in<double>(text);
            if (!number || !(*number >= min && *number <= max)) {
              refuse(option, text, "a number from " + to_text(min) + " to " + to_text(max));
            }
            return *number;
          }};
}

OptionValue<std::size_t> bytes_value(const std::string& name) {
  return {name, [](const std::string& option, const std::string& text) {
            constexpr std::string_view kUnits = "KMGT";
            constexpr double kMost = 1e15;
            double unit = 1;
            const std::size_t place =
                text.empty() ? std::string_view::npos : kUnits.find(text.back());
            const bool has_unit = place != std::string_view::npos;
            for (std::size_t i = 0; has_unit && i <= place; ++i) unit *= 1024;
            const auto number = number_in<double>(text.substr(0, text.size() - (has_unit ? 1 : 0)));
            if (!number || !(*number * unit >= 1 && *number * unit <= kMost)) {
              refuse(option, text, "a number of bytes, such as 4G, 800M or 1.5G");
            }
            return static_cast<std::size_t>(*number * unit);
          }};
}

OptionValue<Interval> interval_value() {
  return {"A,B", [](const std::string& option, const std::string& text) {
            const auto ends = pair_in<double>(text, ",");
            if (!ends || !std::isfinite(ends->first) || !std::isfinite(ends->second) ||
                !(ends->first < ends->second)) {
              refuse(option, text, "two numbers A,B with A < B");
            }
            return Interval{ends->first, ends->second};
          }};
}

OptionValue<ViewIndex> view_value() {
  return {"V,U", [](const std::string& option, const std::string& text) {
            const auto place = pair_in<int>(text, ",");
            if (!place || place->first < 0 || place->second < 0) {
              refuse(option, text, "camera row and column V,U, both from 0");
            }
            return ViewIndex{place->first, place->second};
          }};
}

OptionValue<Extent> extent_value(const std::string& name, int max) {
  return {name, [max](const std::string& option, const std::string& text) {
            auto extent = pair_in<int>(text, "x");
            if (!extent) extent = pair_in<int>(text, "×");
            if (!extent || extent->first < 1 || extent->second < 1 || extent->first > max ||
                extent->second > max) {
              refuse(option, text, fmt::format("two whole numbers AxB from 1 to {}", max));
            }
            return Extent{extent->first, extent->second};
          }};
}

OptionValue<std::string> one_of(const std::vector<std::string>& names) {
  return {joined(names, "|"),
          [names](const std::string& option, const std::string& text) {
            if (std::ranges::find(names, text) != names.end()) return text;
            throw unknown_name("value of " + option, text, names);
          },
          names};
}

}  // namespace episcope::cli
