// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/labeler.h"

#include "engine/core/error.h"
#include "engine/core/parallel/parallel.h"
#include "engine/core/parallel/stopwatch.h"
#include "engine/labeling/features/label_surfaces.h"
#include "engine/labeling/features/pixel_features.h"
#include "engine/labeling/features/stroke_distance.h"
#include "engine/labeling/features/training_samples.h"
#include "engine/labeling/forest/forest.h"
#include "engine/labeling/rays/disparity_trust.h"
#include "engine/labeling/rays/edge_probability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>

namespace episcope {
namespace {

using Features = std::shared_ptr<const PixelFeatures>;

// Up to this many requested views are processed one after the other, each by all threads, and their
// features are kept: the user is painting. More are processed in parallel.
constexpr std::size_t kKeptViews = 9;

// For a single view: half the iterations give the same accuracy.
constexpr double kLiveGap = 5e-3;

ForestOptions forest_options(const LabelerParameters& parameters) {
  ForestOptions options;
  options.trees = parameters.trees;
  options.depth = parameters.depth;
  options.seed = parameters.seed;
  return options;
}

void require_views(ViewRectangle views, GridShape grid) {
  const ViewIndex last{views.first.v + views.grid.v - 1, views.first.u + views.grid.u - 1};
  if (views.grid.v > 0 && views.grid.u > 0 && grid.contains(views.first) && grid.contains(last)) {
    return;
  }
  throw InvalidInput(
      fmt::format("views {} to {} were requested, but there are {}×{} views, counted from 0",
                  view_text(views.first), view_text(last), grid.v, grid.u));
}

/// Rows of probabilities `[x][label]` into bytes `[label][x]`.
void store_row(const float* row, int pitch, VolumeView<std::uint8_t> map, int y) {
  for (int l = 0; l < map.layers; ++l) {
    std::uint8_t* out = map.row(y, l);
    for (int x = 0; x < map.width; ++x) {
      const float scaled = row[static_cast<std::ptrdiff_t>(x) * pitch + l] * 255.0F + 0.5F;
      out[x] = static_cast<std::uint8_t>(std::min(scaled, 255.0F));
    }
  }
}

/// Edges of colour that a path along a surface should not cross.
std::vector<Image<float>> color_guides(VolumeView<const float> features) {
  std::vector<Image<float>> planes;
  for (int c = 0; c < 3; ++c) {
    Image<float>& plane = planes.emplace_back(features.height, features.width);
    for (int y = 0; y < features.height; ++y) {
      std::copy_n(features.row(y, kWiderSurfaceLayer + c), features.width, plane.row(y));
    }
  }
  return planes;
}

/// What is known about the pixels of a view besides their features.
struct StrokeEvidence {
  const StrokeDistances& distances;
  double nearness = 0;
  const LabelSurfaces* surfaces = nullptr;  ///< Null = no disparity to compare.
  /// Painted on this view itself: labels there are certain. Empty = none.
  ImageView<const std::int32_t> painted{};
};

/// Certainty on the painted pixels of a row.
void keep_strokes(const std::int32_t* strokes, int width, int pitch, float* row) {
  for (int x = 0; x < width; ++x) {
    if (strokes[x] == 0) continue;
    float* p = row + static_cast<std::ptrdiff_t>(x) * pitch;
    std::fill_n(p, pitch, 0.F);
    p[strokes[x] - 1] = 1;
  }
}

ProbabilityMap predict_view(const Forest& forest, VolumeView<const float> features,
                            const StrokeEvidence& evidence, const Progress& progress) {
  ProbabilityMap map(features.height, forest.label_count(), features.width);
  const int pitch = forest.pitch();
  constexpr int kRows = 8;
  parallel_for_workers((features.height + kRows - 1) / kRows, progress, [&] {
    const std::size_t size = static_cast<std::size_t>(features.width) * pitch;
    return [&, row = std::vector<float>(size)](int item) mutable {
      const int end = std::min(features.height, (item + 1) * kRows);
      for (int y = item * kRows; y < end; ++y) {
        forest.predict_row(features, y, row.data());
        if (evidence.surfaces != nullptr) evidence.surfaces->weigh_row(y, pitch, row.data());
        evidence.distances.weigh_row(y, evidence.nearness, pitch, row.data());
        if (!evidence.painted.empty()) {
          keep_strokes(evidence.painted.row(y), features.width, pitch, row.data());
        }
        store_row(row.data(), pitch, map.view(), y);
      }
    };
  });
  return map;
}

LabelProbabilities empty_probabilities(const std::vector<std::int32_t>& ids, ViewRectangle views) {
  LabelProbabilities probabilities;
  probabilities.ids = ids;
  probabilities.grid = views.grid;
  probabilities.first = views.first;
  probabilities.views.resize(static_cast<std::size_t>(views.grid.count()));
  return probabilities;
}

bool covers(const ViewStack<float>& maps, ViewRectangle views) {
  const int last = views.grid.count() - 1;
  return maps.contains(views.first) && maps.contains(views.grid.view_at(last, views.first));
}

bool is_painted(const Scribbles& scribbles, ViewIndex view) {
  return std::ranges::find(scribbles.views, view, &ViewScribbles::view) != scribbles.views.end();
}

/// A forest and what it was trained on.
struct Grown {
  ForestSamples samples;
  ForestOptions options;
  Forest forest;
};

/// What was learned from strokes; borrows it.
struct Learned {
  const Scribbles& scribbles;
  const std::vector<std::int32_t>& ids;
  const LabelerParameters& parameters;
  const Forest& forest;
};

}  // namespace

struct Labeler::State {
  LightFieldPtr light_field;
  std::shared_ptr<const DisparityField> disparity;
  std::shared_ptr<const ViewStack<float>> edges;
  std::shared_ptr<const ViewStack<float>> confidence;
  bool has_own_edges = false;  // Computed here, with or without disparity as `set` says.
  PixelFeatureSet set;
  std::deque<std::pair<ViewIndex, Features>> kept;  // The newest last.
  Grown grown;

