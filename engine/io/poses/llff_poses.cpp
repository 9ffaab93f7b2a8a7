// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/poses/llff_poses.h"

#include "engine/core/error.h"
#include "engine/io/arrays/npy_file.h"

#include <fmt/format.h>

namespace episcope::io {

std::vector<CameraPose> read_llff_poses(const std::filesystem::path& path) {
  constexpr std::size_t kNumbers = 17;
  constexpr std::size_t kMostImages = 100'000;
  const NpyFile file(path);
  const ArrayShape& shape = file.shape();
  const bool is_sound = shape.size() == 2 && shape[1] == kNumbers && shape[0] <= kMostImages &&
                        !file.header().is_fortran;
  if (!is_sound) {
    throw IoError(path, fmt::format("the array has the shape {}, but poses are N×17 in C order; "
                                    "export them again or remove the file",
                                    array_shape_text(file.header().shape)));
  }
  std::vector<float> all(shape[0] * kNumbers);
  file.read(ArrayShape(2, 0), shape, all.data());
  std::vector<CameraPose> poses;
  for (std::size_t i = 0; i < shape[0]; ++i) {
    const auto column = [&](std::size_t c) {
      const float* matrix = &all[i * kNumbers];
      return Direction{matrix[c], matrix[5 + c], matrix[10 + c]};
    };
    const auto [height, width, focal] = column(4);
    poses.push_back({.image = {},
                     .center = column(3),
                     .right = normalized(column(1)),
                     .down = normalized(column(0)),
                     .ahead = normalized(times(-1, column(2))),
                     .focal_widths = width > 0 ? focal / width : 0});
  }
  return poses;
}

}  // namespace episcope::io
