// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/render/shade.h"

#include <QString>

#include <utility>
#include <vector>

namespace episcope {

class ActionTable;
class MainWindow;

/// Segmenting from scribbles, and what is shown of that.
void add_segment_actions(ActionTable& table, MainWindow& window);

/// Ids of the commands that draw something of the segmentation over the view, with what they draw.
[[nodiscard]] const std::vector<std::pair<QString, render::Quantity>>& segment_overlay_actions();

/// Puts the buttons of these commands into the Annotate tab, and keeps them enabled and checked as
/// the segmentation is.
void follow_segmentation(ActionTable& table, MainWindow& window);

}  // namespace episcope
