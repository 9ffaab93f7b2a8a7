// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/pages/completions.h"
#include "engine/core/text/join.h"

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

}  // namespace episcope::cli
