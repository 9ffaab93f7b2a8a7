// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/progress.h"
#include "engine/labeling/label_probabilities.h"

#include <cstdint>
#include <string>
#include <vector>

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
  double smoothness = 32;  ///< λ: cost of one pixel of boundary, in units of −log p; ≥ 0.
  double floor = 0.1;      ///< Least probability taken for possible, in (0, 1].
  double gap = 2e-3;       ///< Relative duality gap at which the solver stops, > 0.
  int max_iterations = 300;
};

/// What is known of the rays; borrowed for the call.
struct RayLabelingInput {
  const LabelProbabilities* probabilities = nullptr;
  /// Disparities of (at least) all views with probabilities; only asked for by `Rays`.
  const DisparityField* disparity = nullptr;
  /// Probability of an edge in [0, 1] of (at least) those views
  /// (engine/labeling/boundary_weights.h); null or empty = no edges known.
  const ViewStack<float>* edges = nullptr;
};

struct RayLabeling {
  ViewStack<std::int32_t> labels;  ///< Ids, `[v][u][y][x]`, of the views asked for.
  double energy = 0;   ///< Of the labels, by the problem solved: of all views, or of all tracks.
  double bound = 0;    ///< No labeling has less energy in that problem.
  int iterations = 0;  ///< The most that any of its parts took.
  std::vector<std::string> notes;  ///< A sentence each.

  /// (energy − bound)/|energy|.
  [[nodiscard]] double relative_gap() const;
};

/// Labels of all views that have probabilities. The energy is that of algorithms.md §8.3: per-view
/// TV weighted by edges (J_st), variation along the lines of horizontal and vertical EPIs
/// (J_xs, J_yt) and one label for each ray, relaxed to the simplex [WSG13].
///
/// `Rays` solves it in the limit μ → ∞, where labels are constant along each line: all rays of a
/// scene point, found through the disparities with a check of visibility, are one unknown, whose
/// cost is the mean over them. The problem of the middle view is solved
/// (engine/solvers/simplex_labeling.h), its labels are carried to every ray that it sees; then that
/// of the view with most rays left, with the labels carried there kept, up to five views. Rays that
/// none of them sees, about 0.05 %, and those next to a boundary, which were carried to the nearest
/// pixel, are then decided in each view by their mean costs, the view's own edges and the labels of
/// their neighbours.
/// Energy and bound are sums over the problems solved.
/// Why: a finite μ has 8 floats for each ray and label, 8 GB for 9×9×512×512 with 13 labels, and a
/// second for each iteration; this takes 20 s of processor time, 0.2 GB, and carries a certificate.
/// On a rendered still life, all views, accuracy / consistency: None 92.2 / 98.0, Views 95.8
/// / 98.9, Rays 95.8 / 99.5 %, of the exact labels 99.9 %. Where a forest is hardly ever mistaken
/// (`objects`) Views and Rays both reach 99.95 %. Throws InvalidInput if parts of the input are
/// missing or do not fit, Cancelled. Ends each solver after its next iteration at
/// `progress.finish_requested()`.
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
