// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/io/models/array_file.h"
#include "engine/io/models/assemble_scene.h"
#include "engine/io/models/open_options.h"
#include "engine/io/models/reader.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>

namespace episcope::io {

/// Keys of the reading options that every reader of arrays knows.
[[nodiscard]] std::span<const char* const> array_options();

/// What the shape of the light field of a file of arrays tells. Throws NoLightField if none of them
/// can be one; IoError, Undecided.
[[nodiscard]] SceneProbe probe_arrays(const ArrayFile& file, const OpenOptions& options);

/// What a file holds beside arrays that `read_array_maps` knows.
struct OtherArrays {
  std::function<bool(const ArrayEntry&)> owns;  ///< Arrays that it alone reads.
  /// Adds them to the parts, which hold samples and maps in the order of the file.
  std::function<void(SceneParts&, ConventionReport&, const Progress&)> add;
};

/// Reads the light field of a file of arrays, and the maps beside it; then, if given, what else
/// there is. A picture of the centre view is given first. Throws IoError, InvalidInput for options
/// that do not fit, Cancelled.
[[nodiscard]] Scene read_array_scene(const ArrayFile& file, const char* reader,
                                     const OpenOptions& options, const Progress& progress,
                                     const OtherArrays& more = {});

/// Puts views (and maps of all views) that were read as a list, 1×N, onto their grid: the one that
/// the options state, row by row, else the one that the views themselves speak for. `reason` is
/// continued. `stored` is the grid of which the file itself speaks, for views that do not tell
/// otherwise. Throws Undecided where neither tells;
/// InvalidInput if the grid does not have as many places; Cancelled.
void arrange_list(const std::filesystem::path& path, const OpenOptions& options, SceneParts& parts,
                  std::string& reason, const Progress& progress,
                  std::optional<GridShape> stored = std::nullopt);

/// HDF5 files of any other form than the archive's that hold a light field: a dataset of five axes
/// of any name and order, or groups of a dataset for each channel.
[[nodiscard]] Reader hdf5_array_reader();

/// MATLAB files that hold a light field LF(t, s, v, u, c), as LFToolbox writes: version 7.3, which
/// is HDF5, and 5 to 7.
[[nodiscard]] Reader matlab_reader();

/// `.npy` and `.npz` files that hold a light field of any order of axes.
[[nodiscard]] Reader numpy_reader();

}  // namespace episcope::io
