// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/io/models/open_options.h"

#include <filesystem>
#include <string>

namespace episcope::io {

/// Opens any light field, with the first reader (`readers`) that recognizes it. Converts it to the
/// canonical convention, finds truth, labels and companions beside it, and reports what was found
/// and how it was checked. Throws IoError with one sentence (what, where, what to do). Throws
/// Cancelled.
[[nodiscard]] Scene open_scene(const std::filesystem::path& path, const OpenOptions& options,
                               const Progress& progress);

/// Whether opening `input` takes a map in a file of this name for its ground truth. The file need
/// not exist.
[[nodiscard]] bool reads_as_truth(const std::filesystem::path& map,
                                  const std::filesystem::path& input);

/// Whether a file is a view or the ground truth of the light field in its folder. False for a
/// damaged one.
[[nodiscard]] bool is_part_of_light_field(const std::filesystem::path& file);

}  // namespace episcope::io
