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

}  // namespace episcope::io
