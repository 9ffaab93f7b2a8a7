// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/verbs/program_help.h"

#include "app/cli/verbs/verbs.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace episcope::cli {

std::string program_help() {
  std::string text =
      fmt::format("{}\nUsage: episcope-cli VERB ...\n\n{}\nVerbs:\n", kProgramSummary, kInputHelp);
  std::size_t longest = 0;
  for (const Verb& verb : verbs()) longest = std::max(longest, std::string_view(verb.name).size());
  for (const Verb& verb : verbs()) {
    text += fmt::format("  {:<{}}  {}\n", verb.name, longest, verb.summary);
  }
  text +=
      "\nOptions:\n  -h,--help   Print this help, or after a verb its help, and exit\n"
      "  --version   Print version, commit and libraries, and exit\n\nExample:\n";
  return text + kProgramExample;
}

}  // namespace episcope::cli
