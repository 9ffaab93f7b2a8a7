// SPDX-License-Identifier: BSD-3-Clause
// episcope_pages DIR [HELP]: writes man/*.1 and the completions of bash, zsh and fish below DIR;
// with HELP, a file of what the window prints for --help, its page too.
#include "app/cli/verbs/verbs.h"
#include "engine/core/text.h"
#include "engine/core/version.h"
#include "engine/disparity/registry.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace episcope::cli {
namespace {

/// An option as it is declared.
struct OptionPage {
  std::vector<std::string> names;    ///< "-o", "--output".
  std::string value;                 ///< "OUT.h5"; empty for a flag.
  std::vector<std::string> choices;  ///< Where only certain words are values.
  std::string help;
  std::string heading;
};

struct PositionalPage {
  std::string name;
  std::string help;
  bool several = false;
};

/// A method of `estimate`, with the options that are its parameters.
struct MethodPage {
  std::string id;
  std::string name;
  std::string summary;
  std::string reference;
  std::vector<OptionPage> parameters;
};

/// A verb as it declares itself.
struct VerbPage {
  std::string name;
  std::string summary;      ///< Of the table of verbs, one line.
  std::string description;  ///< Of the verb's help, several lines.
  std::string example;      ///< One or more lines.
  std::vector<PositionalPage> positionals;
  std::vector<OptionPage> options;
  std::vector<MethodPage> methods{};  ///< Of `estimate`.
};

using nlohmann::json;

/// What a verb prints.
json answer_of(const Verb& verb, VerbArguments arguments) {
  arguments.emplace_back("--help-json");
  std::ostringstream answer;
  std::streambuf* const output = std::cout.rdbuf(answer.rdbuf());
  verb.run(arguments, {});
  std::cout.rdbuf(output);
  return json::parse(answer.str());
}

std::vector<OptionPage> options_of(const json& answer) {
  std::vector<OptionPage> options;
  for (const json& each : answer.at("options")) {
    options.push_back({each.at("names"), each.at("value"), each.at("choices"), each.at("help"),
                       each.at("heading")});
  }
  return options;
}

VerbPage page_of(const Verb& verb) {
  const json answer = answer_of(verb, {});
  VerbPage page{verb.name, verb.summary,      answer.at("summary"), answer.at("example"),
                {},        options_of(answer)};
  for (const json& each : answer.at("positionals")) {
    page.positionals.push_back({each.at("name"), each.at("help"), each.at("several")});
  }
  return page;
}

/// The methods of `estimate`: what it declares beyond what it declares without a method.
std::vector<MethodPage> methods_of(const Verb& verb, std::size_t common) {
  std::vector<MethodPage> methods;
  for (const Estimator& estimator : registered_estimators()) {
    const EstimatorInfo& info = estimator.info;
    std::vector<OptionPage> options = options_of(answer_of(verb, {info.id}));
    options.erase(options.begin(), options.begin() + static_cast<std::ptrdiff_t>(common));
    methods.push_back({info.id, info.name, info.summary, info.reference, std::move(options)});
  }
  return methods;
}

/// Every verb, in the order of the help, asked for its `--help-json`.
std::vector<VerbPage> verb_pages() {
  std::vector<VerbPage> pages;
  for (const Verb& verb : verbs()) {
    VerbPage& page = pages.emplace_back(page_of(verb));
    if (verb.run == run_estimate) page.methods = methods_of(verb, page.options.size());
  }
  return pages;
}

/// A text in which troff sees no request and no hyphen but typed ones; lines may break after "|".
std::string troff(std::string_view text) {
  std::string result;
  bool begins_line = true;
  for (const char c : text) {
    if (begins_line && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else if (c == '|') {
      result += "|\\:";
    } else {
      result += c;
    }
    begins_line = c == '\n';
  }
  return result;
}

/// "\fBbold\fR", "\fIitalic\fR".
std::string bold(std::string_view text) {
  return "\\fB" + troff(text) + "\\fR";
}
std::string italic(std::string_view text) {
  return "\\fI" + troff(text) + "\\fR";
}

std::string head(const std::string& title, const std::string& summary) {
  return fmt::format(
      ".TH {} 1 \"\" \"Episcope {}\" \"User Commands\"\n.nh\n.ad l\n.SH NAME\n{} \\- {}\n", title,
      kVersion, troff(title), troff(summary));
}

std::string section(const std::string& title) {
  return ".SH " + title + "\n";
}

std::string typed_lines(const std::string& lines) {
  return ".nf\n" + troff(lines) + (lines.ends_with('\n') ? "" : "\n") + ".fi\n";
}

std::string entry(const std::string& term, const std::string& text) {
  return ".TP\n" + term + "\n" + troff(text) + "\n";
}

std::string option_entry(const OptionPage& option) {
  const std::string names = joined(option.names, ", ", bold);
  if (option.value.empty()) return entry(names, option.help);
  return entry(fmt::format("{} {}", names, italic(option.value)), option.help);
}

std::string option_entries(const std::vector<OptionPage>& options, std::string heading) {
  std::string text;
  for (const OptionPage& option : options) {
    if (option.heading != heading) {
      heading = option.heading;
      text += ".SS \"" + troff(heading) + "\"\n";
    }
    text += option_entry(option);
  }
  return text;
}

std::string method_entries(const std::vector<MethodPage>& methods) {
  if (methods.empty()) return {};
  std::string text = section("METHODS");
  for (const MethodPage& method : methods) {
    text += ".SS \"" + troff(method.id) + "\"\n" +
            troff(method.name + ": " + method.summary + ". " + method.reference + ".") + "\n";
    for (const OptionPage& option : method.parameters) text += option_entry(option);
  }
  return text;
}

std::string exit_status() {
  return section("EXIT STATUS") + entry(bold(fmt::format("{}", kSuccess)), "Done.") +
         entry(bold(fmt::format("{}", kFailed)), "Failed; a sentence on standard error says why.") +
         entry(bold(fmt::format("{}", kWrongUsage)), "The command line is wrong.") +
         entry(bold(fmt::format("{}", kCancelled)), "Cancelled; nothing half-written is left.");
}

std::string synopsis(const VerbPage& verb) {
  std::string text =
      section("SYNOPSIS") + bold("episcope-cli " + verb.name) + " [" + italic("OPTION") + "]...";
  for (const PositionalPage& each : verb.positionals) {
    text += fmt::format(" {}{}", italic(each.name), each.several ? "..." : "");
  }
  return text + "\n";
}

std::string verb_man_page(const VerbPage& verb) {
  std::string text = head("episcope-cli-" + verb.name, verb.summary) + synopsis(verb);
  text += section("DESCRIPTION") + typed_lines(verb.description);
  for (const PositionalPage& each : verb.positionals) text += entry(italic(each.name), each.help);
  text += section("OPTIONS") + entry(bold("-h") + ", " + bold("--help"), "Print help and exit");
  text += option_entries(verb.options, "Options") + method_entries(verb.methods) + exit_status();
  text += section("EXAMPLES") + typed_lines("  " + verb.example);
  return text + section("SEE ALSO") + ".BR episcope\\-cli (1)\n";
}

std::string program_man_page(const std::vector<VerbPage>& verbs) {
  std::string text = head("episcope-cli", "disparity and labels of 4D light fields") +
                     section("SYNOPSIS") + bold("episcope-cli") + " " + italic("VERB") + " ...\n" +
                     section("DESCRIPTION") + troff(kProgramSummary) + "\n.PP\n" +
                     troff(kInputHelp) + section("VERBS");
  for (const VerbPage& verb : verbs) {
    text += entry(bold(verb.name), verb.summary + "; see episcope-cli-" + verb.name + "(1).");
  }
  text += section("OPTIONS") +
          entry(bold("-h") + ", " + bold("--help"), "Print help, or after a verb its help.") +
          entry(bold("--version"), "Print version, commit and libraries.");
  text += exit_status() + section("EXAMPLES") + typed_lines(kProgramExample);
  return text + section("SEE ALSO") + ".BR episcope (1)\n";
}

/// Page of the window, around what its `--help` prints.
std::string window_man_page(const std::string& help) {
  return head("episcope", "views, EPIs, disparity and labels of 4D light fields") +
         section("SYNOPSIS") + bold("episcope") + " [" + italic("OPTION") + "]... [" +
         italic("INPUT") + "]\n" + section("DESCRIPTION") + typed_lines(help) +
         section("SEE ALSO") + ".BR episcope\\-cli (1)\n";
}

constexpr const char* kHead = R"(# bash completion for episcope-cli
_episcope_cli() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]}
  local verb=${COMP_WORDS[1]} method=${COMP_WORDS[2]} words="" options=""
  COMPREPLY=()
)";

