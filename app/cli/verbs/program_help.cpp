// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/verbs/program_help.h"

#include "app/cli/verbs/verbs.h"

#include <fmt/format.h>

namespace episcope::cli {

std::string program_help() {
  std::string text =
      fmt::format("{}\nUsage: episcope-cli VERB ...\n\n{}\nVerbs:\n", kProgramSummary, kInputHelp);
  for (const Verb& verb : verbs()) {
    text += fmt::format("  {:<12}{}\n", verb.name, verb.summary);
  }
  text +=
      "\nOptions:\n  -h,--help   Print this help, or after a verb its help, and exit\n"
      "  --version   Print version, commit and libraries, and exit\n\nExample:\n";
  return text + kProgramExample;
}

}  // namespace episcope::cli
