// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/view_stack.h"

#include <cstdint>
#include <filesystem>

namespace episcope::io {

/// Whether a file holds arrays with names: `.npz`, `.mat`.
[[nodiscard]] bool is_archive_of_maps(const std::filesystem::path& path);

/// Disparity or depth from such a file: the array whose name says so, else one that is named like
/// labels, or the only one with the axes of a map. Of one view, at view (0, 0), or of all views of
/// `grid`, `[v][u][y][x]`. Throws IoError that says what the file holds.
[[nodiscard]] ViewStack<float> read_archived_values(const std::filesystem::path& path,
                                                    GridShape grid);
/// Whether its labels are floats with fractions, and so values. Throws IoError likewise.
[[nodiscard]] bool holds_archived_fractions(const std::filesystem::path& path, GridShape grid);
/// Likewise, labels.
[[nodiscard]] ViewStack<std::int32_t> read_archived_labels(const std::filesystem::path& path,
                                                           GridShape grid);

}  // namespace episcope::io
