// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"

namespace episcope {

/// Maps over the view, results compared with each other, statistics of the visible part, the table
/// of metrics, and pictures of all that.
void add_comparing(const Workbench& bench);

}  // namespace episcope
