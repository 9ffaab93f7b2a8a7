// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"

namespace episcope {

/// Adds the Measure tab, which waits until it is asked for.
void add_measuring(const Workbench& bench);

}  // namespace episcope
