// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"

namespace episcope {

/// Opening light fields and results by dialog, by drop, from the list of recent ones; closing.
void add_files(const Workbench& bench);

}  // namespace episcope
