// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"

namespace episcope {

class SegmentController;
class SegmentPanel;

/// Adds what segments, smooths, shows and exports labels to the menus and to the panel.
void add_segment_commands(const Workbench& bench, SegmentController& segments, SegmentPanel& panel);

}  // namespace episcope