constexpr const char* kTail = R"(
  [[ $cur == -* ]] && words=$options
  COMPREPLY=($(compgen -W "$words" -- "$cur"))
}
complete -o default -F _episcope_cli episcope-cli
)";

std::string names_of(const std::vector<OptionPage>& options) {
  return joined(options, " ", [](const OptionPage& each) { return joined(each.names, " "); });
}

/// Branches that complete the value of an option: its words, or a file where it has none.
std::string value_branches(const std::vector<OptionPage>& options, const std::string& indent) {
  std::string text = indent + "case $prev in\n";
  for (const OptionPage& each : options) {
    if (each.value.empty()) continue;
    const std::string names = joined(each.names, "|");
    text += each.choices.empty() ? fmt::format("{}  {}) return ;;\n", indent, names)
                                 : fmt::format("{}  {}) words=\"{}\" options=\"\" ;;\n", indent,
                                               names, joined(each.choices, " "));
  }
  return text + indent + "esac\n";
}

std::string method_branches(const VerbPage& verb) {
  if (verb.methods.empty()) return {};
  const std::string ids = joined(verb.methods, " ", &MethodPage::id);
  std::string text = fmt::format("      ((COMP_CWORD == 2)) && words=\"{}\"\n", ids);
  text += "      case $method in\n";
  for (const MethodPage& method : verb.methods) {
    text +=
        fmt::format("        {})\n          options+=\" {}\"\n{}          ;;\n", method.id,
                    names_of(method.parameters), value_branches(method.parameters, "          "));
  }
  return text + "      esac\n";
}

