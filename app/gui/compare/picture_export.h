// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"

#include <QString>

namespace episcope {

/// Adds the commands that write pictures of what is shown.
void add_picture_export(const Workbench& bench);

/// Writes the view with its overlay as it is shown, one image pixel a pixel, in the background.
void save_picture(const Workbench& bench, const QString& path);

/// Writes the map that is drawn over the view, by itself, as `episcope-cli show` does.
void save_map_picture(const Workbench& bench, const QString& path);

}  // namespace episcope
