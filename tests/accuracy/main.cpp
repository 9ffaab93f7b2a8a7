// SPDX-License-Identifier: BSD-3-Clause
// Prints a Markdown table: how well every method does on scenes whose truth is known.
#include "engine/core/error.h"
#include "engine/disparity/registry.h"
#include "engine/io/open/open.h"
#include "engine/scenes/builtin.h"
#include "tests/accuracy/ablation.h"
#include "tests/accuracy/measure.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <string>

namespace {

using namespace episcope;

void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

void print_rows(const std::string& name, const Scene& scene) {
  for (const Estimator& estimator : registered_estimators()) {
    print(accuracy::table_row(accuracy::measure(name, scene, estimator, {}, Progress())));
  }
}

void print_builtin(const char* id, int size) {
  scenes::RenderOptions options;
  options.height = size;
  options.width = size;
  print_rows(std::string(id) + " " + std::to_string(size),
             scenes::render_builtin(id, options, Progress()));
}

// Stored scenes are optional: one that is not there is left out.
void print_stored(const std::filesystem::path& folder, const char* name) {
  if (folder.empty() || !std::filesystem::exists(folder / name)) return;
  const Scene scene = io::open_scene(folder / name, {}, Progress());
  if (scene.truth->field.contains(scene.light_field->center())) print_rows(name, scene);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Errors of every method, with default parameters, on scenes with known truth.");
  bool small = false;
  std::string data;
  app.add_flag("--small", small, "Built-in scenes of 256×256 px instead of 512×512");
  app.add_option("--data", data, "Folder that holds the scenes still_life and cotton")
      ->envname("EPISCOPE_SHARED_DATA")
      ->check(CLI::ExistingDirectory);
  std::string ablation;
  app.add_option("--ablation", ablation,
                 "Instead, what each part of the methods is worth: a file like "
                 "tests/accuracy/ablation.json")
      ->check(CLI::ExistingFile);
  CLI11_PARSE(app, argc, argv);
  try {
    if (!ablation.empty()) {
      accuracy::run_ablation(accuracy::read_ablation(ablation), print, Progress());
      return 0;
    }
    std::fputs(accuracy::table_head().c_str(), stdout);
    for (const char* id : {"fronto", "slant", "edge", "bars", "objects", "demo"}) {
      print_builtin(id, small ? 256 : 512);
    }
    for (const char* name : {"still_life", "cotton"}) print_stored(data, name);
  } catch (const Error& error) {
    std::fprintf(stderr, "episcope_accuracy: %s\n", error.what());
    return 1;
  }
  return 0;
}