/// Completion of verbs, options, methods with their parameters, and the words that options take;
/// where none of these is asked for, of files.
std::string bash_completion(const std::vector<VerbPage>& verbs) {
  std::string text = kHead;
  text += fmt::format(
      "  if ((COMP_CWORD == 1)); then\n    COMPREPLY=($(compgen -W \"{} --help --version\" -- "
      "\"$cur\"))\n    return\n  fi\n  case $verb in\n",
      joined(verbs, " ", &VerbPage::name));
  for (const VerbPage& verb : verbs) {
    text += fmt::format("    {})\n      options=\"--help {}\"\n{}{}      ;;\n", verb.name,
                        names_of(verb.options), method_branches(verb),
                        value_branches(verb.options, "      "));
  }
  return text + "  esac" + kTail;
}

std::string fish_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') result += '\\';
    result += c;
  }
  return result + "'";
}

std::string option_line(const OptionPage& option, const std::string& condition) {
  std::string line = "complete -c episcope-cli -n " + fish_quoted(condition);
  for (const std::string& name : option.names) {
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (!option.choices.empty()) {
    line += " -x -a " + fish_quoted(joined(option.choices, " "));
  } else if (!option.value.empty()) {
    line += " -r";
  }
  return line + " -d " + fish_quoted(option.help) + "\n";
}

std::string fish_completion(const std::vector<VerbPage>& verbs) {
  std::string text = "# fish completion for episcope-cli\n";
  text +=
      "complete -c episcope-cli -n __fish_use_subcommand -f -l version -d 'Print the version'\n";
  text += "complete -c episcope-cli -f -l help -s h -d 'Print help'\n";
  for (const VerbPage& verb : verbs) {
    const std::string is_verb = "__fish_seen_subcommand_from " + verb.name;
    text += fmt::format("complete -c episcope-cli -n __fish_use_subcommand -f -a {} -d {}\n",
                        verb.name, fish_quoted(verb.summary));
    for (const OptionPage& option : verb.options) text += option_line(option, is_verb);
    for (const MethodPage& method : verb.methods) {
      text += fmt::format("complete -c episcope-cli -n {} -f -a {} -d {}\n",
                          fish_quoted(is_verb + "; and not __fish_seen_subcommand_from " +
                                      joined(verb.methods, " ", &MethodPage::id)),
                          method.id, fish_quoted(method.summary));
      const std::string is_method = is_verb + "; and __fish_seen_subcommand_from " + method.id;
      for (const OptionPage& option : method.parameters) text += option_line(option, is_method);
    }
  }
  return text;
}

/// Within single quotes, with what `_arguments` reads as its own escaped.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
      continue;
    }
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

