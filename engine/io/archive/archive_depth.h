// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/ground_truth.h"
#include "engine/core/light_field/light_field.h"
#include "engine/core/light_field/scene.h"
#include "engine/io/archive/archive_maps.h"
#include "engine/io/open/open_options.h"

#include <string>

namespace episcope::io {

/// Disparity from the depth of an archive file, in the stored order of views.
struct ArchiveTruth {
  DisparityField field;
  DisparityField foreground;
  DisparityField background;
  CameraGrid camera;  ///< With units settled; unknown if the file states so.
  /// Depth that no camera of the file turns into disparity; else empty,
  std::string unused_depth;
  std::string camera_fault;     ///< and why not.
  bool has_attributes = false;  ///< Of a camera, though they are of no use.
};

/// Reads GT_DEPTH and the datasets of transparent scenes with their masks, finds the units and
/// converts to disparity; what it decided goes to `report`. Depth that is zero, negative or NaN is
/// invalid; of views without any valid depth nothing is kept. Without `options.needs_truth` only
/// the centre view is read. Throws IoError, Cancelled.
[[nodiscard]] ArchiveTruth read_archive_depth(const Hdf5Input& file,
                                              const LightField::Samples& samples,
                                              const OpenOptions& options, ConventionReport& report,
                                              const Progress& progress);

/// Camera attributes as stored, on the root or on LF; an unknown camera if they are missing, if one
/// is not finite, or if the file states that it has none.
[[nodiscard]] CameraGrid read_camera(const Hdf5Input& file);

}  // namespace episcope::io
