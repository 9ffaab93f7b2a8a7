// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/io/models/array_file.h"
#include "engine/io/models/assemble_scene.h"
#include "engine/io/models/open_options.h"
#include "engine/io/models/reader.h"

#include <filesystem>
#include <optional>
#include <string>

namespace episcope::io {

/// Arranges views and maps that were read as a list, 1×N, on their grid. Options state it, row by
/// row; else the views tell it, else the file (`stored`). Continues `reason`. Throws Undecided if
/// nothing tells the grid, InvalidInput if it has another number of places, Cancelled.
void arrange_list(const std::filesystem::path& path, const OpenOptions& options, SceneParts& parts,
                  std::string& reason, const Progress& progress,
                  std::optional<GridShape> stored = std::nullopt);

/// The light field of arrays in memory, read as `numpy_reader` reads `.npy`.
/// Throws IoError, InvalidInput for options that do not fit, Cancelled.
[[nodiscard]] Scene read_arrays(const ArrayFile& file, const OpenOptions& options,
                                const Progress& progress);

/// HDF5 files with a light field in another form than the archive's: a dataset of five axes with
/// any name and order, or groups with a dataset for each channel.
[[nodiscard]] Reader hdf5_array_reader();

/// MATLAB files that hold a light field LF(t, s, v, u, c), as LFToolbox writes: version 7.3, which
/// is HDF5, and 5 to 7.
[[nodiscard]] Reader matlab_reader();

/// `.npy` and `.npz` files that hold a light field of any order of axes.
[[nodiscard]] Reader numpy_reader();

}  // namespace episcope::io
