// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"

namespace episcope {

/// Painting labels on views: tools, labels, scribbles on all views, their files, and recovery after
/// a crash.
void add_annotating(const Workbench& bench);

}  // namespace episcope
