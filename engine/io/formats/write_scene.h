// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/core/scene.h"

#include <filesystem>
#include <string>

namespace episcope::io {

/// File beside the light field for its labels: `labels.h5`, or one of its name (label_files_of).
enum class LabelFile { Usual, NamedAfter };

/// What there is to choose for a file of the archive form.
struct ArchiveForm {
  LabelFile labels = LabelFile::Usual;
  bool has_disparity = false;  ///< GT_DISPARITY beside GT_DEPTH, px per view step, NaN = not known.
};

/// Writes a scene in the form of the 2013 archive: the light field and its depth to `path`, labels
/// and scribbles to a file beside it. They go into `path` if that file is there and of another
/// light field. Rows are in canonical order, which the attribute `convention` states. Atomic for
/// each file. Throws IoError, Cancelled.
void write_archive(const std::filesystem::path& path, const Scene& scene, const Progress& progress,
                   const ArchiveForm& form = {});

/// Where `write_archive` puts labels: `path` itself if a file of another light field lies beside
/// it; empty if the scene has none.
[[nodiscard]] std::filesystem::path labels_place(const std::filesystem::path& path,
                                                 const Scene& scene,
                                                 LabelFile labels = LabelFile::Usual);

/// Writes a folder of the 2016 benchmark form: images, cfg, PFM truth of the center
/// view and, where known, of all views. Throws IoError (also if the folder holds other files),
/// Cancelled.
void write_benchmark_folder(const std::filesystem::path& folder, const Scene& scene,
                            const Progress& progress);

/// What Episcope adds to a light-field file of the archive form; other programs ignore it.

/// Attribute of the root: how depth becomes disparity, then the order of views.
inline constexpr const char* kConvention = "convention";
inline constexpr const char* kConventionText =
    "d = dH*focalLength/Z - shift; point at (x,y) in view (v,h) is at (x-d,y) in (v,h+1) and "
    "(x,y-d) in (v+1,h)";
/// Attributes of the root: StatedFacts.
inline constexpr const char* kOrigin = "origin";
inline constexpr const char* kSamples = "samples";
inline constexpr const char* kSign = "sign";
/// Attribute of the root: x and y of the camera of each view, row by row; and their unit.
inline constexpr const char* kPositions = "camera_positions";
inline constexpr const char* kPositionUnit = "camera_position_unit";
/// The source of a result in parameters of the benchmark form.
inline constexpr const char* kEstimatedFrom = "estimated_from";
/// Datasets of depth, `[v][h][y][x]` or, of the center view alone, `[y][x]`; names of layers begin
/// so. Those of disparity have the same shape, and the same names but for the beginning.
inline constexpr const char* kTrueDepth = "GT_DEPTH";
inline constexpr const char* kTrueDisparity = "GT_DISPARITY";
/// Dataset `[v][h][y][x]`, uint8: 0 = the pixel holds nothing that was seen.
inline constexpr const char* kValid = "VALID";
/// Datasets `[y][x]`, uint8: a region mask of the center view, whose name follows.
inline constexpr const char* kRegionPrefix = "REGION_";

}  // namespace episcope::io
