// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/benchmark/benchmark_names.h"

#include <fmt/format.h>

namespace episcope::io {

std::string view_file_name(int index) {
  return fmt::format("{}{:03}.png", kViewPrefix, index);
}

std::string disparity_file_name(int index) {
  return fmt::format("gt_disp_lowres_Cam{:03}.pfm", index);
}

std::string region_of(const std::filesystem::path& mask, const std::string& suffix) {
  const std::string prefix = "mask_";
  const std::string name = mask.filename().string();
  const bool is_mask = name.starts_with(prefix) && name.ends_with(suffix) &&
                       name.size() > prefix.size() + suffix.size();
  if (!is_mask) return {};
  return name.substr(prefix.size(), name.size() - prefix.size() - suffix.size());
}

}  // namespace episcope::io
