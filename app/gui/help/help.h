// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"

namespace episcope {

/// The list of keys, the palette of commands, colours, and what the program is.
void add_help(const Workbench& bench);

}  // namespace episcope
