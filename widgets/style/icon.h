// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QIcon>
#include <QString>

namespace episcope {

/// An icon of resources/icons by name ("open", "play", …), drawn in the text colour of the palette
/// at hand, so that it follows light and dark themes. An unknown name gives a null icon.
[[nodiscard]] QIcon themed_icon(const QString& name);

/// The program's own icon, for its windows.
[[nodiscard]] QIcon program_icon();

}  // namespace episcope
