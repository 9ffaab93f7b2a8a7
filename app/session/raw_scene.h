// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/plenoptic/decode_files.h"
#include "engine/capture/plenoptic/synthetic_camera.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/scenes/builtin.h"

#include <filesystem>

namespace episcope {

/// A built-in scene before a plenoptic camera. `scene.options`: only the seed, kind and disparity
/// scale count; size and grid follow from the camera.
[[nodiscard]] capture::PupilLight light_of(const scenes::BuiltinRequest& scene,
                                           const capture::SyntheticCamera& camera);

/// The views, without errors of a camera, that a decoder should find: `views`² of the size of the
/// camera's views, a pixel of the sensor apart, with truth. Throws as scenes::render_builtin.
[[nodiscard]] Scene ideal_views(const scenes::BuiltinRequest& scene,
                                const capture::SyntheticCamera& camera, int views,
                                const Progress& progress);

/// Id of the synthetic plenoptic camera, `demo:plenoptic`: a light field decoded from a raw
/// picture.
inline constexpr const char* kPlenopticScene = "plenoptic";

/// Raw and white picture of the demo before an F01 with a smaller sensor. Throws Cancelled.
[[nodiscard]] capture::FoundPictures expose_plenoptic(const Progress& progress);

/// What `expose_plenoptic` exposes, decoded. Throws Cancelled.
[[nodiscard]] Scene load_plenoptic(const Progress& progress);

/// Files of a synthetic raw picture.
struct RawFolder {
  std::filesystem::path raw;
  std::filesystem::path white;  ///< What `decode --white` takes; empty = it finds it itself.
  std::filesystem::path ideal;  ///< Light field with truth.
};

/// Exposes a built-in scene and writes what the camera would, the ideal views and a readme.txt with
/// the command that decodes, into a new folder. Throws IoError if it holds files, Cancelled.
[[nodiscard]] RawFolder write_raw_folder(const std::filesystem::path& folder,
                                         const scenes::BuiltinRequest& scene,
                                         const capture::SyntheticCamera& camera,
                                         const Progress& progress);

}  // namespace episcope
