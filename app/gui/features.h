// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"

#include <span>

namespace episcope {

/// Every feature of the window, in the order in which they add widgets and commands.
[[nodiscard]] std::span<const Feature> features();

}  // namespace episcope