  void use(PixelFeatureSet wanted) {
    if (wanted.with_disparity == set.with_disparity) return;
    set = wanted;
    kept.clear();
    if (has_own_edges) edges = nullptr;
  }

  [[nodiscard]] Features find_features(ViewIndex view) const {
    const auto found = std::ranges::find(kept, view, &std::pair<ViewIndex, Features>::first);
    return found == kept.end() ? nullptr : found->second;
  }

  [[nodiscard]] Features compute_features(ViewIndex view, const Progress& progress) const {
    const DisparityView own =
        disparity && disparity->contains(view) ? disparity->view(view) : DisparityView{};
    return std::make_shared<const PixelFeatures>(
        compute_pixel_features(*light_field, view, own, set, progress));
  }

  /// Features of a view, kept from now on in place of the oldest ones.
  [[nodiscard]] Features keep_features(ViewIndex view, const Progress& progress) {
    if (Features found = find_features(view)) return found;
    Features computed = compute_features(view, progress);
    const std::size_t each = computed->view().size() * sizeof(float);
    while (!kept.empty() && (kept.size() + 1) * each > kKeptBytes) kept.pop_front();
    kept.emplace_back(view, computed);
    return computed;
  }

  [[nodiscard]] ForestSamples samples_of(const Scribbles& scribbles,
                                         const std::vector<std::int32_t>& ids,
                                         const Progress& progress) {
    ForestSamples samples;
    samples.label_count = static_cast<int>(ids.size());
    for (const ViewScribbles& painted : scribbles.views) {
      progress.check();
      const Features of_view = keep_features(painted.view, progress.part(0, 0));
      samples.feature_count = of_view->layers();
      append_samples(painted, of_view->view(), ids, samples);
    }
    return samples;
  }

