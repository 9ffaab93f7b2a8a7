// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"

namespace episcope {

/// Browsing views and EPIs, the focus plane, the values of a pixel, and the facts about the light
/// field.
void add_browsing(const Workbench& bench);

}  // namespace episcope
