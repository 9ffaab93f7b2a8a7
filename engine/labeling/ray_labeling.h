// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "engine/core/isa.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/labeling/ray_targets.h"

#include <array>
#include <cstdint>
#include <vector>

namespace episcope {

/// Probability of each label for every pixel of one view, `[y][label][x]`, 0 … 255 for 0 … 1,
/// labels in the order of `LabelProbabilities::ids`. 13 labels of 9×9×768×768 rays take 0.6 GB.
using ProbabilityMap = Volume<std::uint8_t>;

/// Label probabilities of a rectangle of views. Move-only.
struct LabelProbabilities {
  std::vector<std::int32_t> ids;      ///< The label of each layer, ascending.
  GridShape grid;                     ///< Views covered,
  ViewIndex first;                    ///< beginning here: one view alone is a grid of 1×1.
  std::vector<ProbabilityMap> views;  ///< `[v][u]`

  [[nodiscard]] bool empty() const { return views.empty(); }
  [[nodiscard]] bool contains(ViewIndex view) const {
    return !empty() && grid.contains({view.v - first.v, view.u - first.u});
  }
  /// The view whose map is `views[index]`.
  [[nodiscard]] ViewIndex view_at(int index) const { return grid.view_at(index, first); }
  /// Precondition: `contains(view)`.
  [[nodiscard]] const ProbabilityMap& view(ViewIndex view) const { return views[index(view)]; }
  [[nodiscard]] ProbabilityMap& view(ViewIndex view) { return views[index(view)]; }

 private:
  [[nodiscard]] std::size_t index(ViewIndex view) const {
    return static_cast<std::size_t>(view.v - first.v) * grid.u + (view.u - first.u);
  }
};

/// Probabilities of these views and ids, not yet filled.
[[nodiscard]] LabelProbabilities empty_probabilities(const std::vector<std::int32_t>& ids,
                                                     ViewRectangle views);

/// The most probable label of each pixel, `[y][x]`; of equals the lowest id. `ids` names the
/// layers. Throws InvalidInput unless there is one id for each layer.
[[nodiscard]] Image<std::int32_t> most_probable_labels(VolumeView<const std::uint8_t> probabilities,
                                                       const std::vector<std::int32_t>& ids);

/// Uncertainty of the labels of each pixel, `[y][x]` in [0, 1]: the entropy of its probabilities
/// relative to the entropy of equal ones. 0 with a single label.
[[nodiscard]] Image<float> label_uncertainty(VolumeView<const std::uint8_t> probabilities);

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
