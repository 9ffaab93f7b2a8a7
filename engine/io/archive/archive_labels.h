// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "engine/io/archive/archive_maps.h"

namespace episcope::io {

/// Labels and scribbles of an archive scene, in the stored order of views.
struct ArchiveLabels {
  ViewStack<std::int32_t> labels;
  Scribbles scribbles;
};

/// Reads GT_LABELS and SCRIBBLES if present. Unpainted pixels (0, −1 or 255 in files)
/// become 0. Where 0 is a label and −1 or 255 means "none", labels and scribbles are raised by one,
/// which `report` tells. Throws IoError, Cancelled.
[[nodiscard]] ArchiveLabels read_archive_labels(const Hdf5Input& file, const FieldShape& shape,
                                                ConventionReport& report, const Progress& progress);

}  // namespace episcope::io
