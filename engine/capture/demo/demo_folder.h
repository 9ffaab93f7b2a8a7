// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/demo/demo_scene.h"
#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"

#include <filesystem>

namespace episcope::capture {

/// The photograph that the demo gantry takes of one view. Throws Cancelled.
[[nodiscard]] Image<std::uint8_t> demo_photograph(const DemoRig& rig, const TriangleMesh& mesh,
                                                  ViewIndex view, const Progress& progress);

/// All of them, as a light field that is not rectified. Throws Cancelled.
[[nodiscard]] LightField demo_photographs(const DemoRig& rig, const TriangleMesh& mesh,
                                          const Progress& progress);

/// The distance of neighbouring corners of the demo's calibration pattern, in mm.
[[nodiscard]] Pattern demo_pattern();

/// Writes all that the way from photographs to a light field with truth begins with:
/// photographs/RR_CC.png, pattern/01.png … (the last two blurred and cut off), mesh.ply (with a
/// hole), picks.csv (in the photograph of the centre), readme.txt with the commands. Throws
/// IoError, also if the folder exists and is not empty; Cancelled.
void write_demo_folder(const std::filesystem::path& folder, const DemoOptions& options,
                       const Progress& progress);

}  // namespace episcope::capture
