// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"

namespace episcope {

/// The light fields of a folder, and the frames of a sequence.
void add_collection(const Workbench& bench);

}  // namespace episcope
