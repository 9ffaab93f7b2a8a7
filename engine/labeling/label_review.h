// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "engine/core/progress.h"

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

/// Which pixels count as neighbors: Sides those that share a side, Corners also those that share a
/// corner.
enum class Neighbors { Sides, Corners };

/// Connected sets of at least `least_pixels` pixels of `mask` that are not 0, in the order of their
/// first pixels, by row, then column.
[[nodiscard]] std::vector<Blob> blobs_of(ImageView<const std::uint8_t> mask, Neighbors neighbors,
                                         int least_pixels = 1);

/// A region whose label is doubtful: one stroke there decides about all of it.
struct LabelDoubt {
  std::int32_t label = 0;  ///< Current label,
  std::int32_t rival = 0;  ///< and the next best one of most of its pixels.
  double gain = 0;         ///< Sum of the doubt of its pixels; the largest should be painted first.
  Blob blob;
};

/// What counts as doubtful.
struct DoubtChoice {
  /// How probable another label must be, relative to the pixel's own, in [0, 1].
  double least_doubt = 0.25;
  /// Least width of a region everywhere, in px. A stroke can hit such a region, and boundaries,
  /// which are always in doubt, are left out.
  int least_width_px = 5;
  std::size_t count = 20;  ///< At most so many.
};

/// Finds the regions where a stroke would decide most: connected doubtful pixels of one label, the
/// largest gain first. The doubt of a pixel is the probability of its second label divided by the
/// probability of its own, at most 1. Unlike entropy, it does not depend on the number of labels.
/// Painted pixels have no doubt.
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

struct MaskValues {
  std::uint8_t of_label = 255;
  std::uint8_t of_others = 0;
};

/// The mask of one label in a map of labels `[y][x]`.
[[nodiscard]] Image<std::uint8_t> label_mask(ImageView<const std::int32_t> labels,
                                             std::int32_t label, MaskValues values = {});

/// Smooths the boundaries of labels: each pixel takes the most frequent label around it, weighted
/// by a Gaussian of standard deviation `smoothing_px`, and keeps its own in a tie. Straight
/// boundaries stay, corners are rounded, parts much thinner than `smoothing_px` vanish. Painted
/// pixels keep their labels, pixels of label 0 stay without one. 0 px changes nothing.
///
/// `labels` `[y][x]`; `painted` `[y][x]` (0 = not painted) or empty. Source: one step of Merriman,
/// Bence and Osher, Diffusion generated motion by mean curvature, 1992, with several labels. Throws
/// InvalidInput for a negative smoothing or if sizes differ.
[[nodiscard]] Image<std::int32_t> smooth_boundaries(ImageView<const std::int32_t> labels,
                                                    ImageView<const std::uint8_t> painted,
                                                    double smoothing_px);

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
/// (engine/labeling/ray_labeling.h). The nearest pixel of a ray that arrives at the boundary of
/// an object may belong to the neighbor, so exact labels do not quite reach 1. Views without
/// disparity are left out. Takes (v + u − 2)·rays steps.
/// Source: the measure of [WSG13], the fraction of rays whose label equals the label at the warped
/// position, occlusion-checked. Throws InvalidInput unless sizes agree, Cancelled.
[[nodiscard]] LabelConsistency label_consistency(const ViewStack<std::int32_t>& labels,
                                                 const DisparityField& disparity,
                                                 const Progress& progress);

}  // namespace episcope
