// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/evaluation/metrics/resolved_errors.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace episcope {

using RegionMask = std::shared_ptr<const Image<std::uint8_t>>;

/// The mask of a region at the resolution of the truth; null if the scene has none of this name.
/// Throws Error if it cannot be read.
using RegionLookup = std::function<RegionMask(const std::string& name)>;

/// Metrics of regions that the 2016 benchmark scores in high resolution; those for whose masks
/// there are, pixels nearer than `border` to the border of the truth left out but where said:
///
/// - discontinuities_0070 (region discontinuities), % with |error| > 0.07; fine_fattening_0150
///   (fine_surrounding) and fine_thinning_0150 (fine), % with an error < −0.15 and > 0.15;
/// - backgammon_fattening_0070 (foreground_fattening), % nearer than the middle between truth and
///   foreground, which is the truth of the row in column 14·scale; backgammon_thinning_0070
///   (foreground_thinning), % farther than the middle between truth and background, which is that
///   of the eleventh column from the right, of the truth whatever its scale;
/// - missed_dots_50_0400 (dots_by_size and boxes, which are numbered), % of the dots, one of each
///   size of 1 … 8 in each box, with at least half of their pixels off by more than 0.4 px, also
///   within the border; a dot without pixels is missed; background_mse_100 (background);
/// - low_texture_0070 (low_texture), dark_stripes_0070 (high_contrast) and bright_stripes_0070
///   (low_contrast), % with |error| > 0.07.
///
/// Thresholds in the keys of backgammon are names only. Metrics of backgammon, dots and stripes are
/// those of `scene` alone. Source: [HJKG16], evaluation toolkit. A metric whose mask cannot be read
/// or has another size adds the sentence to `problems`. Throws Cancelled.
[[nodiscard]] Metrics masked_metrics(const ResolvedErrors& errors, int border,
                                     StratifiedScene scene, const RegionLookup& region,
                                     std::vector<std::string>& problems);

}  // namespace episcope
