// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/pictures.h"

#include "app/cli/input.h"
#include "app/session/scene_range.h"
#include "engine/core/error.h"
#include "engine/core/light_field/epi.h"
#include "engine/evaluation/metrics/error_maps.h"
#include "engine/io/archive/companions.h"
#include "engine/labeling/rays/boundary_weights.h"
#include "engine/render/shade.h"

#include <algorithm>

namespace episcope::cli {
namespace {

using render::Quantity;

ViewIndex view_of(const Scene& scene, const PictureOptions& options) {
  const LightField& light_field = *scene.light_field;
  const ViewIndex view = options.view.value_or(light_field.center());
  if (!light_field.grid().contains(view)) {
    throw InvalidInput(light_field.info().name + " has " + std::to_string(light_field.grid().v) +
                       "×" + std::to_string(light_field.grid().u) + " views, but view " +
                       view_text(view) + " was asked for; they count from 0");
  }
  return view;
}

InvalidInput lacks(const Scene& scene, const std::string& what) {
  return InvalidInput(scene.light_field->info().name + " has no " + what);
}

render::Shading shading(Quantity quantity, Interval disparity_range,
                        const PictureOptions& options) {
  render::Shading shading = render::default_shading(quantity, disparity_range);
  if (!options.color_map.empty()) shading.map = render::color_map(options.color_map);
  if (options.range) shading.range = *options.range;
  return shading;
}

/// As the window: the range of the scene, whatever the method, else that of the map.
Interval shown_range(const Scene* scene, Interval of_map) {
  const Interval known = scene ? known_disparity_range(*scene) : Interval{};
  return known.length() > 0 ? known : of_map;
}

/// The view to show of a result: the one asked for, else the middle of those there are.
template <class T>
ViewIndex shown_view(const ViewStack<T>& stack, const PictureOptions& options) {
  const ViewIndex middle = stack.grid().center();
  const ViewIndex view =
      options.view.value_or(ViewIndex{stack.first().v + middle.v, stack.first().u + middle.u});
  if (!stack.contains(view)) {
    throw InvalidInput("the result has " + std::to_string(stack.grid().v) + "×" +
                       std::to_string(stack.grid().u) + " views from view " +
                       view_text(stack.first()) + " on, but view " + view_text(view) +
                       " was asked for");
  }
  return view;
}

const DisparityField& chosen_layer(const PictureOptions& options, const DisparityField& first,
                                   const DisparityField& foreground,
                                   const DisparityField& background) {
  if (options.layer.empty()) return first;
  return options.layer == "background" ? background : foreground;
}

int checked_line(const char* name, int line, int count) {
  if (line >= 0 && line < count) return line;
  throw InvalidInput(std::string("there is no image ") + name + " " + std::to_string(line) +
                     "; they count from 0 to " + std::to_string(count - 1));
}

/// Repeats every row `kEpiRowHeight` times.
Picture stretched(const Picture& picture) {
  Picture tall(picture.height() * kEpiRowHeight, picture.width(), picture.channels());
  const std::size_t row_size = static_cast<std::size_t>(picture.width()) * picture.channels();
  for (int y = 0; y < tall.height(); ++y) {
    std::copy_n(picture.row(y / kEpiRowHeight), row_size, tall.row(y));
  }
  return tall;
}

Picture transposed(const Picture& picture) {
  Picture result(picture.width(), picture.height(), picture.channels());
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      std::copy_n(&picture.at(y, x), picture.channels(), &result.at(x, y));
    }
  }
  return result;
}

}  // namespace

Picture view_picture(const Scene& scene, const PictureOptions& options) {
  return render::shade_view(*scene.light_field, view_of(scene, options));
}

Picture epi_picture(const Scene& scene, const PictureOptions& options) {
  const LightField& light_field = *scene.light_field;
  const ViewIndex view = view_of(scene, options);
  if (options.column) {
    const int x = checked_line("column", *options.column, light_field.width());
    const auto epi = vertical_epi(light_field, view, x);
    return transposed(stretched(render::shade_samples(epi.view())));
  }
  const int y =
      checked_line("row", options.row.value_or(light_field.height() / 2), light_field.height());
  const auto epi = horizontal_epi(light_field, view, y);
  return stretched(render::shade_samples(epi.view()));
}

