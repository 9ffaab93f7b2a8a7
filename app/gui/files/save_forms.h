// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"
#include "engine/io/write/writer.h"

#include <QString>

class QMenu;

namespace episcope {

/// The menu from which the open light field is saved: an entry for each form (`io::writers`).
[[nodiscard]] QMenu* make_save_menu(const Workbench& bench);

/// Asks for a file or a new folder and writes the open light field, as below.
void ask_to_save_light_field(const Workbench& bench, const io::Writer& writer);

/// Writes the open light field with its truth, labels and what is painted, in the background. What
/// the form cannot hold is told. Nothing is written over the light field that is open.
void save_light_field(const Workbench& bench, const io::Writer& writer, const QString& path);

}  // namespace episcope
