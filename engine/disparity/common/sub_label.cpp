// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/sub_label.h"

#include <algorithm>

namespace episcope {

Names<Refinement> names_of(Refinement) {
  return {{Refinement::Parabola, "parabola"},
          {Refinement::Equiangular, "equiangular"},
          {Refinement::None, "none"}};
}

float sub_label_offset(float before, float here, float after, Refinement refinement) {
  const float bend = refinement == Refinement::Parabola ? before - 2 * here + after
                                                        : std::max(before, after) - here;
  if (refinement == Refinement::None || !(bend > 0)) return 0;
  return std::clamp(0.5F * (before - after) / bend, -0.5F, 0.5F);
}

}  // namespace episcope
