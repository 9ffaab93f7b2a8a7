// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/progress.h"

#include <cstdint>

namespace episcope {

/// Consistency of the labels of many views along the rays.
struct LabelConsistency {
  std::int64_t agreeing = 0;  ///< Pairs of a ray and another view where the labels are equal,
  std::int64_t visible = 0;   ///< of those where the ray's point is seen there,
  std::int64_t pairs = 0;     ///< of all.

  /// The measure itself: the fraction of visible pairs with equal labels, in [0, 1].
  [[nodiscard]] double share() const {
    return visible > 0 ? static_cast<double>(agreeing) / static_cast<double>(visible) : 1;
  }
  /// The fraction of pairs that could be checked, in [0, 1].
  [[nodiscard]] double checked() const {
    return pairs > 0 ? static_cast<double>(visible) / static_cast<double>(pairs) : 0;
  }
};

/// Follows each ray of each view to every other view in the same row or column of the camera grid,
/// along the lines of the horizontal and vertical EPI through it, to the nearest pixel there, and
/// compares the labels. Disparities tell whether the point is visible there
/// (engine/labeling/ray_targets.h). The nearest pixel of a ray that arrives at the boundary of
/// an object may belong to the neighbor, so exact labels do not quite reach 1. Views without
/// disparity are left out. Takes (v + u − 2)·rays steps.
/// Source: the measure of [WSG13], the fraction of rays whose label equals the label at the warped
/// position, occlusion-checked. Throws InvalidInput unless sizes agree, Cancelled.
[[nodiscard]] LabelConsistency label_consistency(const ViewStack<std::int32_t>& labels,
                                                 const DisparityField& disparity,
                                                 const Progress& progress);

}  // namespace episcope
