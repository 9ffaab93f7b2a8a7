// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "engine/io/archive/archive_layout.h"
#include "engine/io/order/order_check.h"

#include <memory>
#include <string>
#include <vector>

namespace episcope::io {

/// What has been read of an archive file, in the stored order of views.
struct ArchiveParts {
  const LightField::Samples& samples;
  GroundTruth& truth;
  ViewStack<std::uint8_t>& valid;
  CameraGrid& camera;
  ExpectedOrder& expected;
  ConventionReport& report;
};

/// Reads what lies beside LF under other names than the archive's: disparity, labels and masks as
/// `read_array_maps` knows them, and depth that no camera turns into disparity; what `parts` has
/// already stays. Returns what became of these
/// datasets. Throws IoError, Cancelled.
[[nodiscard]] std::vector<FileUse> read_other_maps(const std::shared_ptr<const Hdf5Input>& file,
                                                   const ArchiveLayout& layout, bool wants_labels,
                                                   ArchiveParts parts, const Progress& progress);

/// The name of the only dataset that holds depth of all views or of one by its name and shape, but
/// is not the archive's; empty if there is none.
[[nodiscard]] std::string other_depth(const Hdf5Input& file, const FieldShape& shape);

}  // namespace episcope::io
