// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/schema.h"
#include "engine/labeling/ray_labeling.h"

namespace episcope {

/// How labels are made consistent. To add a method: an enumerator, two functions like
/// `smooth_views` and `smooth_view`, and a row of the table in regularizer.cpp.
enum class Regularizer {
  None,      ///< Not at all: the most probable label of each ray.
  View,      ///< Within each view, whatever the others say.
  Rayspace,  ///< Within each view and along the rays through all of them.
  Wsg13,     ///< All views as one problem, coupled along the lines of EPIs (line_smoothing.h).
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

/// Labels of one view, the cost of a ray being the mean over all views that have probabilities;
/// there is no vote.
[[nodiscard]] RayLabeling smooth_rays_of_view(const RayLabelingInput& input, ViewIndex view,
                                              const RayLabelingParameters& parameters,
                                              const Progress& progress);

}  // namespace episcope
