// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/pages/completions.h"
#include "engine/core/text/join.h"

#include <fmt/format.h>

namespace episcope::cli {
namespace {

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

}  // namespace

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

}  // namespace episcope::cli
