// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/error.h"
#include "engine/core/indices.h"
#include "engine/core/schema.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
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

/// Any text: the name of a file, of an INPUT. Only for "--output" it may be "-".
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
/// Words between commas, at least one.
[[nodiscard]] OptionValue<std::vector<std::string>> words_value(const std::string& name);

/// "AxB" with both in [1, max].
struct Extent {
  int first = 0;
  int second = 0;
};
[[nodiscard]] OptionValue<Extent> extent_value(const std::string& name, int max);

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

/// Whether this argument asks for the help of a verb, whatever stands beside it.
[[nodiscard]] bool asks_for_help(const std::string& argument);

/// The arguments of one verb: declares what there is, then parses. Values land in the variables
/// given, which must outlive `parse` and keep what they hold where an option is not given. Names
/// are as typed: "--views", or "-o,--output".
class Arguments {
 public:
  struct Text {
    std::string summary;
    std::string example;  ///< A command line that works, or several lines of them.
  };

  Arguments(const std::string& verb, const Text& text);
  ~Arguments();
  Arguments(const Arguments&) = delete;
  Arguments& operator=(const Arguments&) = delete;

  void positional(const std::string& name, std::string& value, const std::string& help);
  /// One or more.
  void positionals(const std::string& name, std::vector<std::string>& values,
                   const std::string& help);
  /// Any number, none included.
  void optional_positionals(const std::string& name, std::vector<std::string>& values,
                            const std::string& help);

  void flag(const std::string& names, bool& value, const std::string& help);
  /// A flag that stands for a value.
  template <class T>
  void flag(const std::string& names, T& value, T meaning, const std::string& help) {
    add_flag({names, {}, help}, [&value, meaning](const std::string&) { value = meaning; });
  }

  /// An option with a value, one of whose names is long. Of several values the last counts. An
  /// empty text leaves a variable that may be empty as it is.
  template <class T, class Typed>
  void option(const std::string& names, T& value, const OptionValue<Typed>& typed,
              const std::string& help) {
    add_option({names, typed.name, help, typed.choices, typed.may_begin_with_dash},
               assignment(names, value, typed), Need::Optional);
  }
  template <class T, class Typed>
  void required_option(const std::string& names, T& value, const OptionValue<Typed>& typed,
                       const std::string& help) {
    add_option({names, typed.name, help, typed.choices, typed.may_begin_with_dash},
               assignment(names, value, typed), Need::Required);
  }
  /// An option with one or more texts, which may be given several times.
  void list_option(const std::string& names, std::vector<std::string>& values,
                   const std::string& value_name, const std::string& help);

  /// An earlier name of an option, which stays valid and help does not list.
  void earlier_name(const std::string& earlier, const std::string& name);

  /// Options of which only one may be given.
  void exclude_each_other(const std::vector<std::string>& names);
  /// Options that have an effect only under a condition.
  struct Use {
    std::vector<std::string> names;
    bool has_effect = true;
    std::string why_not;  ///< After "has no effect": "without --labeling", "on a picture".
  };
  /// Throws UsageError that names the first option that was given and has no effect. To be called
  /// after `parse`.
  void check_uses(const std::vector<Use>& uses) const;

  /// Heading of options that help does not list but names `help reading` for.
  static constexpr const char* kReading = "Reading";
  /// Options declared from here on stand under this heading in the help.
  void heading(const std::string& text);

  /// Returns false if help was asked for and printed, for `--help-json` as one JSON object, of
  /// which pages of the manual and completions are made (app/cli/pages). Throws UsageError, naming
  /// the nearest option for one that does not exist, and for values that `OptionValue::read`
  /// refuses.
  [[nodiscard]] bool parse(const std::vector<std::string>& arguments);

 private:
  struct State;
  struct OptionText {
    std::string names;
    std::string value_name;
    std::string help;
    std::vector<std::string> choices{};
    bool may_begin_with_dash = false;
  };
  enum class Need { Optional, Required };
  using Assign = std::function<void(const std::string& text)>;

  /// "--output" of "-o,--output".
  [[nodiscard]] static std::string long_name(const std::string& names) {
    return names.substr(names.find("--"));
  }
  template <class T, class Typed>
  [[nodiscard]] static Assign assignment(const std::string& names, T& value,
                                         const OptionValue<Typed>& typed) {
    return [&value, option = long_name(names), read = typed.read](const std::string& text) {
      if constexpr (requires { value.reset(); }) {
        if (text.empty()) return;
      }
      value = read(option, text);
    };
  }

  void add_flag(const OptionText& text, Assign assign);
  void add_option(const OptionText& text, Assign assign, Need need);

  std::unique_ptr<State> state_;
};

/// The command line itself is wrong: exit code 2.
class UsageError : public Error {
 public:
  using Error::Error;
};

/// "there is no <kind> '<name>'; did you mean '<nearest>'?" or, if none is near, the list of names.
[[nodiscard]] UsageError unknown_name(const std::string& kind, const std::string& name,
                                      const std::vector<std::string>& names);

/// Columns of help: the width of the terminal on standard output, else of the environment
/// (COLUMNS), else 80; between 40 and 100.
[[nodiscard]] int help_columns();

/// Text in lines of at most `columns` letters, broken at spaces where that is possible. A line that
/// begins with spaces stays one of its own, and is continued two further in; others are joined to
/// paragraphs. Letters of several bytes count once.
[[nodiscard]] std::string wrapped(std::string_view text, int columns);

/// An entry of a list: `name` two in, and `text` from column `indent` on, on the next line if the
/// name is too long. Choices (a|b|c) that are wider than the columns continue in further lines.
[[nodiscard]] std::string help_entry(const std::string& name, const std::string& text, int indent,
                                     int columns);

}  // namespace episcope::cli
