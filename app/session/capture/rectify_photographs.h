// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/capture/capture_work.h"
#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"

#include <filesystem>

namespace episcope {

/// Photographs of a gantry, and what is to become of them.
struct RectifyTask {
  Scene photographs;
  CaptureWork work;              ///< With lens and settings; pairs in the centre photograph.
  std::filesystem::path output;  ///< Light field to write.
};

struct RectifiedFile {
  capture::Rectified rectified;
  /// As it goes on there: pairs in the rectified centre view, how well rows are aligned, no poses.
  CaptureWork work;
};

/// Rectifies photographs and writes the light field. Precondition: there is a lens. Throws what
/// capture::rectify and io::write_archive do.
[[nodiscard]] RectifiedFile rectify_to_file(RectifyTask task, const Progress& progress);

}  // namespace episcope
