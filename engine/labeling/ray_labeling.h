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

/// Labels of all views that have probabilities.
/// Throws InvalidInput if parts of the input are missing or do not fit, Cancelled. Ends each solver
/// after its next iteration at `progress.finish_requested()`.
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
