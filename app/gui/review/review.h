// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"

namespace episcope {

/// Adds the Check tab and what goes from one place to check to the next.
void add_reviewing(const Workbench& bench);

}  // namespace episcope
