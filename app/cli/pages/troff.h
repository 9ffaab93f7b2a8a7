// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace episcope::cli {

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

}  // namespace episcope::cli