/// One line of `_arguments` for each name of the option.
std::string option_lines(const OptionPage& option, const std::string& indent) {
  std::string action;
  if (!option.value.empty()) {
    const std::string words = joined(option.choices, " ");
    action = fmt::format(":{}:{}", escaped(option.value),
                         words.empty() ? "_files" : fmt::format("({})", words));
  }
  std::string text;
  for (const std::string& name : option.names) {
    text += fmt::format("{}'({}){}[{}]{}'\n", indent, joined(option.names, " "), name,
                        escaped(option.help), action);
  }
  return text;
}

std::string positional_lines(const VerbPage& verb) {
  std::string text;
  for (std::size_t i = 0; i < verb.positionals.size(); ++i) {
    const PositionalPage& each = verb.positionals[i];
    const std::string ids = i == 0 ? joined(verb.methods, " ", &MethodPage::id) : "";
    const std::string action = ids.empty() ? "_files" : fmt::format("({})", ids);
    text += fmt::format("        '{}:{}:{}'\n", each.several ? "*" : std::to_string(i + 1),
                        escaped(each.name), action);
  }
  return text;
}

std::string verb_branch(const VerbPage& verb) {
  std::string text = fmt::format("    {})\n      options=(\n", verb.name);
  text += "        '(-h --help)'{-h,--help}'[Print help]'\n";
  for (const OptionPage& option : verb.options) text += option_lines(option, "        ");
  text += positional_lines(verb) + "      )\n";
  if (!verb.methods.empty()) text += "      case $words[2] in\n";
  for (const MethodPage& method : verb.methods) {
    text += fmt::format("        {})\n          options+=(\n", method.id);
    for (const OptionPage& option : method.parameters) text += option_lines(option, "            ");
    text += "          )\n          ;;\n";
  }
  if (!verb.methods.empty()) text += "      esac\n";
  return text + "      ;;\n";
}

std::string zsh_completion(const std::vector<VerbPage>& verbs) {
  std::string text = "#compdef episcope-cli\n\nlocal -a verbs options\n";
  text += "if ((CURRENT == 2)); then\n  verbs=(\n";
  for (const VerbPage& verb : verbs) {
    text += fmt::format("    '{}:{}'\n", verb.name, escaped(verb.summary));
  }
  text +=
      "  )\n  _describe verb verbs\nelse\n  shift words\n  ((CURRENT--))\n  case $words[1] in\n";
  for (const VerbPage& verb : verbs) text += verb_branch(verb);
  return text + "  esac\n  _arguments -s $options\nfi\n";
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream file(path);
  if (!(file << text).flush()) throw std::runtime_error(path.string() + " cannot be written");
}

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  if (!(text << std::ifstream(path).rdbuf())) {
    throw std::runtime_error(path.string() + " cannot be read or is empty");
  }
  return text.str();
}

}  // namespace
}  // namespace episcope::cli

int main(int argc, char** argv) {
  using namespace episcope::cli;
  try {
    if (argc < 2 || argc > 3) throw std::runtime_error("usage: episcope_pages DIR [HELP]");
    const std::filesystem::path folder = argv[1];
    const std::vector<VerbPage> verbs = verb_pages();
    write(folder / "man/episcope-cli.1", program_man_page(verbs));
    for (const VerbPage& verb : verbs) {
      write(folder / ("man/episcope-cli-" + verb.name + ".1"), verb_man_page(verb));
    }
    if (argc == 3) write(folder / "man/episcope.1", window_man_page(text_of(argv[2])));
    write(folder / "bash/episcope-cli", bash_completion(verbs));
    write(folder / "zsh/_episcope-cli", zsh_completion(verbs));
    write(folder / "fish/episcope-cli.fish", fish_completion(verbs));
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "episcope_pages: " << error.what() << '\n';
    return 1;
  }
}
