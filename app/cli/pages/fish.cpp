// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/pages/completions.h"
#include "engine/core/text/join.h"

#include <fmt/format.h>

namespace episcope::cli {
namespace {

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') result += '\\';
    result += c;
  }
  return result + "'";
}

std::string option_line(const OptionPage& option, const std::string& condition) {
  std::string line = "complete -c episcope-cli -n " + quoted(condition);
  for (const std::string& name : option.names) {
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (!option.choices.empty()) {
    line += " -x -a " + quoted(joined(option.choices, " "));
  } else if (!option.value.empty()) {
    line += " -r";
  }
  return line + " -d " + quoted(option.help) + "\n";
}

}  // namespace

std::string fish_completion(const std::vector<VerbPage>& verbs) {
  std::string text = "# fish completion for episcope-cli\n";
  text +=
      "complete -c episcope-cli -n __fish_use_subcommand -f -l version -d 'Print the version'\n";
  text += "complete -c episcope-cli -f -l help -s h -d 'Print help'\n";
  for (const VerbPage& verb : verbs) {
    const std::string is_verb = "__fish_seen_subcommand_from " + verb.name;
    text += fmt::format("complete -c episcope-cli -n __fish_use_subcommand -f -a {} -d {}\n",
                        verb.name, quoted(verb.summary));
    for (const OptionPage& option : verb.options) text += option_line(option, is_verb);
    for (const MethodPage& method : verb.methods) {
      text += fmt::format("complete -c episcope-cli -n {} -f -a {} -d {}\n",
                          quoted(is_verb + "; and not __fish_seen_subcommand_from " +
                                 joined(verb.methods, " ", &MethodPage::id)),
                          method.id, quoted(method.summary));
      const std::string is_method = is_verb + "; and __fish_seen_subcommand_from " + method.id;
      for (const OptionPage& option : method.parameters) text += option_line(option, is_method);
    }
  }
  return text;
}

}  // namespace episcope::cli
