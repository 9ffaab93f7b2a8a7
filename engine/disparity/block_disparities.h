// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/progress.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace episcope {

/// From the first to the last of what either holds.
[[nodiscard]] inline Interval united(Interval a, Interval b) {
  return {std::min(a.min, b.min), std::max(a.max, b.max)};
}

/// Farther at both ends.
[[nodiscard]] inline Interval grown(Interval range, double by) {
  return {range.min - by, range.max + by};
}

/// With ends moved into `to`.
[[nodiscard]] inline Interval clipped(Interval range, Interval to) {
  return {std::clamp(range.min, to.min, to.max), std::clamp(range.max, to.min, to.max)};
}

/// Which views are made smaller: those in the row and the column of the center view, or all.
enum class ReducedViews { CrossHair, All };

/// Views of which each sample is the mean of `factor` × `factor` pixels, as uint16: noise is
/// `factor` times weaker, disparities are `factor` times smaller. Other views are black. Blocks
/// that the border or an invalid pixel cuts are left out or not valid. Precondition: factor ≤
/// height and width. Throws Cancelled.
[[nodiscard]] LightField smaller_views(const LightField& light_field, int factor,
                                       const Progress& progress,
                                       ReducedViews reduced = ReducedViews::CrossHair);

/// What a block of the center view tells of its disparity, px per view step.
struct BlockDisparity {
  float disparity = 0;  ///< Where the block matches best.
  float doubt = 0;      ///< It may lie this far off, either way.
};

/// Disparities in `range` at which blocks of 4×4 px, and of 8×8 px, match the views of the center's
/// row and column: two lists, of the blocks of each size that match distinctly. The cost of a label
/// is the variance of the differences between block and view, so that neither gain nor vignetting
/// counts. The larger a block, the less the noise in it: it is distinct, and beyond doubt, by
/// smaller differences between costs. Blocks without texture, and repeated patterns, are left out.
/// Samples between pixels average noise: where it is strong, whole labels match worse, and a block
/// may be 0.25 px farther off. So may one that others hide in part.
/// Precondition: the range holds 0.5 px or more. Throws Cancelled, InvalidInput for a single view.
[[nodiscard]] std::vector<std::vector<BlockDisparity>> block_disparities(
    const LightField& light_field, Interval range, const Progress& progress);

/// The disparities within ±`limit` that at least four blocks of a size reach whatever their doubts,
/// in views reduced to 96 px or more and in such of half the size; looked for around `seen` alone,
/// if there is something. None without such blocks. Throws as block_disparities.
[[nodiscard]] std::optional<Interval> certain_range(const LightField& light_field, double limit,
                                                    std::optional<Interval> seen,
                                                    const Progress& progress);

}  // namespace episcope
