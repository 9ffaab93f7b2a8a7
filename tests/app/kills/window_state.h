// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

namespace episcope {

class MainWindow;

namespace test {

/// What a user would miss, in words that can be compared: by what it is, as "edge/results". Lists
/// are entries that begin with '['.
using WindowState = std::map<std::string, std::string>;

/// Looks at an open window. Documents and maps can be looked at only while their scene is shown:
/// of others, what was seen last is kept.
class WindowWatcher {
 public:
  explicit WindowWatcher(MainWindow& window) : window_(window) {}

  /// Of all that is open.
  [[nodiscard]] WindowState look();
  /// The document that is shown as it was one and two steps before, and as it would be one step
  /// later, as far as there are such steps. Leaves everything as it was.
  [[nodiscard]] std::vector<std::string> strokes_around();

 private:
  MainWindow& window_;
  std::map<std::string, std::string> strokes_;  // by scene
  std::map<int, std::string> maps_;             // by result
};

/// Prints a line for each entry between "STATE" and "END", and flushes.
void tell(const WindowState& state);

}  // namespace test
}  // namespace episcope
