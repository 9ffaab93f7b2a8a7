// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/core/schema.h"
#include "engine/labeling/ray_labeling.h"

#include <cstdint>

namespace episcope {

/// Labels of all views after each ray has taken the label that most rays of its scene point have:
/// the rays in the same row and column of the camera grid, along the lines of the horizontal and
/// vertical EPI through it, where the point is visible
/// (engine/labeling/ray_labeling.h). A vote is weighted by the trust in its color
/// (engine/labeling/ray_labeling.h); the ray's own label counts 1 and wins ties. Rays of all
/// other views do not vote: they would spread errors of whole regions.
///
/// The layers `labels` are 0 … `label_count` − 1. Takes (v + u − 1)·rays steps. Precondition:
/// `disparity` and `colors` hold all views with labels. Throws Cancelled.
struct RayVotes {
  int label_count = 0;
  const DisparityField& disparity;
  const RayColors& colors;
  const RayLabelingInput* input = nullptr;  ///< Whose strokes rounds of votes keep; null = none.
};
[[nodiscard]] ViewStack<std::int32_t> vote_along_rays(const ViewStack<std::int32_t>& labels,
                                                      const RayVotes& votes,
                                                      const Progress& progress);
/// Votes again, faster: only rays vote whose evidence has changed since `before`, from which
/// `labels` came by a vote.
[[nodiscard]] ViewStack<std::int32_t> vote_again_along_rays(const ViewStack<std::int32_t>& before,
                                                            const ViewStack<std::int32_t>& labels,
                                                            const RayVotes& votes,
                                                            const Progress& progress);

/// The rays whose vote (engine/labeling/regularizer.h) may change because labels have: 1 for rays
/// whose own label differs between `before` and `after`, and for all in the same row and column of
/// the camera grid that may see the point of one that does, else 0. Some more are marked: where a
/// ray arrives is known to as many pixels as the disparities of one point may differ
/// (engine/labeling/ray_labeling.h). Precondition: `disparity` holds all views with labels.
/// Throws Cancelled.
[[nodiscard]] ViewStack<std::uint8_t> changed_rays(const ViewStack<std::int32_t>& before,
                                                   const ViewStack<std::int32_t>& after,
                                                   const DisparityField& disparity,
                                                   const Progress& progress);

/// Lines of the horizontal or vertical EPIs from one view to the next of its row or column.
struct RayLines {
  /// `[y][x]`: pixel y'·width + x' of the other view, −1 = the line ends here. No pixel of the
  /// other view is named twice.
  Image<std::int32_t> target;
  Image<std::uint8_t> weight;  ///< Trust in the colors at both ends, `[y][x]`, 255 for 1.
};

/// Input of `find_ray_lines`; borrowed.
struct RayLineSources {
  const DisparityField& disparity;
  const RayColors& colors;
  ViewIndex middle;  ///< The view in which lines run through pixel centers.
};

/// Lines from `view` to `next`, its right or lower neighbor. A line that runs through a pixel
/// center of the middle column (row) of views is drawn through the nearest pixel of every other
/// view, as a line on a screen is: rounded from view to view alone, lines of small slope would
/// never leave their column. A line ends where it leaves the image, where the point is hidden (the
/// disparities differ by more than kSamePointTolerance_px), where the colors are not trusted, and
/// where another line has reached the same pixel. Throws Cancelled.
[[nodiscard]] RayLines find_ray_lines(const RayLineSources& sources, ViewIndex view, ViewIndex next,
                                      const Progress& progress);

/// How labels are made consistent. To add a method: an enumerator and a row of the table in
/// regularizer.cpp.
enum class Regularizer {
  None,      ///< Not at all: the most probable label of each ray. Energy and bound are 0.
  View,      ///< Within each view, whatever the others say.
  Rayspace,  ///< Within each view and along the rays through all of them.
  Wsg13,     ///< All views as one problem, coupled along the lines of EPIs.
};
[[nodiscard]] Names<Regularizer> names_of(Regularizer);

/// Whether the labels of one view depend on the others: needs the disparity of all of them, and for
/// a single view the probabilities of its neighbors.
[[nodiscard]] bool joins_views(Regularizer regularizer);

/// Labels of all views that have probabilities. Throws InvalidInput if parts of the input are
/// missing or do not fit, Cancelled. Ends each solver after its next iteration at
/// `progress.finish_requested()`.
[[nodiscard]] RayLabeling label_rays(const RayLabelingInput& input, Regularizer regularizer,
                                     const RayLabelingParameters& parameters,
                                     const Progress& progress);

/// Labels of one view, from its probabilities and other views' where available: for an
/// answer while the user paints. Throws as `label_rays`.
[[nodiscard]] RayLabeling label_view(const RayLabelingInput& input, ViewIndex view,
                                     Regularizer regularizer,
                                     const RayLabelingParameters& parameters,
                                     const Progress& progress);

/// The votes of Regularizer::Rayspace on `labels`, which are layers. With `before`, from which
/// `labels` came, only rays vote whose evidence has changed since. Painted pixels keep their
/// labels. Throws Cancelled.
void vote_in_rounds(const RayVotes& votes, const ViewStack<std::int32_t>* before,
                    const Progress& progress, ViewStack<std::int32_t>& labels);

}  // namespace episcope
