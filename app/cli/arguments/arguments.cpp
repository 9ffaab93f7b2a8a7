// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments/arguments.h"

#include "app/cli/arguments/usage_error.h"
#include "engine/core/parameter/parameter.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <iostream>
#include <map>

namespace episcope::cli {
namespace {

bool is_number_like(const std::string& text) {
  return text.size() > 1 && text[0] == '-' &&
         (std::isdigit(static_cast<unsigned char>(text[1])) != 0 || text[1] == '.');
}

std::string name_of(const std::string& argument) {
  return argument.substr(0, argument.find('='));
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

struct Arguments::State {
  State(const std::string& verb_name, const Text& text)
      : verb(verb_name), app(text.summary, "episcope-cli " + verb_name) {
    app.footer("Example:\n  " + text.example);
    app.set_help_flag("-h,--help", "Print this and exit");
    takes_value["-h"] = takes_value["--help"] = false;
  }

  CLI::Option* declare(CLI::Option* added, const std::string& names, bool with_value) {
    for (const auto& name : CLI::detail::split(names, ',')) takes_value[name] = with_value;
    return added->group(group);
  }

  /// Refuses options that do not exist, whatever else is wrong, and binds negative numbers to the
  /// option before them.
  [[nodiscard]] std::vector<std::string> checked(const std::vector<std::string>& arguments) const {
    std::vector<std::string> result;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      std::string argument = arguments[i];
      if (argument.size() > 1 && argument[0] == '-' && !is_number_like(argument)) {
        check_option(name_of(argument));
        const auto found = takes_value.find(argument);
        if (found != takes_value.end() && found->second && i + 1 < arguments.size() &&
            is_number_like(arguments[i + 1])) {
          argument += (argument.starts_with("--") ? "=" : "") + arguments[++i];
        }
      }
      result.push_back(argument);
    }
    return result;
  }

  void check_option(const std::string& name) const {
    const bool is_long = name.starts_with("--");
    // "-oFILE" is "-o FILE".
    if (takes_value.contains(is_long ? name : name.substr(0, 2))) return;
    std::vector<std::string> names;
    for (const auto& [known, with_value] : takes_value) {
      if (known.starts_with("--")) names.push_back(known.substr(2));
    }
    const std::string nearest = nearest_name(name.substr(name.find_first_not_of('-')), names);
    throw UsageError(verb + " has no option '" + name + "'; " +
                     (nearest.empty() ? "see episcope-cli " + verb + " --help"
                                      : "did you mean '--" + nearest + "'?"));
  }

  std::string verb;
  CLI::App app;
  std::string group = "Options";
  std::map<std::string, bool> takes_value;
};

Arguments::Arguments(const std::string& verb, const Text& text)
    : state_(std::make_unique<State>(verb, text)) {}

Arguments::~Arguments() = default;

void Arguments::positional(const std::string& name, std::string& value, const std::string& help) {
  state_->app.add_option(name, value, help)->required()->option_text(" ");
}

void Arguments::positionals(const std::string& name, std::vector<std::string>& values,
                            const std::string& help) {
  state_->app.add_option(name, values, help)->required()->option_text(" ");
}

void Arguments::flag(const std::string& names, bool& value, const std::string& help) {
  state_->declare(state_->app.add_flag(names, value, help), names, false);
}

void Arguments::option(const std::string& names, std::string& value, const std::string& value_name,
                       const std::string& help) {
  state_->declare(state_->app.add_option(names, value, help), names, true)
      ->take_last()
      ->option_text(value_name);
}

void Arguments::required_option(const std::string& names, std::string& value,
                                const std::string& value_name, const std::string& help) {
  state_->declare(state_->app.add_option(names, value, help), names, true)
      ->take_last()
      ->option_text(value_name)
      ->required();
}

void Arguments::list_option(const std::string& names, std::vector<std::string>& values,
                            const std::string& value_name, const std::string& help) {
  state_->declare(state_->app.add_option(names, values, help), names, true)
      ->option_text(value_name);
}

void Arguments::choice(const std::string& names, std::string& value,
                       const std::vector<std::string>& choices, const std::string& help) {
  std::string list;
  for (const auto& each : choices) list += (list.empty() ? "" : "|") + each;
  const auto check = [names, choices](std::string& text) {
    if (std::find(choices.begin(), choices.end(), text) == choices.end()) {
      throw unknown_name("value of " + names, text, choices);
    }
    return std::string();
  };
  state_->declare(state_->app.add_option(names, value, help), names, true)
      ->take_last()
      ->option_text(list)
      ->check(CLI::Validator(check, "", ""));
}

void Arguments::heading(const std::string& text) {
  state_->group = text;
}

bool Arguments::parse(const std::vector<std::string>& arguments) {
  std::vector<std::string> left = state_->checked(arguments);
  std::reverse(left.begin(), left.end());  // as CLI11 wants them
  try {
    state_->app.parse(left);
  } catch (const CLI::CallForHelp&) {
    std::cout << state_->app.help();
    return false;
  } catch (const CLI::ParseError& error) {
    throw UsageError(state_->verb + ": " + one_line(error.what()) + "; see episcope-cli " +
                     state_->verb + " --help");
  }
  return true;
}

}  // namespace episcope::cli
