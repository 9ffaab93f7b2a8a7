// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

class ActionTable;
class MainWindow;

/// Fills the table with every command of the window.
void add_actions(ActionTable& table, MainWindow& window);

}  // namespace episcope
