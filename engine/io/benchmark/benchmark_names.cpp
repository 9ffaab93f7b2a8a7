// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/benchmark/benchmark_names.h"

#include <cstdio>

namespace episcope::io {
namespace {

std::string three_digits(int index) {
  char digits[16];
  std::snprintf(digits, sizeof digits, "%03d", index);
  return digits;
}

}  // namespace

std::string view_file_name(int index) {
  return kViewPrefix + three_digits(index) + ".png";
}

std::string disparity_file_name(int index) {
  return "gt_disp_lowres_Cam" + three_digits(index) + ".pfm";
}

}  // namespace episcope::io
