// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/labeler.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/labeling/forest.h"
#include "engine/labeling/pixel_features.h"
#include "engine/labeling/training_samples.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <utility>

namespace episcope {
namespace {

using Features = std::shared_ptr<const PixelFeatures>;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

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
  throw InvalidInput("views " + view_text(views.first) + " to " + view_text(last) +
                     " were asked for, but there are " + std::to_string(grid.v) + "×" +
                     std::to_string(grid.u) + "; they count from 0");
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

}  // namespace

struct Labeler::State {
  LightFieldPtr light_field;
  std::shared_ptr<const DisparityField> disparity;
  PixelFeatureSet set;
  std::map<std::pair<int, int>, Features> kept;  // By view.

  [[nodiscard]] bool fits_another() const {
    const std::size_t each = kept.empty() ? 0 : kept.begin()->second->view().size() * sizeof(float);
    return (kept.size() + 1) * each <= kKeptBytes;
  }

  [[nodiscard]] Features compute(ViewIndex view) const {
    const DisparityView own =
        disparity && disparity->contains(view) ? disparity->view(view) : DisparityView{};
    return std::make_shared<const PixelFeatures>(
        compute_pixel_features(*light_field, view, own, set));
  }

  void use(PixelFeatureSet wanted) {
    if (wanted.with_disparity != set.with_disparity) kept.clear();
    set = wanted;
  }

  /// Features of a view, kept from now on if there is room.
  [[nodiscard]] Features features(ViewIndex view) {
    const auto found = kept.find({view.v, view.u});
    if (found != kept.end()) return found->second;
    Features computed = compute(view);
    if (fits_another()) kept.emplace(std::pair(view.v, view.u), computed);
    return computed;
  }

  [[nodiscard]] Forest train(const Scribbles& scribbles, const std::vector<std::int32_t>& ids,
                             const LabelerParameters& parameters, const Progress& progress) {
    ForestSamples samples;
    samples.label_count = static_cast<int>(ids.size());
    for (const ViewScribbles& painted : scribbles.views) {
      progress.check();
      const Features of_view = features(painted.view);
      samples.feature_count = of_view->layers();
      append_samples(painted, of_view->view(), ids, samples);
    }
    return Forest::train(samples, forest_options(parameters), progress);
  }

  void predict_view(const Forest& forest, ViewIndex view, Labeling& labeling,
                    const Progress& progress) {
    const Features of_view = features(view);
    const VolumeView<const float> rows = of_view->view();
    ProbabilityMap& map = labeling.probabilities.view(view);
    map = ProbabilityMap(rows.height, forest.label_count(), rows.width);
    constexpr int kRows = 8;
    parallel_for_workers((rows.height + kRows - 1) / kRows, progress, [&] {
      return [&, row = std::vector<float>(static_cast<std::size_t>(rows.width) * forest.pitch())](
                 int item) mutable {
        const int end = std::min(rows.height, (item + 1) * kRows);
        for (int y = item * kRows; y < end; ++y) {
          forest.predict_row(rows, y, row.data());
          store_row(row.data(), forest.pitch(), map.view(), y);
        }
      };
    });
    const Image<std::int32_t> labels = most_probable_labels(map.view(), labeling.probabilities.ids);
    std::copy(labels.begin(), labels.end(), labeling.labels.view(view).data);
  }
};

Schema<LabelerParameters> labeler_schema() {
  Schema<LabelerParameters> schema;
  schema
      .choice(
          "features", &LabelerParameters::features,
          {"Features", "What the forest sees of a pixel: the image alone, or disparity as well"},
          {"image", "image+estimate", "image+truth"})
      .choice("regularizer", &LabelerParameters::regularizer,
              {"Smoothing",
               "How labels are made consistent: not at all, view by view, or along "
               "the rays of all views"},
              {"none", "view", "rayspace"})
      .integer("trees", &LabelerParameters::trees, {"Trees", "Trees of the forest"}, {4, 500})
      .integer("depth", &LabelerParameters::depth, {"Depth", "Depth of a tree at most"}, {1, 25})
      .integer("seed", &LabelerParameters::seed,
               {"Seed", "Of the random numbers that the forest is grown with"}, {0, 1000000});
  return schema;
}

bool uses_disparity(const LabelerParameters& parameters) {
  return parameters.features != "image";
}

Labeler::Labeler(LightFieldPtr light_field, std::shared_ptr<const DisparityField> disparity)
    : state_(std::make_unique<State>()) {
  state_->light_field = std::move(light_field);
  state_->disparity = std::move(disparity);
}

Labeler::~Labeler() = default;
Labeler::Labeler(Labeler&&) noexcept = default;
Labeler& Labeler::operator=(Labeler&&) noexcept = default;

Labeling Labeler::label(const Scribbles& scribbles, const LabelerParameters& parameters,
                        ViewRectangle views, const Progress& progress,
                        const std::function<void(const Labeling&)>&) {
  const auto start = std::chrono::steady_clock::now();
  const LightField& lf = *state_->light_field;
  require_views(views, lf.grid());
  if (parameters.regularizer != "none") {
    throw Unavailable("labels cannot be regularised yet; use --regularizer none");
  }
  Labeling labeling;
  labeling.probabilities.ids = painted_labels(scribbles, lf);
  labeling.probabilities.grid = views.grid;
  labeling.probabilities.first = views.first;
  labeling.probabilities.views.resize(static_cast<std::size_t>(views.grid.count()));
  labeling.labels = ViewStack<std::int32_t>(views.grid, lf.height(), lf.width(), 1, views.first);

  state_->use({uses_disparity(parameters)});
  progress.step("training the forest");
  const Forest forest =
      state_->train(scribbles, labeling.probabilities.ids, parameters, progress.part(0, 0.1));
  progress.step("labeling pixels");
  for (int i = 0; i < views.grid.count(); ++i) {
    const ViewIndex view{views.first.v + i / views.grid.u, views.first.u + i % views.grid.u};
    const double count = views.grid.count();
    state_->predict_view(forest, view, labeling,
                         progress.part(0.1 + 0.9 * i / count, 0.1 + 0.9 * (i + 1) / count));
  }
  labeling.seconds = seconds_since(start);
  return labeling;
}

}  // namespace episcope
