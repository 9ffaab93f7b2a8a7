// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/pages/verb_pages.h"

#include "app/cli/verbs/verbs.h"
#include "engine/core/text.h"
#include "engine/core/version.h"

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace episcope::cli {
namespace {

/// A text in which troff sees no request and no hyphen but typed ones; lines may break after "|".
[[nodiscard]] inline std::string troff(std::string_view text) {
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
[[nodiscard]] inline std::string bold(std::string_view text) {
  return "\\fB" + troff(text) + "\\fR";
}
[[nodiscard]] inline std::string italic(std::string_view text) {
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

/// Lines as they are typed.
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

/// Options below their headings.
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

}  // namespace

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

std::string window_man_page(const std::string& help) {
  return head("episcope", "views, EPIs, disparity and labels of 4D light fields") +
         section("SYNOPSIS") + bold("episcope") + " [" + italic("OPTION") + "]... [" +
         italic("INPUT") + "]\n" + section("DESCRIPTION") + typed_lines(help) +
         section("SEE ALSO") + ".BR episcope\\-cli (1)\n";
}

}  // namespace episcope::cli
