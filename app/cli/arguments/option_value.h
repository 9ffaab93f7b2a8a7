// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/indices.h"
#include "engine/core/parameter/named.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace episcope::cli {

/// How the value of an option is typed.
template <class T>
struct OptionValue {
  std::string name;  ///< What help calls it: "A,B", "auto|cpu|cuda".
  /// Throws UsageError, naming the option, for a text that is no such value.
  std::function<T(const std::string& option, const std::string& text)> read;
  std::vector<std::string> choices{};  ///< Where only certain words are values.
  bool may_begin_with_dash =
      false;  ///< What follows is the value, even if it looks like an option.
};

/// Any text: the name of a file, of an INPUT.
[[nodiscard]] OptionValue<std::string> text_value(const std::string& name);
/// A whole number or a number in [min, max].
[[nodiscard]] OptionValue<int> integer_value(const std::string& name, int min, int max);
[[nodiscard]] OptionValue<double> real_value(const std::string& name, double min, double max);
/// A number of bytes: "4G", "1.5G", "800M", "64K" (powers of 1024), "1000000".
[[nodiscard]] OptionValue<std::size_t> bytes_value(const std::string& name);
/// "A,B" with A < B.
[[nodiscard]] OptionValue<Interval> interval_value();
/// "V,U".
[[nodiscard]] OptionValue<ViewIndex> view_value();

/// "AxB" with both in [1, max].
struct Extent {
  int first = 0;
  int second = 0;
};
[[nodiscard]] OptionValue<Extent> extent_value(const std::string& name, int max);

/// One of these names.
[[nodiscard]] OptionValue<std::string> one_of(const std::vector<std::string>& names);

/// One of these values, by its name.
template <class T>
[[nodiscard]] OptionValue<T> choice_of(const std::vector<Named<T>>& choices) {
  std::vector<std::string> names;
  names.reserve(choices.size());
  for (const Named<T>& each : choices) names.emplace_back(each.name);
  const OptionValue<std::string> known = one_of(names);
  return {known.name,
          [choices, known](const std::string& option, const std::string& text) {
            const std::string name = known.read(option, text);
            for (const Named<T>& each : choices) {
              if (name == each.name) return each.value;
            }
            return choices.front().value;  // never: `known` has refused other names
          },
          names};
}
template <NamedEnum E>
[[nodiscard]] OptionValue<E> choice_of() {
  return choice_of(names_of(E{}));
}

}  // namespace episcope::cli
