// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/render/shade.h"

#include <QString>

#include <utility>
#include <vector>

namespace episcope {

class ActionTable;
class MainWindow;

/// What is drawn over the view, and how results are laid against each other.
void add_compare_actions(ActionTable& table, MainWindow& window);

/// Ids of the commands that choose an overlay, with what they choose, in the order of the tool bar.
[[nodiscard]] const std::vector<std::pair<QString, render::Quantity>>& overlay_actions();

}  // namespace episcope
