// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/scene_files.h"

#include "app/session/picture.h"
#include "app/session/scene_summary.h"
#include "engine/io/base/image_file.h"
#include "engine/render/shade.h"

#include <algorithm>

namespace episcope {
namespace {

using render::Quantity;

std::string in_scene(const std::string& scene, const std::string& file) {
  return "scenes/" + scene + "/" + file;
}

void write_map(const std::filesystem::path& path, const MapSource& source, Interval range) {
  io::write_picture(path,
                    map_picture(*make_map(source), shading_of(source.quantity, range)).view());
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

// Labels of the center view of a scene.
MapSource labels_source(const Scene& scene, Quantity quantity) {
  MapSource source;
  source.quantity = quantity;
  source.view = scene.light_field->center();
  source.light_field = scene.light_field;
  source.label_infos = scene.scribbles.labels;
  source.true_labels = true_labels_of(scene.truth);
  return source;
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
  io::write_picture(folder / scene_file(name, "view"),
                    render::shade_view(*scene.light_field, center).view());
  const MapSource truth{.quantity = Quantity::Truth,
                        .view = center,
                        .light_field = scene.light_field,
                        .truth = scene.truth};
  if (!reason_against(truth).empty()) return false;
  write_map(folder / scene_file(name, "truth"), truth, shown_range(range, {}));
  return true;
}

std::vector<std::string> write_pictures(const std::filesystem::path& folder,
                                        const std::string& scene, const EstimatePtr& center,
                                        const std::string& entry, const EvaluationPtr& evaluation,
                                        Interval range) {
  MapSource source{.quantity = Quantity::Disparity,
                   .view = center->field.disparity.first(),
                   .estimate = center,
                   .evaluation = evaluation};
  std::vector<std::string> files{picture_file(scene, entry, "disparity")};
  write_map(folder / files.front(), source, shown_range(range, display_range(*center)));
  if (!evaluation) return files;
  source.quantity = Quantity::SignedError;
  files.push_back(picture_file(scene, entry, "error"));
  write_map(folder / files.back(), source, range);
  return files;
}

bool write_label_truth(const std::filesystem::path& folder, const std::string& name,
                       const Scene& scene) {
  MapSource source = labels_source(scene, Quantity::TrueLabels);
  source.truth = scene.truth;
  if (!reason_against(source).empty()) return false;
  write_map(folder / scene_file(name, "labels"), source, {});
  return true;
}

std::vector<std::string> write_label_pictures(const std::filesystem::path& folder,
                                              const std::string& name, const Scene& scene,
                                              const LabelingPtr& labeling,
                                              const std::string& entry) {
  MapSource source = labels_source(scene, Quantity::Segmentation);
  source.labeling = labeling;
  std::vector<std::string> files{picture_file(name, entry, "labels")};
  write_map(folder / files.front(), source, {});
  source.quantity = Quantity::WrongLabels;
  if (!reason_against(source).empty()) return files;
  files.push_back(picture_file(name, entry, "wrong"));
  write_map(folder / files.back(), source, {});
  return files;
}

Estimate center_of(const Estimate& estimate, ViewIndex center) {
  Estimate one;
  one.field = one_view(estimate.field, center);
  one.confidence = one_view(estimate.confidence, center);
  one.layered.foreground = one_view(estimate.layered.foreground, center);
  one.layered.background = one_view(estimate.layered.background, center);
  one.layered.layers = one_view(estimate.layered.layers, center);
  one.second = one_view(estimate.second, center);
  one.set_provenance(estimate.provenance());
  if (estimate.field.disparity.grid().count() > 1) {
    one.notes.emplace_back("the seconds are those of all views");
  }
  return one;
}

}  // namespace episcope
