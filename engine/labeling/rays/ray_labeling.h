// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/disparity_field.h"
#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"
#include "engine/labeling/label_probabilities.h"

#include <cstdint>

namespace episcope {

/// What binds the labels of different rays to each other.
enum class LabelCoupling {
  None,   ///< Nothing: the most probable label of each.
  Views,  ///< Boundaries within each view cost their length; views know nothing of each other.
  Rays,   ///< That, and labels are constant along the rays' lines on the EPIs.
};

/// Defaults were chosen on three scenes with scribbles (a rendered still life, `demo`, `objects`;
/// forest with estimated disparity, centre view): a forest is mistaken in whole regions, sure of
/// itself, so λ must be large and the floor high, and boundaries lie where image and disparity have
/// edges. Accuracy without λ, with λ = 1, 16, 32, 64: still life 92.4, 93.1, 95.2, 95.8, 96.7 %,
/// demo 91.0, 91.4, 92.6, 93.6, 92.6 %. Under independent mistakes of single rays λ = 1 is right.
struct RayLabelingParameters {
  double smoothness = 32;     ///< λ: cost of one pixel of boundary, in units of −log p; ≥ 0.
  double floor = 0.1;         ///< Least probability taken for possible, in (0, 1].
  double gap = 2e-3;          ///< Relative duality gap at which label_view stops, > 0,
  double gap_of_many = 1e-2;  ///< and label_rays in each view.
  int max_iterations = 300;   ///< In each view.
};

/// What is known of the rays; borrowed for the call.
struct RayLabelingInput {
  const LabelProbabilities* probabilities = nullptr;
  /// Disparities of (at least) all views with probabilities; only demanded by `Rays`. `Views` is
  /// quicker with them: a view begins where the one beside it ended.
  const DisparityField* disparity = nullptr;
  /// Probability of an edge in [0, 1] of (at least) those views
  /// (engine/labeling/rays/boundary_weights.h); null or empty = no edges known.
  const ViewStack<float>* edges = nullptr;
  /// Samples of those views; only looked at by `Rays`, to tell which rays see the same. Null = the
  /// disparities are trusted.
  const LightField* light_field = nullptr;
};

struct RayLabeling {
  ViewStack<std::int32_t> labels;  ///< Ids, `[v][u][y][x]`, of the views asked for.
  double energy = 0;   ///< Of the labels of each view as its problem was solved, summed up.
  double bound = 0;    ///< No labeling has less energy in these problems.
  int iterations = 0;  ///< The most that any of its parts took.

  /// (energy − bound)/|energy|.
  [[nodiscard]] double relative_gap() const;
};

/// Labels of all views that have probabilities. The energy is that of [WSG13]: per-view
/// TV weighted by edges (J_st), variation along the lines of horizontal and vertical EPIs
/// (J_xs, J_yt) and one label for each ray, relaxed to the simplex.
///
/// `Rays` does it in two steps. Each view is solved by itself
/// (engine/solvers/simplex/simplex_labeling.h), the cost of a ray being the mean over the rays of
/// the same scene point in the nearest 5×5 views, as far as their colours agree (label_costs.h):
/// mistakes of single rays average out. Then the rays of a scene point vote twice on their label
/// along their EPIs (ray_vote.h), which makes labels constant along lines where the views left them
/// different. Views are solved in chains along rows of the grid, each beginning where the view
/// beside it ended, moved along the disparities (`Views` as well, if there are any).
///
/// Why: a finite μ has 8 floats for each ray and label, 8 GB for 9×9×512×512 with 13 labels. The
/// limit μ → ∞, one unknown for each scene point, carried from five views solved to all others, is
/// as quick, but carries labels along wrong disparities too: right / consistent, percent, of Views
/// | of that | of this: demo 256 px with estimate 93.79 / 98.98 | 93.34 / 99.41 | 93.87 / 99.25,
/// with image 95.79 / 99.29 | 95.65 / 99.63 | 95.87 / 99.52; objects 99.913 / 99.89 | 99.888
/// / 99.88 | 99.914 / 99.91; a rendered still life with estimate 96.75 / 99.37 | 96.56 / 99.52
/// | 96.76 / 99.54, with image 94.94 / 99.47 | 94.90 / 99.7 | 94.98 / 99.70. Costs averaged over
/// all 81 views or those of the ray's EPIs did no better. Energy and bound are sums over the views
/// as solved, before the vote. Throws InvalidInput if parts of the input are missing or do not fit,
/// Cancelled. Ends each solver after its next iteration at `progress.finish_requested()`.
[[nodiscard]] RayLabeling label_rays(const RayLabelingInput& input, LabelCoupling coupling,
                                     const RayLabelingParameters& parameters,
                                     const Progress& progress);

/// Labels of one view alone, from the probabilities of it and whatever other views have some: for
/// an answer while somebody paints.
[[nodiscard]] RayLabeling label_view(const RayLabelingInput& input, ViewIndex view,
                                     LabelCoupling coupling,
                                     const RayLabelingParameters& parameters,
                                     const Progress& progress);

}  // namespace episcope
