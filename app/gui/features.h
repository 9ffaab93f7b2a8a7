// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"

#include <span>

namespace episcope {

/// Row of the table of features. A feature adds its widgets, tabs, commands and controllers to the
/// window. Features share only the workbench.
struct Feature {
  const char* id;
  void (*add)(const Workbench&);
};

/// Every feature of the window, in the order in which they add widgets and commands.
[[nodiscard]] std::span<const Feature> features();

}  // namespace episcope