Picture truth_picture(const Scene& scene, const PictureOptions& options) {
  const GroundTruth& truth = *scene.truth;
  const ViewIndex view = view_of(scene, options);
  const DisparityField& first = truth.has_disparity() ? truth.field : truth.foreground;
  const DisparityField& field = chosen_layer(options, first, truth.foreground, truth.background);
  if (!field.contains(view)) throw lacks(scene, "true disparity in view " + view_text(view));
  const DisparityView map = field.view(view);
  const Interval range = shown_range(&scene, render::robust_range(map.disparity, map.valid));
  return render::shade(map.disparity, map.valid, shading(Quantity::Truth, range, options));
}

Picture labels_picture(const Scene& scene, const PictureOptions& options) {
  const ViewIndex view = view_of(scene, options);
  const auto& labels = scene.truth->labels;
  if (labels.empty() || !labels.contains(view)) {
    throw lacks(scene, "labels in view " + view_text(view));
  }
  return render::shade_labels(labels.view(view));
}

Picture probability_picture(const Scene& scene, const PictureOptions& options) {
  const ViewIndex view = view_of(scene, options);
  const auto found = std::find_if(
      scene.companions.begin(), scene.companions.end(),
      [](const Companion& companion) { return companion.kind.starts_with("probabilities"); });
  if (found == scene.companions.end()) throw lacks(scene, "file of label probabilities beside it");
  const io::ProbabilityFile file(found->path, scene);
  if (!file.contains(view)) throw lacks(scene, "probabilities in view " + view_text(view));
  if (options.label < 1 || options.label > file.label_count()) {
    throw InvalidInput("label " + std::to_string(options.label) +
                       " was asked for, but there are probabilities of labels 1 to " +
                       std::to_string(file.label_count()));
  }
  const Image<float> probabilities = file.view(view);
  Image<float> map(probabilities.height(), probabilities.width());
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) map.at(y, x) = probabilities.at(y, x, options.label - 1);
  }
  return render::shade(map.view(), {}, shading(Quantity::Confidence, {}, options));
}

Picture edges_picture(const Scene& scene, const DisparityField& disparity,
                      const PictureOptions& options, const Progress& progress) {
  const ViewIndex view = view_of(scene, options);
  const auto found =
      std::find_if(scene.companions.begin(), scene.companions.end(),
                   [](const Companion& companion) { return companion.kind == "edge weights"; });
  const auto shade = [&](ImageView<const float> edges) {
    return render::shade(edges, {}, shading(Quantity::Confidence, {}, options));
  };
  if (found == scene.companions.end()) {
    return shade(edge_probability(*scene.light_field, view, disparity, {}));
  }
  const ViewStack<float> stored = io::read_edge_weights(found->path, scene, progress);
  return shade(larger_edge_probability(stored.view(view)));
}

Picture disparity_picture(const Estimate& estimate, const Scene* scene,
                          const PictureOptions& options) {
  const DisparityField& field = chosen_layer(options, estimate.field, estimate.layered.foreground,
                                             estimate.layered.background);
  if (field.empty()) {
    throw InvalidInput("the result of " + estimate.method + " has no " + options.layer);
  }
  const DisparityView map = field.view(shown_view(field.disparity, options));
  const Interval range = shown_range(scene, render::robust_range(map.disparity, map.valid));
  return render::shade(map.disparity, map.valid, shading(Quantity::Disparity, range, options));
}

Picture confidence_picture(const Estimate& estimate, const PictureOptions& options) {
  if (estimate.confidence.empty()) {
    throw InvalidInput("the result of " + estimate.method + " has no confidence");
  }
  const ViewIndex view = shown_view(estimate.confidence, options);
  return render::shade(estimate.confidence.view(view), {},
                       shading(Quantity::Confidence, {}, options));
}

Picture error_picture(const Evaluation& evaluation, const PictureOptions& options) {
  return render::shade(evaluation.signed_error.view(), shown_mask(evaluation).view(),
                       shading(Quantity::SignedError, {}, options));
}

}  // namespace episcope::cli