  /// The forest for these strokes, trained only if it would differ from the last one.
  [[nodiscard]] const Forest& train(const Scribbles& scribbles,
                                    const std::vector<std::int32_t>& ids,
                                    const LabelerParameters& parameters, const Progress& progress) {
    ForestSamples samples = samples_of(scribbles, ids, progress);
    const ForestOptions options = forest_options(parameters);
    if (samples != grown.samples || options != grown.options) {
      progress.step(kTrainingStep);
      Forest forest = Forest::train(samples, options, progress);
      grown = {std::move(samples), options, std::move(forest)};
    }
    return grown.forest;
  }

  [[nodiscard]] ProbabilityMap predict_one(const Learned& learned, ViewIndex view,
                                           VolumeView<const float> features,
                                           const Progress& progress) const {
    const int labels = learned.forest.label_count();
    const Image<std::int32_t> strokes = carried_strokes(
        learned.scribbles, learned.ids, disparity.get(), view, features.height, features.width);
    const std::vector<Image<float>> colors = color_guides(features);
    StrokeGuides guides{{colors.begin(), colors.end()}};
    Image<float> filled, trust;
    std::optional<LabelSurfaces> surfaces;
    if (set.with_disparity) {
      filled = filled_disparity(disparity->view(view));
      guides.disparity = filled.view();
      if (confidence && confidence->contains(view)) trust = disparity_trust(confidence->view(view));
      guides.trust = trust.view();
      guides.surfaces = &surfaces.emplace(strokes.view(), labels, filled.view(), guides.trust);
    }
    const StrokeDistances distances(strokes, labels, guides, progress);
    StrokeEvidence evidence{distances, learned.parameters.nearness, guides.surfaces};
    if (is_painted(learned.scribbles, view)) evidence.painted = strokes.view();
    return predict_view(learned.forest, features, evidence, progress);
  }

  /// Probabilities of the views of `into` that have none yet.
  void predict(const Learned& learned, LabelProbabilities& into, const Progress& progress) {
    std::vector<ViewIndex> missing;
    for (int i = 0; i < into.grid.count(); ++i) {
      if (into.views[static_cast<std::size_t>(i)].empty()) missing.push_back(into.view_at(i));
    }
    if (missing.size() <= kKeptViews) {
      for (const ViewIndex view : missing) {
        const Features of_view = keep_features(view, progress.part(0, 0));
        into.view(view) = predict_one(learned, view, of_view->view(), progress.part(0, 0));
      }
      return;
    }
    parallel_for(static_cast<int>(missing.size()), progress, [&](int i) {
      const ViewIndex view = missing[static_cast<std::size_t>(i)];
      const Progress alone = progress.part(0, 0).on_one_thread();
      Features of_view = find_features(view);
      if (!of_view) of_view = compute_features(view, alone);
      into.view(view) = predict_one(learned, view, of_view->view(), alone);
    });
  }

  void find_edges(ViewRectangle views, const Progress& progress) {
    if (edges && covers(*edges, views)) return;
    const DisparityField none;
    const bool sees_disparity = set.with_disparity && disparity;
    edges = std::make_shared<const ViewStack<float>>(
        edge_probabilities(*light_field, views, sees_disparity ? *disparity : none, {}, progress,
                           sees_disparity ? confidence.get() : nullptr));
    has_own_edges = true;
  }

