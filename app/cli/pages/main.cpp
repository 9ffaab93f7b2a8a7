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
#include <utility>
#include <vector>

namespace episcope::cli {
namespace {

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

/// Every verb, in the order of the help, as its `--help-json` describes it ("options",
/// "positionals", …). `estimate` has "methods", whose options are what it declares beyond its own.
std::vector<json> verb_pages() {
  std::vector<json> pages;
  for (const Verb& verb : verbs()) {
    json& page = pages.emplace_back(answer_of(verb, {}));
    page["name"] = verb.name;
    page["description"] = std::exchange(page["summary"], verb.summary);
    page["methods"] = json::array();
    if (verb.run != run_estimate) continue;
    const auto common = static_cast<json::difference_type>(page["options"].size());
    for (const Estimator& estimator : registered_estimators()) {
      const EstimatorInfo& info = estimator.info;
      json options = answer_of(verb, {info.id})["options"];
      options.erase(options.begin(), options.begin() + common);
      page["methods"].push_back(
          {{"name", info.id},
           {"summary", info.summary},
           {"about", info.name + ": " + info.summary + ". " + info.reference + "."},
           {"options", std::move(options)}});
    }
  }
  return pages;
}

/// The text of a member.
std::string text(const json& object, const char* key) {
  return object.at(key).get<std::string>();
}

/// The texts of a list, with `separator` between them.
std::string words(const json& list, std::string_view separator) {
  return joined(list, separator, [](const json& each) { return each.get<std::string>(); });
}

/// The names of verbs or methods.
std::string names(const json& list) {
  return joined(list, " ", [](const json& each) { return text(each, "name"); });
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

std::string option_entry(const json& option) {
  const std::string value = text(option, "value");
  const std::string names = joined(option.at("names"), ", ",
                                   [](const json& name) { return bold(name.get<std::string>()); });
  return entry(value.empty() ? names : names + " " + italic(value), text(option, "help"));
}

std::string option_entries(const json& options, std::string heading) {
  std::string entries;
  for (const json& option : options) {
    if (text(option, "heading") != heading) {
      heading = text(option, "heading");
      entries += ".SS \"" + troff(heading) + "\"\n";
    }
    entries += option_entry(option);
  }
  return entries;
}

std::string method_entries(const json& methods) {
  std::string entries = methods.empty() ? std::string() : section("METHODS");
  for (const json& method : methods) {
    entries += ".SS \"" + troff(text(method, "name")) + "\"\n" + troff(text(method, "about")) +
               "\n" + joined(method.at("options"), "", option_entry);
  }
  return entries;
}

std::string exit_status() {
  return section("EXIT STATUS") + entry(bold(fmt::format("{}", kSuccess)), "Done.") +
         entry(bold(fmt::format("{}", kFailed)), "Failed; a sentence on standard error says why.") +
         entry(bold(fmt::format("{}", kWrongUsage)), "The command line is wrong.") +
         entry(bold(fmt::format("{}", kCancelled)), "Cancelled; nothing half-written is left.");
}

std::string verb_man_page(const json& verb) {
  const std::string name = "episcope-cli-" + text(verb, "name");
  std::string synopsis, inputs;
  for (const json& each : verb.at("positionals")) {
    const std::string positional = italic(text(each, "name"));
    synopsis += " " + positional + (each.at("several") ? "..." : "");
    inputs += entry(positional, text(each, "help"));
  }
  return head(name, text(verb, "summary")) + section("SYNOPSIS") +
         bold("episcope-cli " + text(verb, "name")) + " [" + italic("OPTION") + "]..." + synopsis +
         "\n" + section("DESCRIPTION") + typed_lines(text(verb, "description")) + inputs +
         section("OPTIONS") + entry(bold("-h") + ", " + bold("--help"), "Print help and exit") +
         option_entries(verb.at("options"), "Options") + method_entries(verb.at("methods")) +
         exit_status() + section("EXAMPLES") + typed_lines("  " + text(verb, "example")) +
         section("SEE ALSO") + ".BR episcope\\-cli (1)\n";
}

std::string program_man_page(const std::vector<json>& verbs) {
  std::string page = head("episcope-cli", "disparity and labels of 4D light fields") +
                     section("SYNOPSIS") + bold("episcope-cli") + " " + italic("VERB") + " ...\n" +
                     section("DESCRIPTION") + troff(kProgramSummary) + "\n.PP\n" +
                     troff(kInputHelp) + section("VERBS");
  for (const json& verb : verbs) {
    const std::string name = text(verb, "name");
    page += entry(bold(name), text(verb, "summary") + "; see episcope-cli-" + name + "(1).");
  }
  page += section("OPTIONS") +
          entry(bold("-h") + ", " + bold("--help"), "Print help, or after a verb its help.") +
          entry(bold("--version"), "Print version, commit and libraries.");
  page += exit_status() + section("EXAMPLES") + typed_lines(kProgramExample);
  return page + section("SEE ALSO") + ".BR episcope (1)\n";
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

std::string option_names(const json& options) {
  return joined(options, " ", [](const json& each) { return words(each.at("names"), " "); });
}

/// Branches that complete the value of an option: its words, or a file where it has none.
std::string value_branches(const json& options, const std::string& indent) {
  std::string branches = indent + "case $prev in\n";
  for (const json& each : options) {
    if (text(each, "value").empty()) continue;
    const std::string choices = words(each.at("choices"), " ");
    branches +=
        fmt::format("{}  {}) {} ;;\n", indent, words(each.at("names"), "|"),
                    choices.empty() ? "return" : fmt::format("words=\"{}\" options=\"\"", choices));
  }
  return branches + indent + "esac\n";
}

std::string method_branches(const json& methods) {
  if (methods.empty()) return {};
  std::string branches = fmt::format("      ((COMP_CWORD == 2)) && words=\"{}\"\n", names(methods));
  branches += "      case $method in\n";
  for (const json& method : methods) {
    branches += fmt::format("        {})\n          options+=\" {}\"\n{}          ;;\n",
                            text(method, "name"), option_names(method.at("options")),
                            value_branches(method.at("options"), "          "));
  }
  return branches + "      esac\n";
}

/// Completion of verbs, options, methods with their parameters, and the words that options take;
/// where none of these is asked for, of files.
std::string bash_completion(const std::vector<json>& verbs) {
  std::string script = kHead;
  script += fmt::format(
      "  if ((COMP_CWORD == 1)); then\n    COMPREPLY=($(compgen -W \"{} --help --version\" -- "
      "\"$cur\"))\n    return\n  fi\n  case $verb in\n",
      names(verbs));
  for (const json& verb : verbs) {
    script +=
        fmt::format("    {})\n      options=\"--help {}\"\n{}{}      ;;\n", text(verb, "name"),
                    option_names(verb.at("options")), method_branches(verb.at("methods")),
                    value_branches(verb.at("options"), "      "));
  }
  return script + "  esac" + kTail;
}

std::string fish_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') result += '\\';
    result += c;
  }
  return result + "'";
}

std::string option_line(const json& option, const std::string& condition) {
  std::string line = "complete -c episcope-cli -n " + fish_quoted(condition);
  for (const std::string name : option.at("names")) {
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (!option.at("choices").empty()) {
    line += " -x -a " + fish_quoted(words(option.at("choices"), " "));
  } else if (!text(option, "value").empty()) {
    line += " -r";
  }
  return line + " -d " + fish_quoted(text(option, "help")) + "\n";
}

/// Lines for a verb, or for a method of one, and for its options.
std::string word_lines(const json& word, const std::string& condition, const std::string& chosen) {
  const std::string name = text(word, "name");
  std::string lines = fmt::format("complete -c episcope-cli -n {} -f -a {} -d {}\n",
                                  fish_quoted(condition), name, fish_quoted(text(word, "summary")));
  for (const json& option : word.at("options")) lines += option_line(option, chosen + name);
  return lines;
}

std::string fish_completion(const std::vector<json>& verbs) {
  std::string script =
      "# fish completion for episcope-cli\n"
      "complete -c episcope-cli -n __fish_use_subcommand -f -l version -d 'Print the version'\n"
      "complete -c episcope-cli -f -l help -s h -d 'Print help'\n";
  const std::string seen = "__fish_seen_subcommand_from ";
  for (const json& verb : verbs) {
    script += word_lines(verb, "__fish_use_subcommand", seen);
    const std::string is_verb = seen + text(verb, "name");
    const json& methods = verb.at("methods");
    for (const json& method : methods) {
      script += word_lines(method, is_verb + "; and not " + seen + names(methods),
                           is_verb + "; and " + seen);
    }
  }
  return script;
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

/// One line of `_arguments` for each name of an option.
std::string option_lines(const json& options, const std::string& indent) {
  std::string lines;
  for (const json& option : options) {
    const std::string value = text(option, "value"), choices = words(option.at("choices"), " ");
    const std::string action = choices.empty() ? "_files" : "(" + choices + ")";
    for (const std::string name : option.at("names")) {
      lines += fmt::format("{}'({}){}[{}]{}'\n", indent, words(option.at("names"), " "), name,
                           escaped(text(option, "help")),
                           value.empty() ? "" : fmt::format(":{}:{}", escaped(value), action));
    }
  }
  return lines;
}

std::string verb_branch(const json& verb) {
  const json& methods = verb.at("methods");
  std::string branch =
      fmt::format("    {})\n      options=(\n        '(-h --help)'{{-h,--help}}'[Print help]'\n{}",
                  text(verb, "name"), option_lines(verb.at("options"), "        "));
  int number = 0;
  for (const json& each : verb.at("positionals")) {
    const bool is_method = ++number == 1 && !methods.empty();
    branch += fmt::format("        '{}:{}:{}'\n", each.at("several") ? "*" : std::to_string(number),
                          escaped(text(each, "name")),
                          is_method ? fmt::format("({})", names(methods)) : "_files");
  }
  branch += methods.empty() ? "      )\n" : "      )\n      case $words[2] in\n";
  for (const json& method : methods) {
    branch += fmt::format("        {})\n          options+=(\n{}          )\n          ;;\n",
                          text(method, "name"), option_lines(method.at("options"), "            "));
  }
  return branch + (methods.empty() ? "      ;;\n" : "      esac\n      ;;\n");
}

std::string zsh_completion(const std::vector<json>& verbs) {
  std::string script =
      "#compdef episcope-cli\n\nlocal -a verbs options\nif ((CURRENT == 2)); then\n  verbs=(\n";
  for (const json& verb : verbs) {
    script += fmt::format("    '{}:{}'\n", text(verb, "name"), escaped(text(verb, "summary")));
  }
  script +=
      "  )\n  _describe verb verbs\nelse\n  shift words\n  ((CURRENT--))\n  case $words[1] in\n";
  return script + joined(verbs, "", verb_branch) + "  esac\n  _arguments -s $options\nfi\n";
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
    const std::vector<nlohmann::json> verbs = verb_pages();
    write(folder / "man/episcope-cli.1", program_man_page(verbs));
    for (const nlohmann::json& verb : verbs) {
      write(folder / ("man/episcope-cli-" + text(verb, "name") + ".1"), verb_man_page(verb));
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
