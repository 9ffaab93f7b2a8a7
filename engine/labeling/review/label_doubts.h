// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/volume.h"
#include "engine/labeling/review/blob.h"

namespace episcope {

/// A region of one label that may well be of another: a stroke there decides about all of it.
struct LabelDoubt {
  std::int32_t label = 0;  ///< It has,
  std::int32_t rival = 0;  ///< and what most of its pixels would else be.
  double gain = 0;  ///< Sum of the doubt of its pixels: the larger, the sooner to be painted.
  Blob blob;
};

/// What counts as doubtful.
struct DoubtChoice {
  /// How probable another label must be, relative to the pixel's own, in [0, 1].
  double least_doubt = 0.25;
  /// Regions are wider than this everywhere, in px: a stroke hits them, and boundaries, which are
  /// always in doubt, are left out.
  int least_width_px = 5;
  std::size_t count = 20;  ///< At most so many.
};

/// Where a stroke would decide most: the connected regions of one label whose pixels are in doubt,
/// the largest gain first. The doubt of a pixel is the probability of the most probable other label
/// over that of its own label, at most 1: unlike the entropy, it does not depend on how many labels
/// there are. Painted pixels are beyond doubt.
///
/// `probabilities` `[y][label][x]`, `ids` names their layers, `labels` `[y][x]`, `painted` `[y][x]`
/// (0 = not painted) or empty. Throws InvalidInput if sizes differ.
[[nodiscard]] std::vector<LabelDoubt> label_doubts(VolumeView<const std::uint8_t> probabilities,
                                                   const std::vector<std::int32_t>& ids,
                                                   ImageView<const std::int32_t> labels,
                                                   ImageView<const std::uint8_t> painted,
                                                   const DoubtChoice& choice = {});

}  // namespace episcope
