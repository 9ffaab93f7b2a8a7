// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/models/order/order_check.h"

#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Data that a reader has gathered, in the order of views as stored.
struct SceneParts {
  LightField::Samples samples;
  GroundTruth truth;
  LightFieldInfo info;
  ExpectedOrder expected;
  /// 0 = a pixel without content, in the order of views as stored; empty = all are valid.
  ViewStack<std::uint8_t> valid{};
  std::vector<FileUse> files{};  ///< What became of the files of the folder (FileUsage).
  /// Set if the reader has compared rows and columns: the reason why it swapped them, or an empty
  /// text.
  std::optional<std::string> swapped_axes{};
};

/// Finishes reading: brings the parts into canonical order, sets samples that are not finite to 0,
/// and stores light field and, if needed, truth in `scene`. Continues the report of `scene`. Stores
/// the given options in the light field's `reading`. Throws Cancelled.
void assemble(SceneParts parts, const OpenOptions& options, Scene& scene, const Progress& progress);

/// Whether the options state which axis of views is rows and which is columns.
[[nodiscard]] bool are_axes_stated(const OpenOptions& options);

}  // namespace episcope::io
