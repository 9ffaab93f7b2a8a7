// SPDX-License-Identifier: BSD-3-Clause
// Prints a Markdown table: how well light fields are labeled from simulated strokes, by features
// and regulariser.
#include "app/session/labels/labeling_inputs.h"
#include "engine/core/error.h"
#include "engine/core/parallel/stopwatch.h"
#include "engine/evaluation/metrics/label_quality.h"
#include "engine/labeling/consistency.h"
#include "tests/accuracy/scene_sets.h"
#include "tests/accuracy/strokes.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace episcope;
using namespace episcope::accuracy;

struct Request {
  std::string set = "choosing";
  std::vector<std::string> scenes;
  std::vector<std::string> regularizers;
  std::string data;
  int size = 512;
  bool center_only = false;
  bool per_label = false;
};

/// A scene with the strokes of a simulated user, and the true labels of what was painted.
struct Painted {
  std::string name;
  Scene scene;
  Scribbles strokes;
  ViewStack<std::int32_t> truth;
};

struct Row {
  LabelQuality quality;
  std::optional<double> consistency;
  double seconds = 0;
};

// Nobody can expect labels that were not painted to be found.
ViewStack<std::int32_t> truth_of(const Scene& scene, const Scribbles& strokes) {
  std::map<std::int32_t, bool> is_painted;
  for (const std::int32_t label : strokes.views[0].labels) is_painted[label] = label > 0;
  ViewStack<std::int32_t> truth = scene.truth->labels.clone();
  std::for_each(truth.data(), truth.data() + truth.size(), [&](std::int32_t& label) {
    if (!is_painted[label]) label = 0;
  });
  return truth;
}

Painted paint(const std::string& name, StrokeStyle style, Scene scene) {
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

Row judge(const Painted& painted, const LabelerParameters& parameters,
          const LabelingDisparity& disparity, bool center_only) {
  const LightField& lf = *painted.scene.light_field;
  const ViewRectangle all{{0, 0}, lf.grid()};
  const ViewRectangle center{lf.center(), {1, 1}};
  const Stopwatch watch;
  Labeler labeler(painted.scene.light_field, disparity.field);
  const Labeling labeling =
      labeler.label(painted.strokes, parameters, center_only ? center : all, Progress());
  Row row;
  row.seconds = watch.seconds();
  row.quality = judge_label_quality(labeling.labels, painted.truth, Progress());
  if (!center_only) {
    row.consistency =
        label_consistency(labeling.labels, painted.scene.truth->field, Progress()).share();
  }
  return row;
}

std::string percent(const std::optional<double>& share) {
  return share ? fmt::format("{:.2f}", 100 * *share) : std::string();
}

void print_row(const Painted& painted, const LabelerParameters& parameters, const Row& row,
               bool per_label) {
  const LabelAccuracy& all = row.quality.all;
  fmt::print("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {:.1f} |\n", painted.name,
             name_of(parameters.features), name_of(parameters.regularizer), percent(all.share()),
             percent(all.mean_share()), percent(all.mean_overlap()),
             percent(row.quality.boundaries.share()), percent(row.quality.thin_overlap()),
             percent(row.consistency), row.seconds);
  if (per_label) {
    for (const std::int32_t label : all.labels()) {
      fmt::print("|   label {} | | | {} | | {} | {} | | | |\n", label, percent(all.share(label)),
                 percent(all.overlap(label)), percent(row.quality.boundaries.share(label)));
    }
  }
  std::fflush(stdout);
}

using Means = std::map<std::pair<std::string, std::string>, std::pair<double, int>>;

LabelingDisparity disparity_for(const Scene& scene, FeatureSet features) {
  LabelerParameters parameters;
  parameters.features = features;
  return find_labeling_disparity(scene, parameters, {}, Progress());
}

void print_scene(const Painted& painted, const Request& request, Means& means) {
  const LabelingDisparity estimate = disparity_for(painted.scene, FeatureSet::ImageEstimate);
  const LabelingDisparity truth = disparity_for(painted.scene, FeatureSet::ImageTruth);
  for (const auto& features : names_of(FeatureSet{})) {
    LabelerParameters parameters;
    parameters.features = features.value;
    const LabelingDisparity& disparity =
        features.value == FeatureSet::ImageTruth ? truth : estimate;
    for (const auto& regularizer : names_of(Regularizer{})) {
      if (std::ranges::find(request.regularizers, regularizer.name) == request.regularizers.end()) {
        continue;
      }
      parameters.regularizer = regularizer.value;
      const Row row = judge(painted, parameters, disparity, request.center_only);
      print_row(painted, parameters, row, request.per_label);
      auto& [sum, count] = means[{features.name, regularizer.name}];
      sum += row.quality.all.share().value_or(0);
      ++count;
    }
  }
}

void print_table(const Request& request) {
  std::puts(
      "| scene | features | regulariser | right % | mAcc % | mIoU % | near boundaries % | thin IoU "
      "% | consistency % | s |\n"
      "|---|---|---|---:|---:|---:|---:|---:|---:|---:|");
  Means means;
  for (const SceneSet& set : read_scene_sets(EPISCOPE_LABEL_SCENES)) {
    if (set.name != request.set) continue;
    for (const SceneGroup& group : scenes_with(set, request.scenes).groups) {
      for (const std::string& name : group.scenes) {
        auto scene = open_scene_of_set(name, request.size, request.data, Progress());
        if (!scene) continue;
        print_scene(paint(name, stroke_style(group.name), std::move(*scene)), request, means);
      }
    }
  }
  for (const auto& [key, mean] : means) {
    fmt::print("| mean of {} scenes | {} | {} | {:.2f} | | | | | | |\n", mean.second, key.first,
               key.second, 100 * mean.first / mean.second);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Labels from simulated strokes, with default parameters, against the true labels.");
  Request request;
  for (const auto& regularizer : names_of(Regularizer{})) {
    request.regularizers.push_back(regularizer.name);
  }
  app.add_option("--set", request.set, "Scenes: choosing or reporting (label_scenes.json)")
      ->check(CLI::IsMember({"choosing", "reporting"}));
  app.add_option("--scenes", request.scenes, "Only scenes whose names contain one of these")
      ->delimiter(',');
  app.add_option("--regularizers", request.regularizers, "Only these")->delimiter(',');
  app.add_option("--size", request.size, "Side of the views of built-in scenes, px");
  app.add_flag("--center", request.center_only, "The centre view only");
  app.add_flag("--per-label", request.per_label, "A row for every label as well");
  app.add_option("--data", request.data, "Folder that holds the scene still_life")
      ->envname("EPISCOPE_SHARED_DATA")
      ->check(CLI::ExistingDirectory);
  CLI11_PARSE(app, argc, argv);
  try {
    print_table(request);
  } catch (const Error& error) {
    std::fprintf(stderr, "episcope_label_accuracy: %s\n", error.what());
    return 1;
  }
  return 0;
}
