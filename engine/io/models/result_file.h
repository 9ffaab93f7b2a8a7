// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/core/parameter.h"
#include "engine/core/progress.h"
#include "engine/io/base/hdf5_output.h"

#include <filesystem>
#include <optional>
#include <string>

namespace episcope::io {

/// What there is to choose for a result file.
struct ResultForm {
  std::optional<std::string> source{};  ///< Replaces the source of the estimate.
  /// Of disparity and confidence. Masks and `layers` are always deflated, which takes no time.
  Hdf5Storage floats = Hdf5Storage::Plain;
};

/// Writes a result file: group `/estimate` with `disparity`, `confidence`, `valid` and, of layered
/// methods, `disparity_foreground`, `disparity_background`, `layers`; `disparity_second`, NaN where
/// there is none, of methods that find some; their axes as dimension scales; provenance, camera and
/// conventions in attributes.
/// Atomic: a temporary file beside it, flushed, then renamed. Confidence is kept as 32-bit float:
/// later passes of some methods read it again, so fewer bits would change results of block-wise
/// runs. Throws IoError (nothing is left behind), Cancelled.
void write_result(const std::filesystem::path& path, const Estimate& estimate,
                  const Progress& progress, const ResultForm& form = {});

/// Reads a result file, or a result from elsewhere: an HDF5 file with one 2-D or 4-D float dataset,
/// a PFM, a 32-bit float TIFF, or a folder of the 2016 submission form (`scene` picks the map).
/// A 2-D map belongs to the center view of `grid`. NaN and infinite values become invalid pixels.
/// Throws IoError with one sentence.
[[nodiscard]] Estimate read_result(const std::filesystem::path& path, GridShape grid,
                                   const std::string& scene = "");

/// Tells how the light field of a result or of labels was read. Unknown for those of other programs
/// and of former versions. Throws IoError if it is an HDF5 file and damaged.
[[nodiscard]] Reading read_reading(const std::filesystem::path& path);

/// Whether the file is one that `write_result` wrote (an HDF5 file with the group `/estimate`).
/// Throws IoError if it is an HDF5 file and damaged.
[[nodiscard]] bool is_result_file(const std::filesystem::path& path);

/// Group of a result file that holds the maps; its attributes tell their provenance.
inline constexpr const char* kResultGroup = "estimate";
/// Unit of disparities in result files, and of numbers without one.
inline constexpr const char* kDisparityUnit = "px per view step";
inline constexpr const char* kNoUnit = "1";

/// "estimate/<name>".
[[nodiscard]] std::string in_group(const char* name);

/// Writes the provenance of maps of this geometry; `source` replaces the source of the estimate.
/// Throws IoError.
void write_provenance(Hdf5Output& file, const Provenance& estimate, const MapGeometry& maps,
                      const std::string& source);

/// Attribute of the camera (write_camera).
inline constexpr const char* kPinhole = "pinhole";

/// Says what maps of a result are that were added to the file, in words, and names their axes.
void describe_maps(Hdf5Output& file, const MapGeometry& maps);

/// Stores a camera as the archive does: numbers `dH`, `focalLength`, `shift`, `camDistance` and
/// `pinhole` (focal length, x and y of the center in px) as attributes of a group or of the root.
void write_camera(Hdf5Output& file, const std::string& group, const CameraGrid& camera);

/// Reads what `write_camera` stored; unknown if it is missing or damaged.
[[nodiscard]] CameraGrid camera_in(const Hdf5Input& file, const std::string& group);

/// Stores how a light field was read as attributes of a group or of the root; nothing if that is
/// not known.
void write_reading(Hdf5Output& file, const std::string& group, const Reading& reading);

/// Reads what `write_reading` stored; unknown in files of other programs and of former versions.
[[nodiscard]] Reading reading_in(const Hdf5Input& file, const std::string& group);

}  // namespace episcope::io
