// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/common/surfaces_in_views.h"
#include "engine/disparity/plane/label_costs.h"
#include "engine/disparity/stereo/stereo_costs.h"

namespace episcope {

/// Which views count, and how much a difference does.
struct VisibilityParameters {
  int rounds = 2;            ///< Times that costs are computed anew with what occludes what.
  double tolerance = 0.2;    ///< Occluders::tolerance, px.
  double least_trust = 0.1;  ///< Of surfaces that occlude, mean over their surroundings.
  double cap_share = 0.7;    ///< Of StereoCosts' ε that is the least cap of a pixel.
  double cap_offset = 0;     ///< LocalCapOptions::offset, px; 0 = one cap for all pixels.
};
[[nodiscard]] Schema<VisibilityParameters> visibility_schema();

/// Unless `cap_offset` is 0, gives every pixel a cap of its own (local_caps.h), at least a share of
/// the ε found for the whole view. Throws Cancelled.
void set_local_caps(const LightField& light_field, const VisibilityParameters& parameters,
                    const Progress& progress, StereoCosts& costs);

/// The disparities whose confidence, mean over its surroundings (regional_trust.h), is at least
/// `least_trust`; elsewhere kNothingNear.
[[nodiscard]] Image<float> sure_surfaces(ImageView<const float> disparity,
                                         ImageView<const float> confidence, double least_trust);

/// From here on views in which a sure surface occludes a point do not count for it. Throws
/// Cancelled.
void set_occluders(const LightField& light_field, ImageView<const float> disparity,
                   ImageView<const float> confidence, const VisibilityParameters& parameters,
                   const Progress& progress, StereoCosts& costs);

/// The costs of all rows (stereo_volume), where the data term has them computed; with caps of
/// single pixels divided by that of their pixel and times the mean cap: a smooth region whose noise
/// is low then says as much as one of strong contrast, and is not overruled by the smoothness. They
/// refer to `costs`. Throws DeviceFailure, Cancelled.
[[nodiscard]] LabelCosts visible_costs(const LightField& light_field, const StereoCosts& costs,
                                       const Progress& progress);

}  // namespace episcope
