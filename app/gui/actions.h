// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/render/shade.h"

#include <QString>

#include <utility>
#include <vector>

namespace episcope {

class ActionTable;
class MainWindow;

/// Fills the table with every command of the window.
void add_actions(ActionTable& table, MainWindow& window);

/// Ids of the commands that choose an overlay, with what they choose, in the order of the tool bar.
[[nodiscard]] const std::vector<std::pair<QString, render::Quantity>>& overlay_actions();

}  // namespace episcope
