// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"

namespace episcope {

/// Running methods, and the list of what they found.
void add_estimating(const Workbench& bench);

}  // namespace episcope
