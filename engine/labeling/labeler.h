// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/indices.h"
#include "engine/core/isa.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/core/schema.h"
#include "engine/labeling/forest.h"
#include "engine/labeling/ray_labeling.h"
#include "engine/labeling/regularizer.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace episcope {

/// The features that the forest uses: the three sets of the archive. The caller chooses the
/// disparity; all sets but Image use it as evidence for labels.
enum class FeatureSet { Image, ImageEstimate, ImageTruth };
[[nodiscard]] Names<FeatureSet> names_of(FeatureSet);

/// Parameters of a segmentation.
struct LabelerParameters {
  FeatureSet features = FeatureSet::ImageEstimate;
  Regularizer regularizer = Regularizer::Rayspace;
  double smoothness = 32;
  double nearness = 0.35;
  int trees = 96;
  int depth = 14;
  int seed = 1;
};

[[nodiscard]] Schema<LabelerParameters> labeler_schema();

/// A segmentation of a rectangle of views.
struct Labeling {
  LabelProbabilities probabilities;  ///< Of the forest and all else, before regularization.
  /// The label of each pixel, one of `probabilities.ids`; 0 where the light field holds nothing.
  ViewStack<std::int32_t> labels;
  bool is_draft = false;  ///< Whether the labels are still to be regularized.
  double gap = 0;         ///< Relative duality gap of the regularizer.
  double seconds = 0;     ///< Wall-clock time.
  std::string note;       ///< Of many views: where they were computed; or empty.
};

/// Labels of all views that strokes are to correct; borrowed.
struct LabelCorrection {
  const Labeling& before;   ///< Of all views, with probabilities, as a `Labeler` gave them
  const Scribbles& former;  ///< for these strokes.
  ViewIndex first;          ///< The view in sight: its labels come first.
  /// Called for each view when its labels are solved, ids, from any thread, for `first` before all
  /// others. Votes may still change some.
  std::function<void(ViewIndex, Image<std::int32_t>)> on_view{};
};

/// Learns from scribbles which label each pixel of a light field has. One object serves many
/// strokes: what does not depend on them, edges and the features of views, is kept between calls
/// (features of as many views as fit into `kKeptBytes`, until many views are requested at once).
/// The forest is kept while it would be the same, and the solvers of the painted view up to 1 GiB.
///
/// A random forest (engine/labeling/forest.h) is trained on the painted pixels of all
/// painted views (of more than eight, those with most painted pixels, and any that alone has a
/// label), equally many per label, and votes on the pixels of the requested views by their
/// features (engine/labeling/pixel_features.h). Its votes are weighted by how well the
/// disparity of a pixel fits the surface of each label's strokes if the parameters ask for
/// it. With estimated disparity, a surface counts only where it agrees with the image, and not in
/// gaps of thin objects (predict_from_strokes.h). A forest knows nothing about what lies between a
/// pixel and a stroke, so votes are also weighted by how near the strokes of each label are along
/// surfaces, exp(−nearness·excess) (predict_from_strokes.h).
///
/// Painted pixels keep their labels in the view where they were painted, and smoothing bends to
/// them. Unless disparity is known to be right (it comes without confidence), the middle view is
/// smoothed first; its colors then correct labels near boundaries (reweight_by_color.h). Labels are
/// then made consistent (regularizer.h). With `rayspace`, a single view uses its rays in
/// neighboring views only, for a quick answer; all views use the rays of all.
///
/// Source: Wanner, Straehle, Goldluecke 2013 [WSG13]. The weightings are additions; what they
/// gain is in tests/accuracy/tuning.md.
///
/// Not thread-safe: a call must wait for the one in progress, or cancel it.
class Labeler {
 public:
  static constexpr std::size_t kKeptBytes = std::size_t{400} << 20;
  /// Stages as reported by `progress`; the first is skipped if the forest can be reused from the
  /// last call.
  static constexpr const char* kTrainingStep = GrownForest::kTrainingStep;
  static constexpr const char* kLabelingStep = "labeling pixels";

  /// `disparity` may be null, or cover some views only. It carries places along the rays, couples
  /// views, and speaks for labels where the parameters say so. `edges`: EDGE_WEIGHTS of all views;
  /// null = computed, from disparity as well where that is a feature.
  /// `confidence` of the disparity, in [0, 1], of the same views; null = it is right everywhere.
  Labeler(LightFieldPtr light_field, std::shared_ptr<const DisparityField> disparity,
          std::shared_ptr<const ViewStack<float>> edges = nullptr,
          std::shared_ptr<const ViewStack<float>> confidence = nullptr);
  ~Labeler();
  Labeler(Labeler&&) noexcept;
  Labeler& operator=(Labeler&&) noexcept;

  /// Where the forest votes and labels are smoothed if many views are asked for at once, from the
  /// next call on. Auto, as at first, takes a GPU if there is one, and the CPU if that fails.
  void compute_on(Device device);

  /// Segments `views`. Labels are those painted anywhere; names and colors in `scribbles` are not
  /// needed. `on_draft`, if given, is called on the calling thread with the labels before
  /// regularization, if there is any to come; of a few views, a third of the trees voted for them.
  /// The result depends neither on the number of threads nor on earlier calls, but for a single
  /// view with `on_draft`, whose labels are smoothed from where the last call for it ended, to the
  /// same gap. Throws InvalidInput
  /// if fewer than two labels are painted, if scribbles or `views` do not fit the light field, or
  /// if disparity is needed and a view lacks it; Unavailable if a GPU was demanded and fails;
  /// Cancelled, within 200 ms.
  [[nodiscard]] Labeling label(const Scribbles& scribbles, const LabelerParameters& parameters,
                               ViewRectangle views, const Progress& progress,
                               const std::function<void(const Labeling&)>& on_draft = {});

  /// Corrects labels of all views after strokes on some of them, in a fraction of the time of
  /// `label`: where the strokes say something new in a view in which they were painted (`news_of`),
  /// the new probabilities are carried along the rays to all views, and only rays near those are
  /// solved again (`correct_rays`); all others keep their labels. The energy that is minimized, its
  /// gap and the votes are those of `label`. Only `label` lets the new strokes judge places that
  /// none of these views shows. New strokes in more than four views at once, as of a fill of all
  /// views, are read in `first` alone, or in the view that has most.
  ///
  /// None if that cannot be: without disparity of all views, with a regularizer other than
  /// Rayspace, without probabilities in `before`, or if a label has lost all its strokes. Throws as
  /// `label`.
  [[nodiscard]] std::optional<Labeling> correct(const Scribbles& scribbles,
                                                const LabelerParameters& parameters,
                                                const LabelCorrection& correction,
                                                const Progress& progress);
  /// Computes ahead what `correct` needs besides new strokes. Throws as `label`.
  void prepare_correction(const Scribbles& scribbles, const LabelerParameters& parameters,
                          ViewIndex view, const Progress& progress);

  /// Labels of all views from probabilities that are known already: what `label` does after the
  /// forest. Pixels painted in `scribbles` keep their labels. `features` of the parameters says
  /// whether disparity makes edges. Throws InvalidInput if they do not cover all views, or if rays
  /// are to be joined without disparity; Cancelled.
  [[nodiscard]] Labeling smooth(LabelProbabilities probabilities, const Scribbles& scribbles,
                                const LabelerParameters& parameters, const Progress& progress);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace episcope
