// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"

namespace episcope {

/// Segmenting from what is painted, live or all views, and what is shown of that.
void add_segmenting(const Workbench& bench);

}  // namespace episcope
