// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"

#include <QString>

namespace episcope {

struct EstimateEntry;

/// Asks for a file and writes a result of the session, as below.
void ask_to_export(const Workbench& bench, const EstimateEntry& entry);

/// Writes a result in the background; the suffix of `path` says the form: .h5 all views, .pfm or
/// .tiff the map and .ply the point cloud of the current view. The user is told if it has another
/// suffix, or if there is no such map.
void export_result(const Workbench& bench, const EstimateEntry& entry, const QString& path);

}  // namespace episcope
