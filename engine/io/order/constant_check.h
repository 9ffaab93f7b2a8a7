// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/disparity_field.h"
#include "engine/core/light_field/light_field.h"
#include "engine/io/order/warp_check.h"

namespace episcope::io {

/// How much better a map explains the views next to its own than one disparity for all would.
struct ConstantComparison {
  int squares = 0;   ///< Of 16×16 px in which the map differs from that disparity.
  double score = 0;  ///< By how many standard deviations of chance the map is better there.

  /// Whether the map can be told from a constant.
  [[nodiscard]] bool is_told() const;
  /// And whether it is better by more than chance.
  [[nodiscard]] bool is_better() const;
};

/// Warps the up to four neighbours of `at`, evened out in brightness, with the map, in the order of
/// each axis that `errors` says, and with the constant disparity that explains that axis best,
/// within the range of the map to either side of 0. A map that is wrong, but of the right mean, may
/// explain views better than no warping, but hardly better than that. Looks at some 10,000 pixels.
[[nodiscard]] ConstantComparison compare_with_constant(const LightField::Samples& samples,
                                                       ViewIndex at, const DisparityView& disparity,
                                                       const WarpErrors& errors);

}  // namespace episcope::io
