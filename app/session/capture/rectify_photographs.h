// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/pose/point_pair.h"
#include "engine/capture/rectify/rectify.h"
#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"

#include <filesystem>
#include <vector>

namespace episcope {

/// Photographs of a gantry, and what is to become of them.
struct RectifyTask {
  Scene photographs;
  capture::LensCamera camera;
  capture::RectifyOptions options;
  std::filesystem::path output;           ///< Light field to write.
  std::vector<capture::PointPair> picks;  ///< In the photograph of the centre view.
};

struct RectifiedFile {
  capture::Rectified rectified;
  std::vector<capture::PointPair> pairs;  ///< The picks, in the rectified centre view.
};

/// Rectifies photographs, writes the light field and carries the picks over. Throws what
/// capture::rectify and io::write_archive do.
[[nodiscard]] RectifiedFile rectify_to_file(RectifyTask task, const Progress& progress);

}  // namespace episcope
