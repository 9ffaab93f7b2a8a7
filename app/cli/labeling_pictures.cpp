// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/labeling_pictures.h"

#include "engine/core/error.h"
#include "engine/io/labels/labeling_file.h"
#include "engine/render/shade.h"

#include <algorithm>
#include <cmath>

namespace episcope::cli {
namespace {

ViewIndex shown_view(const io::LabelingFile& file, const std::string& name,
                     const PictureOptions& options) {
  const ViewIndex middle = file.grid().center();
  const ViewIndex view =
      options.view.value_or(ViewIndex{file.first().v + middle.v, file.first().u + middle.u});
  if (!file.contains(view)) {
    throw InvalidInput(name + " has labels of " + std::to_string(file.grid().v) + "×" +
                       std::to_string(file.grid().u) + " views from view " +
                       view_text(file.first()) + " on, but view " + view_text(view) +
                       " was asked for");
  }
  return view;
}

Picture labels_picture(const io::LabelingFile& file, ViewIndex view) {
  const Image<std::int32_t> labels = file.labels(view);
  Picture picture = render::shade_labels(labels.view());
  for (int y = 0; y < labels.height(); ++y) {
    for (int x = 0; x < labels.width(); ++x) {
      const auto known = std::ranges::find(file.infos(), labels.at(y, x), &LabelInfo::id);
      if (known == file.infos().end()) continue;
      std::copy(known->color.begin(), known->color.end(), &picture.at(y, x));
    }
  }
  return picture;
}

Image<float> probability_of(const Image<float>& probabilities, std::ptrdiff_t layer) {
  Image<float> map(probabilities.height(), probabilities.width());
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      map.at(y, x) = probabilities.at(y, x, static_cast<int>(layer));
    }
  }
  return map;
}

// Entropy over that of equal probabilities.
Image<float> uncertainty_of(const Image<float>& probabilities) {
  Image<float> map(probabilities.height(), probabilities.width());
  const float full = std::log(static_cast<float>(std::max(probabilities.channels(), 2)));
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      float entropy = 0;
      for (int l = 0; l < probabilities.channels(); ++l) {
        const float p = probabilities.at(y, x, l);
        if (p > 0) entropy -= p * std::log(p);
      }
      map.at(y, x) = std::clamp(entropy / full, 0.F, 1.F);
    }
  }
  return map;
}

std::ptrdiff_t layer_of(const io::LabelingFile& file, const std::string& name, int label) {
  const auto found = std::ranges::find(file.infos(), label, &LabelInfo::id);
  if (found != file.infos().end()) return found - file.infos().begin();
  std::string known;
  for (const LabelInfo& info : file.infos()) {
    known += (known.empty() ? "" : ", ") + std::to_string(info.id);
  }
  throw InvalidInput(name + " has no label " + std::to_string(label) + "; it has " + known);
}

}  // namespace

Picture labeling_picture(const std::filesystem::path& path, const std::string& what,
                         const PictureOptions& options) {
  const std::string name = path.string();
  const io::LabelingFile file(path);
  const ViewIndex view = shown_view(file, name, options);
  if (what == "labels") return labels_picture(file, view);
  if (!file.has_probabilities()) {
    throw InvalidInput(name + " has no probabilities; write it without --no-probabilities");
  }
  const Image<float> probabilities = file.probabilities(view);
  const Image<float> map = what == "uncertainty"
                               ? uncertainty_of(probabilities)
                               : probability_of(probabilities, layer_of(file, name, options.label));
  render::Shading shading = render::default_shading(render::Quantity::Confidence, {});
  if (!options.color_map.empty()) shading.map = render::color_map(options.color_map);
  if (options.range) shading.range = *options.range;
  return render::shade(map.view(), {}, shading);
}

}  // namespace episcope::cli
