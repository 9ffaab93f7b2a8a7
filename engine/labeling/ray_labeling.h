// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/image.h"
#include "engine/core/isa.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/labeling/label_probabilities.h"
#include "engine/labeling/ray_targets.h"

#include <array>
#include <cstdint>
#include <vector>

namespace episcope {

/// The defaults suit a forest: it errs with confidence in whole regions, so λ must be large and the
/// floor high, and boundaries lie where image and disparity have edges (tests/accuracy/tuning.md).
/// For independent errors of single rays λ = 1 is appropriate.
struct RayLabelingParameters {
  double smoothness = 32;       ///< λ: cost of one pixel of boundary, in units of −log p; ≥ 0.
  double coherence = 3;         ///< μ: cost of a label that changes along a line, likewise; ≥ 0.
  double floor = 0.05;          ///< Probabilities below are raised to this, in (0, 1].
  double gap = 2e-3;            ///< Relative duality gap at which label_view stops, > 0,
  double gap_all_views = 1e-2;  ///< and label_rays in each view,
  double gap_joint = 4e-3;      ///< or of all views where they are one problem.
  int max_iterations = 300;     ///< In each view, or of all together.
  /// Where label_rays computes, for all views and one problem a view; Auto = on the CPU.
  Device device = Device::Cpu;
};

class KeptSolver;

/// What is known about the rays; borrowed for the call.
struct RayLabelingInput {
  const LabelProbabilities* probabilities = nullptr;
  /// Disparities of (at least) all views with probabilities; required only where views are coupled.
  /// Without coupling they speed up the solution: a view starts from the result of its neighbor.
  const DisparityField* disparity = nullptr;
  /// Probability of an edge in [0, 1] of (at least) those views
  /// (engine/labeling/edge_probability.h); null or empty = no edges known.
  const ViewStack<float>* edges = nullptr;
  /// Samples of those views; used only where views are coupled, to tell which rays see the same
  /// point. Null = the disparities are trusted.
  const LightField* light_field = nullptr;
  /// Of label_view with one problem a view: begins where the last call with it ended, so that
  /// labels depend on that within the gap. Null = afresh.
  KeptSolver* kept = nullptr;
};

struct RayLabeling {
  ViewStack<std::int32_t> labels;  ///< Ids, `[v][u][y][x]`, of the requested views.
  double energy = 0;   ///< Of the labels of each view as its problem was solved, summed up.
  double bound = 0;    ///< No labeling has less energy in these problems.
  int iterations = 0;  ///< The most that any of its parts took.

  /// (energy − bound)/|energy|.
  [[nodiscard]] double relative_gap() const;
};

/// Room for the labels of all views that have probabilities, and of one of them.
[[nodiscard]] RayLabeling unlabeled(const LabelProbabilities& probabilities);
[[nodiscard]] RayLabeling unlabeled(const LabelProbabilities& probabilities, ViewIndex view);

/// −log max(p, floor) of each probability as it is stored, 0 … 255.
using CostTable = std::array<float, 256>;
[[nodiscard]] CostTable cost_table(double floor);

/// Costs `[y][label][x]` of the labels of one view by its own probabilities. `costs` has their
/// shape.
void fill_costs(VolumeView<const std::uint8_t> probabilities, const CostTable& table,
                VolumeView<float> costs);

/// Side of the square of views that are nearest to one.
inline constexpr int kNearViews = 5;

/// Which rays of a scene point contribute.
enum class TrackViews {
  All,   ///< Those of all views.
  Near,  ///< Those of the nearest kNearViews² views.
};

/// What fill_track_costs gathers from: everything is borrowed.
struct TrackSources {
  const LabelProbabilities& probabilities;
  const DisparityField& disparity;
  ViewIndex view;
  TrackViews others = TrackViews::All;
  const RayColors* colors = nullptr;  ///< Null = all rays are trusted.
};

/// Costs of the labels of one view, each the mean of the costs of the ray itself and of the rays of
/// the same scene point in other views that have probabilities and disparity
/// (engine/labeling/ray_targets.h), weighted by the trust in their colors. The floor of the
/// table limits the influence of a single stray ray. `costs` has the shape of the view's
/// probabilities. Rows are processed in parallel. Precondition: probabilities and disparity hold
/// the view. Throws Cancelled.
void fill_track_costs(const TrackSources& sources, const CostTable& table, const Progress& progress,
                      VolumeView<float> costs);

/// One probability for each pixel, `[y][x]`: of one per direction (two channels) the larger one.
[[nodiscard]] Image<float> larger_edge_probability(ImageView<const float> edge_probability);

/// Weights g of boundaries between labels, `[y][x]` in [kMinBoundaryWeight, 1]: 1 − the
/// larger probability of an edge.
inline constexpr float kMinBoundaryWeight = 0.02F;
[[nodiscard]] Image<float> boundary_weights(ImageView<const float> edge_probability);
/// Weights of each view that has probabilities; empty images without edges. Throws Cancelled.
[[nodiscard]] std::vector<Image<float>> boundary_weights_of(const RayLabelingInput& input,
                                                            const Progress& progress);

}  // namespace episcope
