// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/disparity_field.h"
#include "engine/core/light_field/light_field.h"
#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"
#include "engine/io/open/open_options.h"

#include <cmath>
#include <string>

namespace episcope::io {

/// Depth as stored, with the mask beside it; views in the stored order.
struct DepthMaps {
  std::string name;
  ViewStack<float> depth;
  ViewStack<std::uint8_t> mask;  ///< Empty, or of the same or of a single view.

  [[nodiscard]] bool empty() const { return depth.empty(); }
  [[nodiscard]] bool is_valid(ViewIndex view, int y, int x) const {
    const float z = depth.view(view).at(y, x);
    const bool is_masked = mask.contains(view) && mask.view(view).at(y, x) == 0;
    return std::isfinite(z) && z > 0 && !is_masked;
  }
};

/// Settles the units of `stored` by the depth and by warping views (see find_units); what it
/// decided goes to `report`. Linear in the size of five views.
[[nodiscard]] CameraGrid settle_units(const DepthMaps& maps, const LightField::Samples& samples,
                                      const CameraGrid& stored, Units units,
                                      ConventionReport& report);

/// Turns depth into disparity in place. If valid depth lies in a single view, only that is kept; if
/// there is none, the field is empty. Tells `report` of pixels without depth. Throws Cancelled.
[[nodiscard]] DisparityField disparity_from_depth(DepthMaps maps, const CameraGrid& camera,
                                                  ConventionReport& report,
                                                  const Progress& progress);

}  // namespace episcope::io
