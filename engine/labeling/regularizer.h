// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/core/schema.h"
#include "engine/labeling/ray_labeling.h"
#include "engine/labeling/ray_vote.h"

#include <cstdint>

namespace episcope {

/// Labels of all views that minimize the energy of [WSG13] as a whole: the costs of all rays,
/// −log p; boundaries within the views, weighted by edges (λ J_st); and μ times the weight of every
/// line of a horizontal or vertical EPI on which the label changes from one view to the next
/// (μ (J_xs + J_yt)), where the point is visible in both (`RayLines`). Relaxed to the simplex and
/// solved with a bound for the whole (engine/solvers/linked_labeling.h), to
/// `parameters.gap_joint`. Energy and bound belong to the joint problem. Throws Cancelled.
///
/// 16 bytes a ray and label and 46 a ray: 5.5 GB for 9×9×512×512 with 13 labels.
[[nodiscard]] RayLabeling smooth_lines(const RayLabelingInput& input,
                                       const RayLabelingParameters& parameters,
                                       const Progress& progress);

/// Labels of one view, solved together with all views that have probabilities, to `parameters.gap`.
[[nodiscard]] RayLabeling smooth_lines_of_view(const RayLabelingInput& input, ViewIndex view,
                                               const RayLabelingParameters& parameters,
                                               const Progress& progress);

/// The energy that `smooth_lines` minimizes, of given labels (ids) of all views that have
/// probabilities.
[[nodiscard]] double line_energy(const RayLabelingInput& input,
                                 const RayLabelingParameters& parameters,
                                 const ViewStack<std::int32_t>& labels);

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

/// How labels are made consistent. To add a method: an enumerator, two functions like
/// `smooth_views` and `smooth_view`, and a row of the table in regularizer.cpp.
enum class Regularizer {
  None,      ///< Not at all: the most probable label of each ray.
  View,      ///< Within each view, whatever the others say.
  Rayspace,  ///< Within each view and along the rays through all of them.
  Wsg13,     ///< All views as one problem, coupled along the lines of EPIs.
};
[[nodiscard]] Names<Regularizer> names_of(Regularizer);

/// A row of the table of regularizers.
struct RegularizerInfo {
  Named<Regularizer> choice;
  /// Whether the labels of one view depend on the others: needs the disparity of all of them, and
  /// for a single view the probabilities of its neighbors.
  bool joins_views = false;
  /// Labels of all views that have probabilities, and of one of them.
  RayLabeling (*label_all)(const RayLabelingInput&, const RayLabelingParameters&,
                           const Progress&) = nullptr;
  RayLabeling (*label_one)(const RayLabelingInput&, ViewIndex, const RayLabelingParameters&,
                           const Progress&) = nullptr;
};

[[nodiscard]] const RegularizerInfo& info_of(Regularizer regularizer);

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

/// The most probable label of each ray of all views, and of one view, without any coupling. Energy
/// and bound are 0. Throws Cancelled.
[[nodiscard]] RayLabeling most_probable_labels_of_all(const RayLabelingInput& input,
                                                      const RayLabelingParameters& parameters,
                                                      const Progress& progress);
[[nodiscard]] RayLabeling most_probable_labels_of_view(const RayLabelingInput& input,
                                                       ViewIndex view,
                                                       const RayLabelingParameters& parameters,
                                                       const Progress& progress);

/// Labels of all views, and of one view: boundaries within a view cost their length, weighted by
/// edges (J_st of [WSG13]); views are independent. Disparities speed it up: a view then starts from
/// the result of its neighbor (solve_views). Energy and bound are sums over the views. Throws
/// Cancelled.
[[nodiscard]] RayLabeling smooth_views(const RayLabelingInput& input,
                                       const RayLabelingParameters& parameters,
                                       const Progress& progress);
[[nodiscard]] RayLabeling smooth_view(const RayLabelingInput& input, ViewIndex view,
                                      const RayLabelingParameters& parameters,
                                      const Progress& progress);

/// Labels of all views that are consistent along the rays. The energy of [WSG13] has per-view TV
/// weighted by edges (J_st), variation along the lines of horizontal and vertical EPIs (J_xs, J_yt)
/// and one label per ray, relaxed to the simplex.
///
/// It is minimized in two steps. Each view is solved alone
/// (engine/solvers/simplex_labeling.h), the cost of a ray being the mean over the rays of
/// the same scene point in the nearest 5×5 views, where their colors agree (`fill_track_costs`):
/// errors of single rays average out. Then the rays of a scene point vote twice on their label
/// along their EPIs (ray_vote.h), which makes labels constant along lines where the views had left
/// them different.
///
/// Why: a finite μ needs 8 floats per ray and label, 8 GB for 9×9×512×512 with 13 labels. The limit
/// μ → ∞, one unknown per scene point, carried from five views to all others, is as quick but also
/// carries labels along wrong disparities (tests/accuracy/tuning.md).
/// Energy and bound are sums over the views as solved, before the vote. Throws Cancelled.
[[nodiscard]] RayLabeling smooth_rays(const RayLabelingInput& input,
                                      const RayLabelingParameters& parameters,
                                      const Progress& progress);

/// The votes of `smooth_rays` on `labels`, which are layers. With `before`, from which `labels`
/// came, only rays vote whose evidence has changed since. Painted pixels keep their labels. Throws
/// Cancelled.
void vote_in_rounds(const RayVotes& votes, const ViewStack<std::int32_t>* before,
                    const Progress& progress, ViewStack<std::int32_t>& labels);

/// Labels of one view, the cost of a ray being the mean over all views that have probabilities;
/// there is no vote.
[[nodiscard]] RayLabeling smooth_rays_of_view(const RayLabelingInput& input, ViewIndex view,
                                              const RayLabelingParameters& parameters,
                                              const Progress& progress);

}  // namespace episcope
