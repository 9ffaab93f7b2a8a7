// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"

#include <QString>

namespace episcope {

struct EstimateEntry;

/// Asks for a file and writes a result of the session, as below.
void ask_to_export(const Workbench& bench, const EstimateEntry& entry);

/// Writes a result in the background; the suffix of `path` says the form: .h5 all views, .pfm or
/// .tiff the map and .ply the point cloud of the current view. The user is told if it has another
/// suffix, or if there is no such map, and asked if another program has changed the file since a
/// result was read from it or written to it.
void export_result(const Workbench& bench, const EstimateEntry& entry, const QString& path);

/// Asks for a folder and adds the shown scene's centre view and time to the submission there.
void ask_to_submit(const Workbench& bench, const EstimateEntry& entry);

/// Writes disp_maps/<scene>.pfm and runtimes/<scene>.txt of a submission to the 2016 benchmark in
/// the background. The user is told if the result has no centre view.
void submit_result(const Workbench& bench, const EstimateEntry& entry, const QString& folder);

}  // namespace episcope
