// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/labeling/labeler.h"
#include "engine/scenes/recipes.h"
#include "tests/cuda/label_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace episcope::cuda_tests {
namespace {

Scribbles strokes_of(const Scene& scene) {
  const ViewIndex center = scene.light_field->center();
  Scribbles strokes;
  strokes.views.push_back({center, scenes::scribble(scene.truth->labels.view(center))});
  return strokes;
}

}  // namespace

LabelRun whole_labeler(const Scene& scene) {
  const auto strokes = std::make_shared<const Scribbles>(strokes_of(scene));
  const std::set<std::int32_t> labels(strokes->views[0].labels.begin(),
                                      strokes->views[0].labels.end());
  LabelRun whole;
  whole.title = fmt::format("label, {} labels", labels.size() - labels.count(0));
  whole.share = kLabelShare;
  whole.run = [&scene, strokes](Device device) {
    const std::shared_ptr<const DisparityField> disparity(scene.truth, &scene.truth->field);
    Labeler labeler(scene.light_field, disparity);
    labeler.compute_on(device);
    const Labeling labeling =
        labeler.label(*strokes, {}, {{0, 0}, scene.light_field->grid()}, Progress());
    const Image<std::int32_t>& painted = strokes->views[0].labels;
    const auto kept = labeling.labels.view(strokes->views[0].view);
    for (std::size_t i = 0; i < painted.size(); ++i) {
      if (painted.data()[i] > 0 && kept.data[i] != painted.data()[i]) {
        throw InvalidInput("a painted pixel has lost its label");
      }
    }
    std::vector<std::uint8_t> bytes(labeling.labels.size());
    std::transform(labeling.labels.data(), labeling.labels.data() + bytes.size(), bytes.begin(),
                   [](std::int32_t label) { return static_cast<std::uint8_t>(label); });
    return bytes;
  };
  return whole;
}

}  // namespace episcope::cuda_tests
