// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/high_res_truth.h"

#include <filesystem>
#include <vector>

namespace episcope::io {

/// `gt_disp_highres.pfm` and `mask_<name>_highres.png` of a scene folder of the 2016 benchmark,
/// which are looked up now and read when they are asked for.
struct HighResFiles {
  std::filesystem::path disparity;
  std::vector<std::filesystem::path> masks;  ///< Sorted.
};

/// `disparity` is empty if it is not there. Throws filesystem_error.
[[nodiscard]] HighResFiles find_high_res_files(const std::filesystem::path& folder);

/// Truth of views of this size; null without a disparity map.
[[nodiscard]] HighResTruthPtr high_res_truth(const HighResFiles& files, int height, int width);

}  // namespace episcope::io
