// SPDX-License-Identifier: BSD-3-Clause
// Prints a Markdown table: how much of a light field is labeled rightly from its scribbles, by
// features and regulariser.
#include "app/session/labels/labeling_inputs.h"
#include "engine/core/error.h"
#include "engine/core/parallel/stopwatch.h"
#include "engine/evaluation/metrics/label_accuracy.h"
#include "engine/io/open/open.h"
#include "engine/labeling/consistency.h"
#include "engine/scenes/builtin.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <string>

namespace {

using namespace episcope;

void print_row(const std::string& name, const Scene& scene, const LabelerParameters& parameters,
               const LabelingDisparity& disparity) {
  const LightField& lf = *scene.light_field;
  const Stopwatch watch;
  Labeler labeler(scene.light_field, disparity.field);
  const Labeling labeling =
      labeler.label(scene.scribbles, parameters, {{0, 0}, lf.grid()}, Progress());
  const double seconds = watch.seconds();
  const auto& truth = scene.truth->labels;
  const double all = judge_labels(labeling.labels, truth).share().value_or(0);
  const double center =
      judge_labels(labeling.labels.view(lf.center()), truth.view(lf.center())).share().value_or(0);
  const double consistency =
      label_consistency(labeling.labels, scene.truth->field, Progress()).share();
  std::printf("| %s | %s | %s | %.2f | %.2f | %.2f | %.1f |\n", name.c_str(),
              name_of(parameters.features).c_str(), name_of(parameters.regularizer).c_str(),
              100 * all, 100 * center, 100 * consistency, seconds);
  std::fflush(stdout);
}

void print_scene(const std::string& name, const Scene& scene) {
  for (const auto& features : names_of(FeatureSet{})) {
    LabelerParameters parameters;
    parameters.features = features.value;
    const LabelingDisparity disparity = find_labeling_disparity(scene, parameters, {}, Progress());
    for (const auto& regularizer : names_of(Regularizer{})) {
      parameters.regularizer = regularizer.value;
      print_row(name, scene, parameters, disparity);
    }
  }
}

void print_builtin(const char* id, int size) {
  scenes::RenderOptions options;
  options.height = size;
  options.width = size;
  print_scene(std::string(id) + " " + std::to_string(size),
              scenes::render_builtin(id, options, Progress()));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Labels from scribbles, with default parameters, against the true labels.");
  bool small = false;
  std::string data;
  app.add_flag("--small", small, "Built-in scenes of 256×256 px instead of 512×512");
  app.add_option("--data", data, "Folder that holds the scene still_life")
      ->envname("EPISCOPE_SHARED_DATA")
      ->check(CLI::ExistingDirectory);
  CLI11_PARSE(app, argc, argv);
  try {
    std::puts(
        "| scene | features | regulariser | all views % | centre % | consistency % | s |\n"
        "|---|---|---|---:|---:|---:|---:|");
    for (const char* id : {"objects", "demo"}) print_builtin(id, small ? 256 : 512);
    const std::filesystem::path stored = std::filesystem::path(data) / "still_life";
    if (!data.empty() && std::filesystem::exists(stored)) {
      print_scene("still_life", io::open_scene(stored, {}, Progress()));
    }
  } catch (const Error& error) {
    std::fprintf(stderr, "episcope_label_accuracy: %s\n", error.what());
    return 1;
  }
  return 0;
}
