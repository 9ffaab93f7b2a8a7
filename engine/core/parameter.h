// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace episcope {

/// An interval; or empty: "auto", as files promise, else found from the data, or "found", from the
/// data whatever files promise.
struct IntervalOrAuto : std::optional<Interval> {
  using std::optional<Interval>::optional;

  [[nodiscard]] static IntervalOrAuto found() {
    IntervalOrAuto interval;
    interval.is_found = true;
    return interval;
  }
  /// As the command line writes what is no interval: "auto" or "found".
  [[nodiscard]] const char* word() const { return is_found ? "found" : "auto"; }

  friend bool operator==(const IntervalOrAuto& a, const IntervalOrAuto& b) {
    return a.is_found == b.is_found && a.has_value() == b.has_value() && (!a || *a == *b);
  }

  bool is_found = false;  ///< False if there is an interval.
};

/// A view of the camera grid, or empty for "auto": the center.
using ViewOrAuto = std::optional<ViewIndex>;

/// Value of one parameter.
using ParameterValue = std::variant<bool, int, double, std::string, IntervalOrAuto, ViewOrAuto>;

/// Values by key, in the order of the schema.
using ParameterSet = std::vector<std::pair<std::string, ParameterValue>>;

/// Defaults that one choice of a parameter gives to others, such as "paper" of a profile.
struct Preset {
  std::string choice;
  ParameterSet values;  ///< Defaults of other parameters under this choice.
  /// Values that a search tries for them, by key; others are not searched.
  std::vector<std::pair<std::string, std::vector<ParameterValue>>> searched = {};
};

/// Everything that a form, a command line or a document needs to know about one parameter.
struct ParameterDescription {
  std::string key;    ///< As on the command line: `--key VALUE`.
  std::string label;  ///< As in the form.
  std::string help;
  std::string unit;  ///< "px", "" for a pure number.
  ParameterValue default_value;
  double min = 0;  ///< Closed domain of numbers and of the ends of intervals.
  double max = 0;
  bool logarithmic = false;               ///< A slider should move in powers.
  bool is_toggle = false;                 ///< Of flags: on a command line `--key` alone sets it.
  std::vector<std::string> choices = {};  ///< For strings: the only values allowed.
  std::vector<std::string> choice_labels = {};  ///< How users read each of them; empty = as it is.
  std::vector<ParameterValue> searched = {};    ///< Tried by a parameter search; empty = none.
  std::vector<Preset> presets = {};             ///< Of choices: what they mean for others.
};

/// Whether `min` and `max` of a parameter mean something.
[[nodiscard]] bool has_numeric_domain(const ParameterDescription& description);

/// The parameters with the defaults and searched values that hold once `values` choose presets.
/// Values of parameters without presets, and unknown keys, change nothing.
[[nodiscard]] std::vector<ParameterDescription> described_under(
    std::vector<ParameterDescription> descriptions, const ParameterSet& values);

/// The defaults of other parameters that `values`, or without them the defaults, choose.
[[nodiscard]] ParameterSet preset_values(const std::vector<ParameterDescription>& descriptions,
                                         const ParameterSet& values);

/// "paper sets lambda 0.2, edge_strength 0": what the choices of a parameter mean for others;
/// empty if nothing.
[[nodiscard]] std::string presets_text(const ParameterDescription& description);

/// Value as a command line writes it: `true`, `3`, `0.25`, `auto`, `found`, `-1.5,2`, `4,4`.
[[nodiscard]] std::string to_text(const ParameterValue& value);

/// Reads a value of the type of `description.default_value` and checks its domain.
/// Throws InvalidInput with key, value and domain.
[[nodiscard]] ParameterValue parse_parameter(const ParameterDescription& description,
                                             const std::string& text);

/// Throws InvalidInput if the value has another type than the default or lies outside the domain.
void check_parameter(const ParameterDescription& description, const ParameterValue& value);

/// The value of a key; null if the set has none.
[[nodiscard]] const ParameterValue* find_value(const ParameterSet& set, const std::string& key);
/// Replaces the value of a key, or adds it at the end.
void set_value(ParameterSet& set, const std::string& key, ParameterValue value);

/// The name in `names` nearest to `name` by edit distance, for "did you mean"; empty if none is
/// close.
[[nodiscard]] std::string nearest_name(const std::string& name,
                                       const std::vector<std::string>& names);

/// "there is no <kind> '<name>'" and, if one of `names` is near, "; did you mean '<nearest>'?"
[[nodiscard]] std::string no_such_name(const std::string& kind, const std::string& name,
                                       const std::vector<std::string>& names);

/// How a light field was read: together with its source, all that is needed to read the same
/// samples again.
struct Reading {
  std::string reader;  ///< Id of the reader (engine/io/open); empty = unknown.
  ParameterSet
      options;  ///< Options that were set, by key (io::OpenOptions); others were automatic.
  friend bool operator==(const Reading&, const Reading&) = default;

  /// Null if the option was not set.
  [[nodiscard]] const ParameterValue* find(const std::string& key) const {
    return find_value(options, key);
  }

  /// Key of the focus plane that was baked in (shear.h), px per view step.
  static constexpr const char* kFocus = "focus";
  [[nodiscard]] double focus_px() const {
    const ParameterValue* value = find(kFocus);
    const double* number = value ? std::get_if<double>(value) : nullptr;
    return number ? *number : 0;
  }
  void set_focus(double focus_px) {
    std::erase_if(options, [](const auto& option) { return option.first == kFocus; });
    if (focus_px != 0) options.emplace_back(kFocus, focus_px);
  }
};

}  // namespace episcope
