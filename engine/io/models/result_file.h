// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/core/parameter.h"
#include "engine/core/progress.h"
#include "engine/io/base/hdf5_file.h"

#include <filesystem>
#include <optional>
#include <string>

namespace episcope::io {

/// Writes a result file: group `/estimate` with `disparity`, `confidence`, `valid` and, of layered
/// methods, `disparity_foreground`, `disparity_background`, `layers`; provenance in attributes.
/// Atomic: a temporary file beside it, flushed, then renamed. `source` replaces the source of the
/// estimate if given. Confidence is kept as 32-bit float: later passes of some methods read it
/// again, so fewer bits would change results of block-wise runs. Throws IoError (nothing is left
/// behind), Cancelled.
void write_result(const std::filesystem::path& path, const Estimate& estimate,
                  const Progress& progress, const std::optional<std::string>& source = {});

/// Reads a result file, or a result from elsewhere: an HDF5 file with one 2-D or 4-D float dataset,
/// a PFM, a 32-bit float TIFF, or a folder of the 2016 submission form (`scene` picks the map).
/// A 2-D map belongs to the center view of `grid`. NaN and infinite values become invalid pixels.
/// Throws IoError with one sentence.
[[nodiscard]] Estimate read_result(const std::filesystem::path& path, GridShape grid,
                                   const std::string& scene = "");

/// Tells how the light field of a result was read. Unknown for results of other programs and of
/// former versions. Throws IoError if it is an HDF5 file and damaged.
[[nodiscard]] Reading read_reading(const std::filesystem::path& path);

/// Whether the file is one that `write_result` wrote (an HDF5 file with the group `/estimate`).
/// Throws IoError if it is an HDF5 file and damaged.
[[nodiscard]] bool is_result_file(const std::filesystem::path& path);

/// Group of a result file that holds the maps; its attributes tell their provenance.
inline constexpr const char* kResultGroup = "estimate";
/// Unit of disparities in result files.
inline constexpr const char* kDisparityUnit = "px per view step";

/// "estimate/<name>".
[[nodiscard]] std::string in_group(const char* name);

/// Writes the provenance of maps of this geometry; `source` replaces the source of the estimate.
/// Throws IoError.
void write_provenance(Hdf5Output& file, const Provenance& estimate, const MapGeometry& maps,
                      const std::string& source);

/// Stores how a light field was read as attributes of a group or of the root; nothing if that is
/// not known.
void write_reading(Hdf5Output& file, const std::string& group, const Reading& reading);

/// Reads what `write_reading` stored; unknown in files of other programs and of former versions.
[[nodiscard]] Reading reading_in(const Hdf5Input& file, const std::string& group);

}  // namespace episcope::io