  /// Replaces the labels by regularised ones.
  void regularise(const Learned& learned, Labeling& labeling, const Progress& progress) {
    const Regularizer regularizer = learned.parameters.regularizer;
    LabelProbabilities& own = labeling.probabilities;
    ViewRectangle views{own.first, own.grid};
    // Where rays of other views agree, two of them are nearly as informative as all.
    if (own.grid.count() == 1 && info_of(regularizer).joins_views) views = neighbours(own.first);
    progress.step("finding edges");
    find_edges(views, progress.part(0, 0.05));
    RayLabelingParameters options;
    options.smoothness = learned.parameters.smoothness;
    RayLabelingInput input{&own, disparity.get(), edges.get(), light_field.get()};
    RayLabeling result;
    if (own.grid.count() > 1) {
      result = label_rays(input, regularizer, options, progress.part(0.05, 1));
    } else {
      options.gap = kLiveGap;
      LabelProbabilities around = empty_probabilities(own.ids, views);
      around.view(own.first) = std::move(own.views[0]);
      progress.step("labeling neighbouring views");
      predict(learned, around, progress.part(0.05, 0.3));
      input.probabilities = &around;
      progress.step("regularising");
      result = label_view(input, own.first, regularizer, options, progress.part(0.3, 1));
      own.views[0] = std::move(around.view(own.first));
    }
    labeling.labels = std::move(result.labels);
    labeling.gap = result.relative_gap();
  }

  /// The view and those beside it in its row; in a grid of one column, above and below.
  [[nodiscard]] ViewRectangle neighbours(ViewIndex view) const {
    const GridShape grid = light_field->grid();
    const int down = grid.u > 1 ? 0 : 1;
    const int across = 1 - down;
    const ViewIndex first{std::max(view.v - down, 0), std::max(view.u - across, 0)};
    const ViewIndex last{std::min(view.v + down, grid.v - 1),
                         std::min(view.u + across, grid.u - 1)};
    return {first, {last.v - first.v + 1, last.u - first.u + 1}};
  }
};

Labeler::Labeler(LightFieldPtr light_field, std::shared_ptr<const DisparityField> disparity,
                 std::shared_ptr<const ViewStack<float>> edges,
                 std::shared_ptr<const ViewStack<float>> confidence)
    : state_(std::make_unique<State>()) {
  state_->light_field = std::move(light_field);
  state_->disparity = std::move(disparity);
  state_->edges = std::move(edges);
  state_->confidence = std::move(confidence);
}

Labeler::~Labeler() = default;
Labeler::Labeler(Labeler&&) noexcept = default;
Labeler& Labeler::operator=(Labeler&&) noexcept = default;

Labeling Labeler::label(const Scribbles& scribbles, const LabelerParameters& parameters,
                        ViewRectangle views, const Progress& progress,
                        const std::function<void(const Labeling&)>& on_draft) {
  const Stopwatch watch;
  const LightField& lf = *state_->light_field;
  require_views(views, lf.grid());
  const std::vector<std::int32_t> ids = painted_labels(scribbles, lf);
  const Regularizer regularizer = parameters.regularizer;
  if (info_of(regularizer).joins_views && !state_->disparity) {
    throw InvalidInput(
        "labels that are consistent along rays need the disparity of all views; estimate it first, "
        "or smooth each view alone");
  }
  state_->use({uses_disparity(parameters)});

  const Learned learned{scribbles, ids, parameters,
                        state_->train(scribbles, ids, parameters, progress.part(0, 0.1))};
  progress.step(kLabelingStep);
  Labeling labeling;
  labeling.probabilities = empty_probabilities(ids, views);
  state_->predict(learned, labeling.probabilities, progress.part(0.1, 0.5));
  // Not painting: the following steps need the memory.
  if (labeling.probabilities.views.size() > kKeptViews) state_->kept.clear();
  if (regularizer == Regularizer::None || on_draft) {
    const RayLabelingInput input{&labeling.probabilities, nullptr, nullptr, nullptr};
    labeling.labels = label_rays(input, Regularizer::None, {}, progress.part(0.5, 0.5)).labels;
  }
  if (regularizer != Regularizer::None) {
    if (on_draft) {
      labeling.is_draft = true;
      labeling.seconds = watch.seconds();
      on_draft(labeling);
      labeling.is_draft = false;
    }
    state_->regularise(learned, labeling, progress.part(0.5, 1));
  }
  labeling.seconds = watch.seconds();
  return labeling;
}

}  // namespace episcope
