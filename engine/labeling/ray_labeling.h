// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "engine/core/isa.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace episcope {

/// Maximum difference of disparities (px per view step) that count as the same scene point.
/// Estimates are off by about 0.05 to 0.2 px; a smaller step in depth hides less than a pixel over
/// four views.
inline constexpr float kSamePointTolerance_px = 0.25F;

/// Where the rays of row `y` of the view `from` arrive in the view that is `step` = (v, u) away
/// from it: pixel (y, x) of disparity d at (y − d·step.v, x − d·step.u), to the nearest pixel,
/// written as y'·width + x'. −1 where the ray leaves the image, where either disparity is invalid,
/// and where the pixel found has another disparity: there the point is hidden. `targets` has a
/// row's width. Precondition: both views have one size.
void find_ray_targets(const DisparityView& from, const DisparityView& to, ViewIndex step, int y,
                      std::int32_t* targets);

/// Columns of a row from `begin` to before `end`.
struct ColumnRange {
  int begin = 0, end = 0;
};
/// Columns that find_ray_targets processes at once.
inline constexpr int kRayColumns = 16;
/// Finds the targets of kRayColumns columns or more; the other `targets` stay unchanged.
void find_ray_targets(const DisparityView& from, const DisparityView& to, ViewIndex step, int y,
                      ColumnRange columns, std::int32_t* targets);
/// The columns of a row with a mark, and some beside them: ranges of kRayColumns or more, unless
/// the row is shorter.
[[nodiscard]] std::vector<ColumnRange> marked_columns(const std::uint8_t* marks, int width);

/// Compares the colors of two rays to decide whether they see the same scene point. Disparities are
/// least accurate at outlines, where a ray of the neighboring object has another color. Where noise
/// or gloss exceeds σ, rays are not coupled. Refers to samples of 8 bits directly; of others it
/// keeps a copy of a rectangle of views, rounded to 8 bits.
class RayColors {
 public:
  /// Knows nothing: all rays are trusted.
  RayColors() = default;
  /// Precondition: the light field has these views, and outlives the object. Throws Cancelled.
  RayColors(const LightField& light_field, GridShape grid, ViewIndex first,
            const Progress& progress);

  /// One row of a view, and a whole other view, to be compared.
  struct Pair {
    const std::uint8_t* row = nullptr;
    const std::uint8_t* other = nullptr;
  };
  [[nodiscard]] Pair pair(ViewIndex view, int y, ViewIndex other) const {
    if (colors_ == nullptr) return {};
    return {colors_->view(view).row(y), colors_->view(other).data};
  }

  /// exp(−|ΔI|²/2σ²) of column x and of pixel `target` = y'·width + x' of the other view, |ΔI| the
  /// difference of their colors, σ = 10/255; 0 beyond 4σ. 1 where nothing is known.
  [[nodiscard]] float trust(const Pair& pair, int x, std::int32_t target) const;
  /// Trust of many columns and their pixels, 0 where the target is −1; the other `trusts` stay
  /// unchanged.
  void trusts(const Pair& pair, ColumnRange columns, const std::int32_t* targets,
              float* trusts) const;

  /// The samples that are compared, 8 bits; null if nothing is known.
  [[nodiscard]] const ViewStack<std::uint8_t>* samples() const { return colors_; }
  /// Trust of each squared difference of colors, summed over three channels; 0 from the last on.
  static constexpr int kNoTrust = 1600;
  [[nodiscard]] const std::array<float, kNoTrust + 1>& trusts() const { return table_; }

 private:
  std::unique_ptr<const ViewStack<std::uint8_t>> rounded_;
  const ViewStack<std::uint8_t>* colors_ = nullptr;  // of the light field, or `rounded_`
  std::array<float, kNoTrust + 1> table_ = {};
};

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

/// The place of each label in `ids`, which ascend: the layer of its probabilities; 0 where there is
/// no such id. `layers` has the shape of `labels` and may be the same pixels.
void find_layers(ImageView<const std::int32_t> labels, const std::vector<std::int32_t>& ids,
                 ImageView<std::int32_t> layers);

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
struct Scribbles;

/// What is known about the rays; borrowed for the call.
struct RayLabelingInput {
  const LabelProbabilities* probabilities = nullptr;
  /// Disparities of (at least) all views with probabilities; required only where views are coupled.
  /// Without coupling they speed up the solution: a view starts from the result of its neighbor.
  const DisparityField* disparity = nullptr;
  /// Probability of an edge in [0, 1] of (at least) those views
  /// (engine/labeling/pixel_features.h); null or empty = no edges known.
  const ViewStack<float>* edges = nullptr;
  /// Samples of those views; used only where views are coupled, to tell which rays see the same
  /// point. Null = the disparities are trusted.
  const LightField* light_field = nullptr;
  /// Of label_view with one problem a view: begins where the last call with it ended, so that
  /// labels depend on that within the gap. Null = afresh.
  KeptSolver* kept = nullptr;
  /// Painted pixels keep their labels, and those around them follow. Null = nothing is painted.
  const Scribbles* strokes = nullptr;
};

/// Layers of what is painted in a view, `[y][x]`, −1 = nothing. Empty if nothing is.
[[nodiscard]] Image<std::int32_t> painted_layers(const RayLabelingInput& input, ViewIndex view);
/// What a pixel that is held pays for another label: more than all its boundaries.
[[nodiscard]] float price_of_held(double smoothness);
/// Costs of painted pixels, of which `painted` has the layers: 0, and for other labels `price`.
void hold_painted(const Image<std::int32_t>& painted, float price, VolumeView<float> costs);
/// Gives painted pixels their layers.
void keep_painted(const Image<std::int32_t>& painted, ImageView<std::int32_t> layers);

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

/// The views of the rectangle that are nearest to `view`, kNearViews² with itself, without it.
[[nodiscard]] std::vector<ViewIndex> near_views(ViewRectangle views, ViewIndex view);

/// What fill_track_costs gathers from: everything is borrowed.
struct TrackSources {
  const LabelProbabilities& probabilities;
  const DisparityField& disparity;
  ViewIndex view;
  TrackViews others = TrackViews::All;
  const RayColors* colors = nullptr;  ///< Null = all rays are trusted.
  /// `[y][x]`, 0 = any costs will do. Empty = all are wanted.
  ImageView<const std::uint8_t> wanted{};
};

/// Costs of the labels of one view, each the mean of the costs of the ray itself and of the rays of
/// the same scene point in other views that have probabilities and disparity
///, weighted by the trust in their colors. The floor of the
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
/// Weights of a view; an empty image without edges.
[[nodiscard]] Image<float> boundary_weights_of(const RayLabelingInput& input, ViewIndex view);
/// Weights of each view that has probabilities. Throws Cancelled.
[[nodiscard]] std::vector<Image<float>> boundary_weights_of(const RayLabelingInput& input,
                                                            const Progress& progress);

}  // namespace episcope
