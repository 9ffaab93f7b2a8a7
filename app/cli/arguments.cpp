// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"

#include "app/cli/output.h"
#include "app/session/command_line.h"
#include "engine/core/parameter.h"
#include "engine/core/text.h"
#include "engine/core/text_table.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <iostream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

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

/// Help as wide as the terminal, which says which options are required.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    const std::string name = make_option_name(option, is_positional) + make_option_opts(option);
    const bool must_be_said = option->get_required() && !is_positional;
    return help_entry(name, make_option_desc(option) + (must_be_said ? " (required)" : ""),
                      static_cast<int>(get_column_width()), help_columns());
  }
};

constexpr const char* kReadingHint =
    "How INPUT is read can be stated, too: see 'episcope-cli help reading'.\n";

/// In our words, where the library speaks of types and counts.
std::string sentence_of(const CLI::ParseError& error, const CLI::App& app) {
  const std::string text = one_line(error.what());
  const std::size_t colon = text.find(": ");
  if (colon == std::string::npos) return text;
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error)) {
    return text.substr(0, colon) + " needs a value";
  }
  if (dynamic_cast<const CLI::ExtrasError*>(&error)) {
    return "too many arguments: " + joined(app.remaining(), " ");
  }
  return text;
}

/// The American spelling of a name: earlier versions had options in British English.
std::string american(std::string name) {
  constexpr std::pair<std::string_view, std::string_view> kSpellings[] = {
      {"alise", "alize"}, {"centre", "center"}, {"colour", "color"}};
  for (const auto& [british, here] : kSpellings) {
    const std::size_t place = name.find(british);
    if (place != std::string::npos) name.replace(place, british.size(), here);
  }
  return name;
}

constexpr const char* kHelpAsJson = "--help-json";

}  // namespace

bool asks_for_help(const std::string& argument) {
  return argument == "-h" || argument == "--help" || argument == kHelpAsJson;
}

struct Arguments::State {
  State(const std::string& verb_name, const Text& text)
      : verb(verb_name),
        summary(text.summary),
        app(wrapped(text.summary, help_columns()), "episcope-cli " + verb_name),
        example(text.example) {
    app.formatter(std::make_shared<HelpFormatter>());
    app.set_help_flag("-h,--help", "Print this help and exit");
    takes_value["-h"] = takes_value["--help"] = false;
  }

  CLI::Option* declare(CLI::Option* added, const OptionText& text, bool with_value) {
    const std::vector<std::string> names = CLI::detail::split(text.names, ',');
    for (const auto& name : names) takes_value[name] = with_value;
    if (text.may_begin_with_dash) takes_any.insert(names.begin(), names.end());
    options.push_back(Json::object({{"names", names},
                                    {"value", text.value_name},
                                    {"choices", text.choices},
                                    {"help", text.help},
                                    {"heading", group}}));
    return added->group(group == kReading ? std::string() : group);
  }

  void declare_positional(CLI::Option* added, bool has_several, Need need = Need::Required) {
    added->required(need == Need::Required)->option_text(" ");
    positionals.push_back(Json::object({{"name", added->get_name()},
                                        {"help", added->get_description()},
                                        {"several", has_several}}));
  }

  [[nodiscard]] Json description() const {
    return Json::object({{"verb", verb},
                         {"summary", summary},
                         {"example", example},
                         {"positionals", positionals},
                         {"options", options}});
  }

  /// Values are read after all else was found right: whoever asks for help gets it.
  void assign_values() const {
    for (const Given& each : given) {
      if (each.option->count() > 0) each.assign(each.text);
    }
  }

  void check_exclusions() const {
    for (const auto& names : exclusions) {
      const auto count = std::ranges::count_if(
          names, [this](const std::string& name) { return app.get_option(name)->count() > 0; });
      if (count < 2) continue;
      const std::vector<std::string> others(names.begin(), names.end() - 1);
      throw UsageError(verb + ": " + joined(others, ", ") + " and " + names.back() +
                       " exclude each other");
    }
  }

