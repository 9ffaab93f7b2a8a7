// SPDX-License-Identifier: BSD-3-Clause
// Prints a Markdown table: how well light fields are labeled from simulated strokes, by features
// and regularizer.
#include "engine/core/error.h"
#include "tests/accuracy/corrections.h"
#include "tests/accuracy/label_measure.h"
#include "tests/accuracy/scene_sets.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
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
  std::vector<std::string> features;
  std::vector<std::string> regularizers;
  DisparitySource disparity;
  std::string data;
  int size = 512;
  bool center_only = false;
  bool per_label = false;
  bool corrections = false;
  std::string exported;
};

bool is_wanted(const std::vector<std::string>& names, const std::string& name) {
  return names.empty() || std::ranges::find(names, name) != names.end();
}

std::string percent(const std::optional<double>& share) {
  return share ? fmt::format("{:.2f}", 100 * *share) : std::string();
}

void print_row(const PaintedScene& painted, const LabelerParameters& parameters,
               const MeasuredLabels& row, bool per_label) {
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

/// Calls `measure(parameters, disparity)` for each set of features that is wanted.
template <class Measure>
void for_features(const PaintedScene& painted, const Request& request, const Measure& measure) {
  std::optional<LabelingDisparity> estimate, truth;
  for (const auto& features : names_of(FeatureSet{})) {
    if (!is_wanted(request.features, features.name)) continue;
    LabelerParameters parameters;
    parameters.features = features.value;
    auto& disparity = features.value == FeatureSet::ImageTruth ? truth : estimate;
    if (!disparity) disparity = disparity_for(painted, features.value, request.disparity);
    measure(parameters, *disparity);
  }
}

template <class Visit>
void for_scenes(const Request& request, const Visit& visit) {
  for (const SceneSet& set : read_scene_sets(EPISCOPE_LABEL_SCENES)) {
    if (set.name != request.set) continue;
    for (const SceneGroup& group : scenes_with(set, request.scenes).groups) {
      for (const std::string& name : group.scenes) {
        auto scene = open_scene_of_set(name, request.size, request.data, Progress());
        if (scene) visit(paint_scene(name, stroke_style(group.name), std::move(*scene)));
      }
    }
  }
}

void print_table(const Request& request) {
  std::puts(
      "| scene | features | regularizer | right % | mAcc % | mIoU % | near boundaries % | thin IoU "
      "% | consistency % | s |\n"
      "|---|---|---|---:|---:|---:|---:|---:|---:|---:|");
  Means means;
  for_scenes(request, [&](const PaintedScene& painted) {
    for_features(painted, request, [&](LabelerParameters parameters, const auto& disparity) {
      for (const auto& regularizer : names_of(Regularizer{})) {
        if (!is_wanted(request.regularizers, regularizer.name)) continue;
        parameters.regularizer = regularizer.value;
        const MeasuredLabels row =
            measure_labels(painted, parameters, disparity, request.center_only);
        print_row(painted, parameters, row, request.per_label);
        auto& [sum, count] = means[{name_of(parameters.features), regularizer.name}];
        sum += row.quality.all.share().value_or(0);
        ++count;
      }
    });
  });
  for (const auto& [key, mean] : means) {
    fmt::print("| mean of {} scenes | {} | {} | {:.2f} | | | | | | |\n", mean.second, key.first,
               key.second, 100 * mean.first / mean.second);
  }
}

// What no features can do without.
constexpr const char* kLeast = "a stroke for each label";

void print_counts(const std::string& name, const std::string& features,
                  const CorrectionCounts& counts) {
  fmt::print("| {} | {} |", name, features);
  for (const std::optional<int>& count : counts) {
    fmt::print(" {} |", count ? std::to_string(*count) : fmt::format("> {}", kMostCorrections));
  }
  std::puts("");
  std::fflush(stdout);
}

void print_corrections(const Request& request) {
  fmt::print("| scene | features |");
  for (const double share : kWantedShares) fmt::print(" to {:.0f} % |", 100 * share);
  std::puts("\n|---|---|---:|---:|---:|");
  std::map<std::string, std::vector<CorrectionCounts>> of_features;
  for_scenes(request, [&](const PaintedScene& painted) {
    const ViewIndex center = painted.scene.light_field->center();
    of_features[kLeast].push_back(least_corrections(painted.truth.view(center)));
    print_counts(painted.name, kLeast, of_features[kLeast].back());
    for_features(painted, request, [&](LabelerParameters parameters, const auto& disparity) {
      parameters.regularizer = Regularizer::View;
      const std::string features = name_of(parameters.features);
      const auto count = [&](const std::string& tools, const RaySuperpixels* wand) {
        of_features[tools].push_back(count_corrections(painted, parameters, disparity, wand));
        print_counts(painted.name, tools, of_features[tools].back());
      };
      count(features, nullptr);
      if (!disparity.field) return;
      const RaySuperpixels wand(*painted.scene.light_field, *disparity.field, Progress());
      count(features + ", wand", &wand);
    });
  });
  for (const auto& [features, counts] : of_features) {
    CorrectionCounts medians;
    for (std::size_t i = 0; i < medians.size(); ++i) {
      std::vector<std::optional<int>> column;
      for (const CorrectionCounts& of_scene : counts) column.push_back(of_scene[i]);
      medians[i] = median_count(std::move(column));
    }
    print_counts(fmt::format("median of {} scenes", counts.size()), features, medians);
  }
}

void run(const Request& request) {
  if (!request.exported.empty()) {
    for_scenes(request,
               [&](const PaintedScene& painted) { export_features(painted, request.exported); });
  } else if (request.corrections) {
    print_corrections(request);
  } else {
    print_table(request);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Labels from simulated strokes, with default parameters, against the true labels.");
  Request request;
  app.add_option("--set", request.set,
                 "Scenes: choosing, checking or reporting (label_scenes.json)")
      ->check(CLI::IsMember({"choosing", "checking", "reporting"}));
  app.add_option("--scenes", request.scenes, "Only scenes whose names contain one of these")
      ->delimiter(',');
  app.add_option("--features", request.features, "Only these sets of features")->delimiter(',');
  app.add_option("--regularizers", request.regularizers, "Only these")->delimiter(',');
  app.add_option("--method", request.disparity.method, "The method that estimates disparity");
  app.add_option("--estimates", request.disparity.kept,
                 "Folder where estimates are kept and found again")
      ->check(CLI::ExistingDirectory);
  app.add_option("--size", request.size, "Side of the views of built-in scenes, px");
  app.add_flag("--center", request.center_only, "The center view only");
  app.add_flag("--per-label", request.per_label, "A row for every label as well");
  app.add_flag("--corrections", request.corrections,
               "Instead, how many strokes a user needs who begins with none and corrects what is "
               "wrong (corrections.h)");
  app.add_option("--export", request.exported,
                 "Instead, write the features of the image for sklearn_forest.py into this folder")
      ->check(CLI::ExistingDirectory);
  app.add_option("--data", request.data, "Folder that holds the scene still_life")
      ->envname("EPISCOPE_SHARED_DATA")
      ->check(CLI::ExistingDirectory);
  CLI11_PARSE(app, argc, argv);
  try {
    run(request);
  } catch (const Error& error) {
    std::fprintf(stderr, "episcope_label_accuracy: %s\n", error.what());
    return 1;
  }
  return 0;
}
