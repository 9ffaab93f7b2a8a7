// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/isa.h"

#include <cstdint>

namespace episcope {

/// Rays of a row, and the view in which they arrive.
struct RayRow {
  int begin = 0, end = 0;               ///< Columns of the rays, a whole vector of 16 at least.
  int height = 0, width = 0;            ///< Of the view.
  float row = 0;                        ///< y of the rays.
  float step_x = 0, step_y = 0;         ///< To the other view, px per px of disparity.
  const float* disparity = nullptr;     ///< Of the row,
  const std::uint8_t* valid = nullptr;  ///< null = all.
  const float* there = nullptr;         ///< Of the other view, `[y][x]`.
  const std::uint8_t* valid_there = nullptr;
  float tolerance = 0;  ///< Most by which disparities of one point differ.
};

/// Costs of the labels of one view, to be added to the costs of a row of rays that arrive in it.
struct RayCosts {
  const std::uint8_t* codes = nullptr;  ///< `[y][label][x]`, `size` of them,
  long size = 0;
  const float* table = nullptr;  ///< and the cost of each code.
  int labels = 0, width = 0;
  const std::int32_t* targets = nullptr;  ///< y·width + x of each ray, where it is trusted.
  const float* trusts = nullptr;          ///< Of each ray, 0 = it does not count.
};

/// Rays of a row, whose colors are compared with the colors of the pixels in which they arrive.
struct RayTrusts {
  int begin = 0, end = 0;                 ///< Columns of the rays,
  int width = 0;                          ///< of so many of the row.
  const std::uint8_t* row = nullptr;      ///< `[x][3]`
  const std::uint8_t* other = nullptr;    ///< `[y][x][3]`, of the view in which they arrive,
  std::int32_t last = 0;                  ///< and its last pixel.
  const std::int32_t* targets = nullptr;  ///< −1 = the ray arrives nowhere.
  const float* table = nullptr;           ///< Trust of each squared difference from 0 to `most`,
  int most = 0;                           ///< larger differences count as `most`.
};

/// The kernel's entry points, one set for each instruction set, all with the same bits.
struct RayKernel {
  /// What find_ray_targets says.
  void (*find_targets)(const RayRow&, std::int32_t* targets);  // of the row
  /// What RayColors::trusts says of three channels.
  void (*find_trusts)(const RayTrusts&, float* trusts);
  /// costs `[label][x]` += trust · cost where the ray arrives.
  void (*add_costs)(const RayCosts&, float* costs);
};

EPISCOPE_DECLARE_KERNEL(extern const RayKernel kRayKernel);

}  // namespace episcope
