// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/cuda/stereo/stereo_matcher.h"
#include "engine/disparity/common/matching_cost.h"
#include "engine/disparity/common/sub_label.h"

#include <vector>

namespace episcope {

/// What the device needs to know of a matching; noise, caps of single pixels and occluders are the
/// matcher's own. Throws InvalidInput as MatchingCostRows.
[[nodiscard]] cuda::StereoMatching device_matching(const LightField& light_field,
                                                   ViewIndex reference, const MatchingCost& cost,
                                                   const std::vector<float>& labels);

[[nodiscard]] cuda::LabelPlaces::Refinement device_refinement(Refinement refinement);

}  // namespace episcope
