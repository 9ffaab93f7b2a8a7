// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/scene_files.h"

#include "engine/evaluation/metrics/error_maps.h"
#include "engine/io/grid/image_file.h"
#include "engine/render/shade.h"

#include <algorithm>

namespace episcope {
namespace {

using render::Quantity;

std::string in_scene(const std::string& scene, const std::string& file) {
  return "scenes/" + scene + "/" + file;
}

void write_map(const std::filesystem::path& path, const DisparityView& view, Quantity quantity,
               Interval range) {
  if (!(range.length() > 0)) range = render::robust_range(view.disparity, view.valid);
  const Image<std::uint8_t> picture =
      render::shade(view.disparity, view.valid, render::default_shading(quantity, range));
  io::write_png(path, picture.view());
}

template <class T>
ViewStack<T> one_view(const ViewStack<T>& stack, ViewIndex view) {
  if (stack.empty() || !stack.contains(view)) return {};
  ViewStack<T> one({1, 1}, stack.height(), stack.width(), stack.channels(), view);
  const auto from = stack.view(view);
  std::copy_n(from.data, from.size(), one.data());
  return one;
}

DisparityField one_view(const DisparityField& field, ViewIndex view) {
  return {one_view(field.disparity, view), one_view(field.valid, view)};
}

}  // namespace

std::string scene_file(const std::string& scene, const std::string& what) {
  return in_scene(scene, what + ".png");
}

std::string picture_file(const std::string& scene, const std::string& entry,
                         const std::string& what) {
  return in_scene(scene, entry + "-" + what + ".png");
}

std::string map_file(const std::string& scene, const std::string& entry) {
  return in_scene(scene, entry + ".h5");
}

bool write_scene_pictures(const std::filesystem::path& folder, const std::string& name,
                          const Scene& scene, Interval range) {
  const ViewIndex center = scene.light_field->center();
  io::write_png(folder / scene_file(name, "view"),
                render::shade_view(*scene.light_field, center).view());
  const GroundTruth& truth = *scene.truth;
  const DisparityField& field = truth.has_disparity() ? truth.field : truth.foreground;
  if (!field.contains(center)) return false;
  write_map(folder / scene_file(name, "truth"), field.view(center), Quantity::Truth, range);
  return true;
}

std::vector<std::string> write_pictures(const std::filesystem::path& folder,
                                        const std::string& scene, const std::string& entry,
                                        const DisparityView& view, const Evaluation* evaluation,
                                        Interval range) {
  std::vector<std::string> files{picture_file(scene, entry, "disparity")};
  write_map(folder / files.front(), view, Quantity::Disparity, range);
  if (!evaluation) return files;
  files.push_back(picture_file(scene, entry, "error"));
  const Image<std::uint8_t> picture =
      render::shade(evaluation->signed_error.view(), shown_mask(*evaluation).view(),
                    render::default_shading(Quantity::SignedError, {}));
  io::write_png(folder / files.back(), picture.view());
  return files;
}

Estimate center_of(const Estimate& estimate, ViewIndex center) {
  Estimate one;
  one.field = one_view(estimate.field, center);
  one.confidence = one_view(estimate.confidence, center);
  one.layered.foreground = one_view(estimate.layered.foreground, center);
  one.layered.background = one_view(estimate.layered.background, center);
  one.layered.layers = one_view(estimate.layered.layers, center);
  one.method = estimate.method;
  one.parameters = estimate.parameters;
  one.range = estimate.range;
  one.seconds = estimate.seconds;
  one.version = estimate.version;
  one.source = estimate.source;
  one.source_hash = estimate.source_hash;
  one.notes = estimate.notes;
  if (estimate.field.disparity.grid().count() > 1) {
    one.notes.emplace_back("the seconds are those of all views");
  }
  return one;
}

}  // namespace episcope
