// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"

#include <QString>

namespace episcope {

/// Adds the commands that write pictures.
void add_picture_export(const Workbench& bench);

/// Writes the view with its overlay at image resolution, in the background.
void save_picture(const Workbench& bench, const QString& path);

/// Writes the map of the overlay alone, as `episcope-cli show` does.
void save_map_picture(const Workbench& bench, const QString& path);

}  // namespace episcope