  /// Refuses options that do not exist, whatever else is wrong, and binds negative numbers, and
  /// any value of an option that takes such, to the option before them.
  [[nodiscard]] std::vector<std::string> checked(const std::vector<std::string>& arguments) const {
    std::vector<std::string> result;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      std::string argument = known_spelling(arguments[i]);
      if (argument.size() > 1 && argument[0] == '-' && !is_number_like(argument)) {
        check_option(name_of(argument));
        const auto found = takes_value.find(argument);
        if (found != takes_value.end() && found->second && i + 1 < arguments.size() &&
            (is_number_like(arguments[i + 1]) ||
             (takes_any.contains(argument) && arguments[i + 1].starts_with("-")))) {
          argument += (argument.starts_with("--") ? "=" : "") + arguments[++i];
        }
      }
      result.push_back(argument);
    }
    return result;
  }

  /// An option in the spelling that it is declared with, if it is known in one: its present name,
  /// American, and with hyphens where earlier versions had "_".
  [[nodiscard]] std::string known_spelling(const std::string& argument) const {
    const std::string name = name_of(argument);
    if (const auto now = earlier.find(name); now != earlier.end()) {
      return now->second + argument.substr(name.size());
    }
    const std::string here = option_name(american(name));
    const bool is_old = name != here && !takes_value.contains(name) && takes_value.contains(here);
    return is_old ? here + argument.substr(name.size()) : argument;
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

  /// Whether there are options that only `help reading` lists.
  [[nodiscard]] bool has_reading() const {
    return std::ranges::any_of(options,
                               [](const Json& each) { return each["heading"] == kReading; });
  }

  [[nodiscard]] std::string help() {
    app.footer((has_reading() ? wrapped(kReadingHint, help_columns()) : std::string()) +
               std::string("Example:\n  ") + example);
    return app.help();
  }

  std::string verb;
  std::string summary;
  CLI::App app;
  std::string example;
  std::string group = "Options";
  std::vector<Json> positionals;
  std::vector<Json> options;
  std::map<std::string, bool> takes_value;
  std::map<std::string, std::string> earlier;  ///< Present names of options by earlier ones.
  std::set<std::string> takes_any;             ///< Options whose values may begin with a dash.

  /// An option with a value, or a flag that stands for one.
  struct Given {
    CLI::Option* option = nullptr;
    std::string text{};
    Assign assign;
  };
  std::deque<Given> given;  // a deque, because CLI11 keeps the addresses of texts
  std::vector<std::vector<std::string>> exclusions;
};

Arguments::Arguments(const std::string& verb, const Text& text)
    : state_(std::make_unique<State>(verb, text)) {}

Arguments::~Arguments() = default;

void Arguments::positional(const std::string& name, std::string& value, const std::string& help) {
  state_->declare_positional(state_->app.add_option(name, value, help), false);
}

void Arguments::positionals(const std::string& name, std::vector<std::string>& values,
                            const std::string& help) {
  state_->declare_positional(state_->app.add_option(name, values, help), true);
}

void Arguments::optional_positionals(const std::string& name, std::vector<std::string>& values,
                                     const std::string& help) {
  state_->declare_positional(state_->app.add_option(name, values, help), true, Need::Optional);
}

void Arguments::flag(const std::string& names, bool& value, const std::string& help) {
  state_->declare(state_->app.add_flag(names, value, help), {names, {}, help}, false);
}

void Arguments::add_flag(const OptionText& text, Assign assign) {
  auto& given = state_->given.emplace_back(State::Given{.assign = std::move(assign)});
  given.option = state_->declare(state_->app.add_flag(text.names, text.help), text, false);
}

void Arguments::add_option(const OptionText& text, Assign assign, Need need) {
  auto& given = state_->given.emplace_back(State::Given{.assign = std::move(assign)});
  given.option =
      state_->declare(state_->app.add_option(text.names, given.text, text.help), text, true)
          ->take_last()
          ->option_text(text.value_name)
          ->required(need == Need::Required);
}

void Arguments::list_option(const std::string& names, std::vector<std::string>& values,
                            const std::string& value_name, const std::string& help) {
  state_->declare(state_->app.add_option(names, values, help), {names, value_name, help}, true)
      ->option_text(value_name);
}

void Arguments::earlier_name(const std::string& earlier, const std::string& name) {
  state_->earlier[earlier] = name;
}

void Arguments::exclude_each_other(const std::vector<std::string>& names) {
  state_->exclusions.push_back(names);
}

void Arguments::check_uses(const std::vector<Use>& uses) const {
  for (const Use& use : uses) {
    if (use.has_effect) continue;
    for (const std::string& name : use.names) {
      if (state_->app.get_option(name)->count() == 0) continue;
      throw UsageError(state_->verb + ": " + name + " has no effect " + use.why_not +
                       "; leave it out");
    }
  }
}

void Arguments::heading(const std::string& text) {
  state_->group = text;
}

