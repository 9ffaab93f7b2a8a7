// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/sweep/sweep_values.h"

#include "engine/core/error.h"
#include "engine/core/text/join.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace episcope {
namespace {

constexpr int kProposed = 5;
constexpr double kEvenReach = 0.2;  // of the domain, to both sides of the present value
constexpr double kPowerReach = 4;   // factor, likewise
constexpr int kMostOfRange = 1000;

std::vector<std::string> split(std::string text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(std::move(text));
  for (std::string part; std::getline(stream, part, separator);) {
    part.erase(0, part.find_first_not_of(' '));
    part.erase(part.find_last_not_of(' ') + 1);
    if (!part.empty()) parts.push_back(part);
  }
  return parts;
}

ParameterValue like(const ParameterDescription& description, double value) {
  if (std::holds_alternative<int>(description.default_value)) {
    return static_cast<int>(std::lround(value));
  }
  // A user reads these: four digits will do.
  return std::stod(fmt::format("{:.4g}", value));
}

std::vector<ParameterValue> spread(const ParameterDescription& description, double begin,
                                   double end, int count) {
  const bool in_powers = description.logarithmic && begin > 0 && end > 0;
  std::vector<ParameterValue> values;
  for (int i = 0; i < count; ++i) {
    const double share = count == 1 ? 0 : static_cast<double>(i) / (count - 1);
    values.push_back(like(description, in_powers ? begin * std::pow(end / begin, share)
                                                 : begin + share * (end - begin)));
  }
  return values;
}

std::vector<ParameterValue> parse_range(const ParameterDescription& description,
                                        const std::string& text) {
  const std::vector<std::string> parts = split(text, ':');
  const auto wrong = [&] {
    return InvalidInput("'" + text + "' is no range: write first:last:number, as 0.1:1.6:5");
  };
  if (parts.size() != 3) throw wrong();
  const double begin = number_of(parse_parameter(description, parts[0]));
  const double end = number_of(parse_parameter(description, parts[1]));
  ParameterDescription counting;
  counting.key = "number of values";
  counting.default_value = 0;
  counting.min = 1;
  counting.max = kMostOfRange;
  return spread(description, begin, end, std::get<int>(parse_parameter(counting, parts[2])));
}

std::vector<ParameterValue> sorted(std::vector<ParameterValue> values) {
  const auto is_less = [](const ParameterValue& a, const ParameterValue& b) {
    return number_of(a) < number_of(b);
  };
  std::sort(values.begin(), values.end(), is_less);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

}  // namespace

bool can_sweep(const ParameterDescription& description) {
  return std::holds_alternative<int>(description.default_value) ||
         std::holds_alternative<double>(description.default_value);
}

double number_of(const ParameterValue& value) {
  if (const int* number = std::get_if<int>(&value)) return *number;
  return std::get<double>(value);
}

std::vector<ParameterValue> parse_sweep_values(const ParameterDescription& description,
                                               const std::string& text) {
  if (text.find(':') != std::string::npos) return sorted(parse_range(description, text));
  std::string spaced = text;
  std::replace(spaced.begin(), spaced.end(), ',', ' ');
  std::replace(spaced.begin(), spaced.end(), ';', ' ');
  std::vector<ParameterValue> values;
  for (const std::string& part : split(spaced, ' ')) {
    values.push_back(parse_parameter(description, part));
  }
  if (values.empty()) {
    throw InvalidInput("there are no values of " + description.label +
                       ": write some, as 0.1, 0.2, 0.4, or a range, as 0.1:1.6:5");
  }
  return sorted(std::move(values));
}

std::string proposed_sweep_values(const ParameterDescription& description) {
  std::vector<ParameterValue> values = description.searched;
  if (values.empty()) {
    const double present = number_of(description.default_value);
    const double reach = kEvenReach * (description.max - description.min);
    const bool in_powers = description.logarithmic && present > 0;
    const double begin = in_powers ? present / kPowerReach : present - reach;
    const double end = in_powers ? present * kPowerReach : present + reach;
    values = spread(description, std::max(begin, description.min), std::min(end, description.max),
                    kProposed);
  }
  return joined(sorted(std::move(values)), ", ",
                [](const ParameterValue& value) { return to_text(value); });
}

}  // namespace episcope
