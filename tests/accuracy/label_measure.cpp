// SPDX-License-Identifier: BSD-3-Clause
#include "tests/accuracy/label_measure.h"
#include "engine/disparity/registry.h"

#include "app/session/run_estimator.h"
#include "engine/core/progress.h"
#include "engine/io/models/result_file.h"
#include "engine/labeling/label_review.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

namespace episcope::accuracy {
namespace {

ViewStack<std::int32_t> truth_of(const Scene& scene, const Scribbles& strokes) {
  std::map<std::int32_t, bool> is_painted;
  for (const std::int32_t label : strokes.views[0].labels) is_painted[label] = label > 0;
  ViewStack<std::int32_t> truth = scene.truth->labels.clone();
  std::for_each(truth.data(), truth.data() + truth.size(), [&](std::int32_t& label) {
    if (!is_painted[label]) label = 0;
  });
  return truth;
}

std::filesystem::path kept_file(const PaintedScene& painted, const DisparitySource& source) {
  const LightField& lf = *painted.scene.light_field;
  return source.kept / fmt::format("{}-{}x{}-{}.h5", file_stem(painted.name), lf.width(),
                                   lf.height(), source.method);
}

}  // namespace

std::string file_stem(std::string scene) {
  std::ranges::replace_if(
      scene, [](unsigned char c) { return std::isalnum(c) == 0 && c != '-'; }, '_');
  return scene;
}

PaintedScene paint_scene(const std::string& name, StrokeStyle style, Scene scene) {
  Scribbles strokes;
  if (style == StrokeStyle::Stored) {
    strokes = std::move(scene.scribbles);
  } else {
    const ViewIndex center = scene.light_field->center();
    strokes.views.push_back({center, simulated_strokes(scene.truth->labels.view(center), style)});
  }
  ViewStack<std::int32_t> truth = truth_of(scene, strokes);
  return {name, std::move(scene), std::move(strokes), std::move(truth)};
}

MeasuredLabels measure_labels(const PaintedScene& painted, const LabelerParameters& parameters,
                              const LabelingDisparity& disparity, bool center_only) {
  const LightField& lf = *painted.scene.light_field;
  const ViewRectangle all{{0, 0}, lf.grid()};
  const ViewRectangle center{lf.center(), {1, 1}};
  const Stopwatch watch;
  Labeler labeler(painted.scene.light_field, disparity.field, nullptr, disparity.confidence());
  const Labeling labeling =
      labeler.label(painted.strokes, parameters, center_only ? center : all, Progress());
  MeasuredLabels measured;
  measured.seconds = watch.seconds();
  measured.quality = judge_label_quality(labeling.labels, painted.truth, Progress());
  if (!center_only) {
    measured.consistency =
        label_consistency(labeling.labels, painted.scene.truth->field, Progress()).share();
  }
  return measured;
}

LabelingDisparity disparity_for(const PaintedScene& painted, FeatureSet features,
                                const DisparitySource& source) {
  LabelerParameters parameters;
  parameters.features = features;
  const std::filesystem::path file =
      source.kept.empty() || features == FeatureSet::ImageTruth ? "" : kept_file(painted, source);
  if (features != FeatureSet::ImageTruth && (file.empty() || !std::filesystem::exists(file))) {
    const EstimatePtr estimate =
        source.method == kLabelingEstimator
            ? estimate_for_labels(painted.scene, Device::Auto, Progress())
            : run_estimator(painted.scene, find_estimator(source.method), {}, {}, Progress())
                  .estimate;
    if (!file.empty()) io::write_result(file, *estimate, Progress());
    return {{estimate, &estimate->field}, source.method, estimate};
  }
  return find_labeling_disparity(painted.scene, parameters, file, Progress());
}

}  // namespace episcope::accuracy