bool Arguments::parse(const std::vector<std::string>& arguments) {
  if (std::ranges::find(arguments, kHelpAsJson) != arguments.end()) {
    print_json(state_->description());
    return false;
  }
  std::vector<std::string> left = state_->checked(arguments);
  std::reverse(left.begin(), left.end());  // as CLI11 wants them
  try {
    state_->app.parse(left);
  } catch (const CLI::CallForHelp&) {
    std::cout << state_->help();
    return false;
  } catch (const CLI::ParseError& error) {
    throw UsageError(state_->verb + ": " + sentence_of(error, state_->app) + "; see episcope-cli " +
                     state_->verb + " --help");
  }
  state_->assign_values();
  state_->check_exclusions();
  return true;
}

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
  return {
      name, [](const std::string& option, const std::string& text) {
        if (text != "-" || option == "--output") return text;
        throw UsageError(option + " takes no -, which is standard input or output; name a file");
      }};
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

OptionValue<std::vector<std::string>> words_value(const std::string& name) {
  return {name, [](const std::string& option, const std::string& text) {
            std::vector<std::string> words = CLI::detail::split(text, ',');
            std::erase(words, "");
            if (words.empty()) refuse(option, text, "names, separated by commas");
            return words;
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

UsageError unknown_name(const std::string& kind, const std::string& name,
                        const std::vector<std::string>& names) {
  const std::string beginning = "there is no " + kind + " '" + name + "'; ";
  if (const std::string nearest = nearest_name(name, names); !nearest.empty()) {
    return UsageError(beginning + "did you mean '" + nearest + "'?");
  }
  return UsageError(beginning + "use one of " + joined(names, ", "));
}

namespace {

constexpr int kUsual = 80, kFewest = 40, kMost = 100;
constexpr std::size_t kContinued = 2;

int columns_of_terminal() {
  winsize size{};
  if (isatty(STDOUT_FILENO) == 1 && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0) {
    return size.ws_col;
  }
  const char* const stated = std::getenv("COLUMNS");
  return stated ? std::atoi(stated) : 0;
}

/// Words of one paragraph; the first line begins with `first` spaces, the others with `others`.
std::string paragraph(std::string_view text, std::size_t first, std::size_t others,
                      std::size_t columns) {
  std::istringstream words{std::string(text)};
  std::string lines(first, ' ');
  std::size_t used = first;
  bool begins = true;
  for (std::string word; words >> word;) {
    const std::size_t length = character_count(word);
    if (!begins && used + 1 + length > columns) {
      lines += '\n' + std::string(others, ' ');
      used = others;
      begins = true;
    }
    lines += (begins ? "" : " ") + word;
    used += length + (begins ? 0 : 1);
    begins = false;
  }
  return lines;
}

}  // namespace

int help_columns() {
  const int found = columns_of_terminal();
  return found > 0 ? std::clamp(found, kFewest, kMost) : kUsual;
}

std::string wrapped(std::string_view text, int columns) {
  const auto most = static_cast<std::size_t>(columns);
  std::string result;
  std::string open;  // the paragraph so far
  const auto close = [&] {
    if (!open.empty()) result += paragraph(open, 0, 0, most) + '\n';
    open.clear();
  };
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    const std::size_t indent = line.find_first_not_of(' ');
    if (indent == 0) {
      open += line + ' ';
      continue;
    }
    close();
    if (indent == std::string::npos) {
      result += '\n';
    } else {
      result += paragraph(line, indent, indent + kContinued, most) + '\n';
    }
  }
  close();
  if (!result.empty() && !text.ends_with('\n')) result.pop_back();
  return result;
}

namespace {

/// "--what a|b|c", with its choices in lines below each other where one is too short.
std::string broken_choices(const std::string& name, std::size_t columns) {
  if (character_count(name) <= columns) return name;
  const std::string begin = name.substr(0, name.rfind(' ') + 1);
  std::string lines = begin;
  std::size_t used = character_count(begin);
  for (std::size_t from = begin.size(); from < name.size();) {
    const std::size_t bar = std::min(name.find('|', from), name.size() - 1);
    const std::string choice = name.substr(from, bar + 1 - from);
    const std::size_t length = character_count(choice);
    if (used + length > columns && used > begin.size()) {
      lines += '\n' + std::string(begin.size(), ' ');
      used = begin.size();
    }
    lines += choice;
    used += length;
    from = bar + 1;
  }
  return lines;
}

}  // namespace

std::string help_entry(const std::string& name, const std::string& text, int indent, int columns) {
  const std::string begin = broken_choices("  " + name, static_cast<std::size_t>(columns));
  const auto at = static_cast<std::size_t>(indent);
  const std::size_t used = character_count(begin);
  const std::string lines = paragraph(text, at, at, static_cast<std::size_t>(columns));
  if (text.empty()) return begin + '\n';
  if (used + 1 >= at) return begin + '\n' + lines + '\n';
  return begin + std::string(at - used, ' ') + lines.substr(at) + '\n';
}

}  // namespace episcope::cli
