// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

class ActionTable;
class MainWindow;

/// Commands that walk through the views, zoom, and move the focus plane.
void add_browse_actions(ActionTable& table, MainWindow& window);

}  // namespace episcope
