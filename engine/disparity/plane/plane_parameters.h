// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/schema.h"
#include "engine/disparity/common/islands.h"
#include "engine/disparity/plane/jump_labeling.h"
#include "engine/disparity/plane/plane_refinement.h"
#include "engine/disparity/plane/visible_costs.h"
#include "engine/disparity/stereo/stereo_costs.h"

namespace episcope {

/// What plane_pm (plane_pm.h) is told.
struct PlaneParameters {
  VisibilityParameters visibility = {};
  PlaneRefinementParameters refinement = {};
  JumpLabelingParameters labeling = {};
  StereoCostParameters matching{
      .labels = 96, .interpolation = Interpolation::Cubic, .range = {}, .view = {}};
  bool even = true;
  bool silhouettes = true;
  IslandParameters islands = {};
};
[[nodiscard]] Schema<PlaneParameters> plane_pm_schema();

}  // namespace episcope
