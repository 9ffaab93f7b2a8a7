// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"

#include <QString>

namespace episcope {

struct EstimateEntry;

/// Asks for a file, then calls `export_result`.
void ask_to_export(const Workbench& bench, const EstimateEntry& entry);

/// Writes a result in the background, in the form named by the suffix: .h5 all views; .pfm or .tiff
/// the map and .ply the point cloud of the current view. Tells the user of an unknown suffix or a
/// missing map, and asks if another program has changed the file.
void export_result(const Workbench& bench, const EstimateEntry& entry, const QString& path);

/// Asks for a folder and adds center view and run time of the shown scene to the submission there.
void ask_to_submit(const Workbench& bench, const EstimateEntry& entry);

/// Writes disp_maps/<scene>.pfm and runtimes/<scene>.txt of a submission to the 2016 benchmark, in
/// the background. Tells the user if the result has no center view.
void submit_result(const Workbench& bench, const EstimateEntry& entry, const QString& folder);

}  // namespace episcope
