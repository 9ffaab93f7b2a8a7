// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"

namespace episcope {

/// Adds the Capture tab and its commands.
void add_capture(const Workbench& bench);

}  // namespace episcope
