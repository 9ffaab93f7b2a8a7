// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"

namespace episcope {

/// The shown result as a point cloud.
void add_cloud(const Workbench& bench);

}  // namespace episcope
