// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "engine/core/volume.h"

#include <cstdint>
#include <vector>

namespace episcope {

/// A connected set of pixels of an image.
struct Blob {
  PixelRect bounds;
  Image<std::uint8_t> mask;  ///< `[y][x]` of `bounds`; 1 = belongs to it.
  int pixels = 0;
  PixelIndex inside;  ///< The pixel that lies deepest in it.

  /// Whether a pixel of the image belongs to it.
  [[nodiscard]] bool contains(PixelIndex pixel) const {
    return pixel.y >= bounds.y0 && pixel.y < bounds.y1 && pixel.x >= bounds.x0 &&
           pixel.x < bounds.x1 && mask.at(pixel.y - bounds.y0, pixel.x - bounds.x0) != 0;
  }
};

/// Which pixels count as neighbours: Sides those that share a side, Corners also those that share a
/// corner.
enum class Neighbours { Sides, Corners };

/// The connected sets of the pixels of `mask` that are not 0, those of at least `least_pixels`, in
/// the order of their first pixels, by row, then column.
[[nodiscard]] std::vector<Blob> blobs_of(ImageView<const std::uint8_t> mask, Neighbours neighbours,
                                         int least_pixels = 1);

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

/// Main: the largest connected part of a label. Island: another part of it. Hole: other labels that
/// it encloses.
enum class PieceKind : std::uint8_t { Main, Island, Hole };

/// A part of a label, or a hole in it.
struct LabelPiece {
  PieceKind kind = PieceKind::Main;
  std::int32_t label = 0;  ///< Of a hole, the label that most of its pixels have.
  Blob blob;
};

/// The parts of a label, whose pixels touch at their sides, and what they enclose: the sets of
/// pixels of other labels, touching at corners too, that do not reach the border of the image.
/// `labels` is `[y][x]`. The main part comes first, then islands and holes, the largest first.
/// Empty if no pixel has the label.
[[nodiscard]] std::vector<LabelPiece> pieces_of(ImageView<const std::int32_t> labels,
                                                std::int32_t label);

/// What the pixels of a mask are.
struct MaskValues {
  std::uint8_t of_label = 255;
  std::uint8_t of_others = 0;
};

/// Where a picture of labels `[y][x]` has one of them.
[[nodiscard]] Image<std::uint8_t> label_mask(ImageView<const std::int32_t> labels,
                                             std::int32_t label, MaskValues values = {});

/// Labels whose boundaries are smoother: each pixel takes the label with the most pixels around it,
/// weighted by a Gaussian of standard deviation `smoothing_px`; of equals it keeps its own.
/// Straight boundaries stay where they are, corners are rounded, and what is much thinner than
/// `smoothing_px` vanishes. Painted pixels keep their labels. 0 px gives the labels as they are.
///
/// `labels` `[y][x]`; `painted` `[y][x]` (0 = not painted) or empty. Source: one step of Merriman,
/// Bence and Osher, Diffusion generated motion by mean curvature, 1992, with several labels. Throws
/// InvalidInput for a negative smoothing or if sizes differ.
[[nodiscard]] Image<std::int32_t> smooth_boundaries(ImageView<const std::int32_t> labels,
                                                    ImageView<const std::uint8_t> painted,
                                                    double smoothing_px);

}  // namespace episcope
