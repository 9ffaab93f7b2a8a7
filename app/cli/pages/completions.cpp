// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/pages/verb_pages.h"

#include "engine/core/text.h"

#include <fmt/format.h>

namespace episcope::cli {
namespace {

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

}  // namespace

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

namespace {

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

}  // namespace

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
