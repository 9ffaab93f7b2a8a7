// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/models/order/order_check.h"

#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// What a reader has gathered, in the order of views as stored.
struct SceneParts {
  LightField::Samples samples;
  GroundTruth truth;
  LightFieldInfo info;
  ExpectedOrder expected;
  /// 0 = a pixel that holds nothing that was seen, in the order of views as stored; empty = none.
  ViewStack<std::uint8_t> valid{};
  std::vector<FileUse> files{};  ///< What became of the files of the folder (FolderAccount).
  /// If rows and columns of views were compared already: why they were swapped, or nothing.
  std::optional<std::string> swapped_axes{};
};

/// The last step of reading a light field: brings the parts into canonical order, sets samples that
/// are not finite to 0, and puts light field and truth, if needed, into `scene`, whose report is
/// continued. Options that were set go to the light field's `reading`. Throws Cancelled.
void assemble(SceneParts parts, const OpenOptions& options, Scene& scene, const Progress& progress);

/// Whether options say which of the axes of views are rows and which columns.
[[nodiscard]] bool are_axes_stated(const OpenOptions& options);

}  // namespace episcope::io
