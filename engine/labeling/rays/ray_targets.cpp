// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/ray_targets.h"

#include "engine/labeling/rays/ray_kernel.h"

#include <algorithm>
#include <limits>

namespace episcope {
namespace {

// A row of fewer rays than the widest vector has lanes, with rays beside it that arrive nowhere.
void find_few_targets(const RayKernel& kernel, RayRow rays, std::int32_t* targets) {
  float disparity[kRayColumns];
  std::uint8_t valid[kRayColumns] = {};
  std::int32_t found[kRayColumns];
  std::fill_n(disparity, kRayColumns, std::numeric_limits<float>::quiet_NaN());
  std::copy_n(rays.disparity, rays.end, disparity);
  if (rays.valid != nullptr) {
    std::copy_n(rays.valid, rays.end, valid);
    rays.valid = valid;
  }
  const int count = rays.end;
  rays.disparity = disparity;
  rays.end = kRayColumns;
  kernel.find_targets(rays, found);
  std::copy_n(found, count, targets);
}

}  // namespace

void find_ray_targets(const DisparityView& from, const DisparityView& to, ViewIndex step, int y,
                      std::int32_t* targets) {
  find_ray_targets(from, to, step, y, {0, from.disparity.width}, targets);
}

void find_ray_targets(const DisparityView& from, const DisparityView& to, ViewIndex step, int y,
                      ColumnRange columns, std::int32_t* targets) {
  static const RayKernel& kernel = EPISCOPE_CHOOSE_KERNEL(best_isa(), kRayKernel);
  RayRow rays;
  rays.height = from.disparity.height;
  rays.width = from.disparity.width;
  rays.begin = columns.begin;
  rays.end = columns.end;
  rays.row = static_cast<float>(y);
  rays.step_x = static_cast<float>(step.u);
  rays.step_y = static_cast<float>(step.v);
  rays.disparity = from.disparity.row(y);
  rays.valid = from.valid.empty() ? nullptr : from.valid.row(y);
  rays.there = to.disparity.data;
  rays.valid_there = to.valid.empty() ? nullptr : to.valid.data;
  rays.tolerance = kSamePointTolerance_px;
  if (rays.width < kRayColumns) return find_few_targets(kernel, rays, targets);
  kernel.find_targets(rays, targets);
}

}  // namespace episcope
