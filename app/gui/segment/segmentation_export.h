// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"

#include <QString>

namespace episcope {

class SegmentController;

/// Asks where to write the segmentation of the current view or of all, as below.
void ask_to_export_segmentation(const Workbench& bench, const SegmentController& segment);

/// Writes labels and probabilities (.h5), or the labels of this view in their colours (.png), in
/// the background. The user is told if the path has another suffix.
void export_segmentation(const Workbench& bench, const SegmentController& segment,
                         const QString& path);

/// Asks for a folder and writes masks of every label there: of all views once they are segmented,
/// else of this one.
void ask_to_export_masks(const Workbench& bench, const SegmentController& segment);
void export_masks(const Workbench& bench, const SegmentController& segment, const QString& folder);

}  // namespace episcope
