// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/help_text.h"

#include "engine/core/text_table.h"

#include <sys/ioctl.h>
#include <unistd.h>
#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace episcope::cli {
namespace {

constexpr int kUsual = 80, kFewest = 40, kMost = 100;
constexpr std::size_t kContinued = 2;

int columns_of_terminal() {
  winsize size{};
  if (isatty(STDOUT_FILENO) == 1 && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0) {
    return size.ws_col;
  }
  const char* const stated = std::getenv("COLUMNS");
  return stated ? std::atoi(stated) : 0;
}

/// Words of one paragraph; the first line begins with `first` spaces, the others with `others`.
std::string paragraph(std::string_view text, std::size_t first, std::size_t others,
                      std::size_t columns) {
  std::istringstream words{std::string(text)};
  std::string lines(first, ' ');
  std::size_t used = first;
  bool begins = true;
  for (std::string word; words >> word;) {
    const std::size_t length = character_count(word);
    if (!begins && used + 1 + length > columns) {
      lines += '\n' + std::string(others, ' ');
      used = others;
      begins = true;
    }
    lines += (begins ? "" : " ") + word;
    used += length + (begins ? 0 : 1);
    begins = false;
  }
  return lines;
}

}  // namespace

int help_columns() {
  const int found = columns_of_terminal();
  return found > 0 ? std::clamp(found, kFewest, kMost) : kUsual;
}

std::string wrapped(std::string_view text, int columns) {
  const auto most = static_cast<std::size_t>(columns);
  std::string result;
  std::string open;  // the paragraph so far
  const auto close = [&] {
    if (!open.empty()) result += paragraph(open, 0, 0, most) + '\n';
    open.clear();
  };
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    const std::size_t indent = line.find_first_not_of(' ');
    if (indent == 0) {
      open += line + ' ';
      continue;
    }
    close();
    if (indent == std::string::npos) {
      result += '\n';
    } else {
      result += paragraph(line, indent, indent + kContinued, most) + '\n';
    }
  }
  close();
  if (!result.empty() && !text.ends_with('\n')) result.pop_back();
  return result;
}

std::string help_entry(const std::string& name, const std::string& text, int indent, int columns) {
  const std::string begin = "  " + name;
  const auto at = static_cast<std::size_t>(indent);
  const std::size_t used = character_count(begin);
  const std::string lines = paragraph(text, at, at, static_cast<std::size_t>(columns));
  if (text.empty()) return begin + '\n';
  if (used + 1 >= at) return begin + '\n' + lines + '\n';
  return begin + std::string(at - used, ' ') + lines.substr(at) + '\n';
}

}  // namespace episcope::cli
