// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>

namespace episcope {

class Commands;

/// Colours the application: "light", "dark", or "system" for those of the desktop. False for any
/// other name, and nothing changes.
bool apply_theme(const QString& name);

/// What was chosen in the menu last; "system" at first.
[[nodiscard]] QString remembered_theme();

/// Commands that choose the colours, and remember them.
void add_theme_commands(Commands& commands);

}  // namespace episcope
