// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"

namespace episcope {

/// Maps over the view, results laid against each other, statistics of what is in sight, the table
/// of metrics, and pictures of all that.
void add_comparing(const Workbench& bench);

}  // namespace episcope
