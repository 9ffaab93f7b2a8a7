// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/indices.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace episcope::cli {

/// The arguments of one verb: declares what there is, then parses. Values land in the variables
/// given, which must outlive `parse`. Names are as typed: "--views", or "-o,--output".
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
  void flag(const std::string& names, bool& value, const std::string& help);
  /// An option with a value, which help calls `value_name`.
  void option(const std::string& names, std::string& value, const std::string& value_name,
              const std::string& help);
  void required_option(const std::string& names, std::string& value, const std::string& value_name,
                       const std::string& help);
  /// An option with one or more values, which may be given several times.
  void list_option(const std::string& names, std::vector<std::string>& values,
                   const std::string& value_name, const std::string& help);
  void choice(const std::string& names, std::string& value, const std::vector<std::string>& choices,
              const std::string& help);
  /// Options declared from here on stand under this heading in the help.
  void heading(const std::string& text);

  /// Returns false if help was asked for and printed. Throws UsageError, naming the nearest option
  /// for one that does not exist.
  [[nodiscard]] bool parse(const std::vector<std::string>& arguments);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Values that options are written in. All throw UsageError naming the option.
[[nodiscard]] int parse_integer(const std::string& option, const std::string& text, int min,
                                int max);
[[nodiscard]] double parse_real(const std::string& option, const std::string& text, double min,
                                double max);
/// "A,B" with A < B.
[[nodiscard]] Interval parse_interval(const std::string& option, const std::string& text);
/// "V,U".
[[nodiscard]] ViewIndex parse_view(const std::string& option, const std::string& text);
/// "AxB" with both in [1, max].
struct Extent {
  int first = 0;
  int second = 0;
};
[[nodiscard]] Extent parse_extent(const std::string& option, const std::string& text, int max);

}  // namespace episcope::cli
