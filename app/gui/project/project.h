// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"

namespace episcope {

/// Adds the list of open light fields, projects, and what keeps work from being lost.
void add_project(const Workbench& bench);

}  // namespace episcope
