// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"

#include <QString>

#include <functional>

class QWidget;

namespace episcope {

/// Folder of the manual's pages: share/episcope/manual of the installation or build that the
/// program runs from, else of the system. Empty if there is none.
[[nodiscard]] QString manual_folder();

/// Shows the contents of the manual in a window beside `window`. The pages are Markdown; one can
/// follow links, go back, and search. Does not block.
[[nodiscard]] std::function<void()> make_manual(QWidget& window);

/// The commands of the menu Help: the manual, keys, the palette of commands, and facts.
void add_help(const Workbench& bench);

}  // namespace episcope
