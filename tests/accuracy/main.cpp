// SPDX-License-Identifier: BSD-3-Clause
// Prints Markdown tables: how well every method does on scenes whose truth is known.
#include "engine/core/error.h"
#include "tests/accuracy/ablation.h"
#include "tests/accuracy/means.h"
#include "tests/accuracy/scene_sets.h"
#include "tests/accuracy/variant.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>

namespace {

using namespace episcope;
using namespace episcope::accuracy;

struct Request {
  std::string set = "choosing";
  std::vector<std::string> scenes;
  std::vector<std::string> methods;
  std::vector<std::string> settings;
  std::string profile;
  std::string data;
  std::string ablation;
  std::string sets = EPISCOPE_SCENE_SETS;
  bool is_small = false;
  bool center_only = false;
  int threads = 0;
};

void declare(CLI::App& app, Request& request) {
  app.add_option("--set", request.set,
                 "choosing (defaults are chosen on it) or reporting (never looked at to choose)")
      ->check(CLI::IsMember({"choosing", "reporting"}));
  app.add_option("--scenes", request.scenes, "Only scenes whose names contain one of these")
      ->delimiter(',');
  app.add_option("--methods", request.methods, "Ids of methods, as epi_l,st_ch_g; by default all")
      ->delimiter(',');
  app.add_option("--param", request.settings,
                 "key=value for all methods that have it, or method.key=value; may be repeated");
  app.add_option("--profile", request.profile, "As --param profile=NAME: paper or tuned");
  app.add_flag("--center", request.center_only, "Estimate the center view alone, which is faster");
  app.add_flag("--small", request.is_small, "Built-in scenes of 256×256 px instead of 512×512");
  app.add_option("--threads", request.threads, "Number of threads; 0 = one per processor");
  app.add_option("--data", request.data, "Folder that holds the scenes still_life and cotton")
      ->envname("EPISCOPE_SHARED_DATA")
      ->check(CLI::ExistingDirectory);
  app.add_option("--ablation", request.ablation,
                 "Instead, what each part of the methods is worth: a file like "
                 "tests/accuracy/ablation.json")
      ->check(CLI::ExistingFile);
  app.add_option("--sets", request.sets, "The file with the sets")->check(CLI::ExistingFile);
}

void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

// A method that refuses a scene is told of and left out of the means.
void measure_all(const std::string& group, const std::string& name, const Scene& scene,
                 const Request& request, const std::vector<Variant>& variants,
                 std::vector<Measurement>& measurements) {
  const auto views = request.center_only ? ViewSelection::Center : ViewSelection::All;
  for (const Variant& variant : variants) {
    try {
      Measurement measured =
          measure(name, scene, variant.estimator, variant.values, views, Progress(request.threads));
      measured.group = group;
      print(table_row(measured));
      measurements.push_back(std::move(measured));
    } catch (const Error& error) {
      std::fprintf(stderr, "%s, %s: %s\n", name.c_str(), variant.estimator.info.name.c_str(),
                   error.what());
    }
  }
}

void run(Request request) {
  if (!request.profile.empty()) request.settings.push_back("profile=" + request.profile);
  const std::vector<Variant> methods = variants(request.methods, request.settings);
  const std::vector<SceneSet> sets = read_scene_sets(request.sets);
  const SceneSet set =
      scenes_with(*std::ranges::find(sets, request.set, &SceneSet::name), request.scenes);
  const int size = request.is_small ? 256 : 512;
  std::vector<Measurement> measurements;
  print("Set of scenes: " + set.name + "; built-in ones of 9×9 views of " + std::to_string(size) +
        "×" + std::to_string(size) + " px.\n\n" + table_head());
  for (const SceneGroup& group : set.groups) {
    for (const std::string& name : group.scenes) {
      const auto scene = open_scene_of_set(name, size, request.data, Progress(request.threads));
      if (scene) {
        measure_all(set.name + ", " + group.name, name, *scene, request, methods, measurements);
      } else {
        std::fprintf(stderr, "%s is left out: it is not in the folder --data\n", name.c_str());
      }
    }
  }
  print("\n" + means_table(means_of(measurements, set.name + ", all")));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Errors of every method, with default parameters, on scenes with known truth.");
  Request request;
  declare(app, request);
  CLI11_PARSE(app, argc, argv);
  try {
    if (!request.ablation.empty()) {
      run_ablation(read_ablation(request.ablation), print, Progress(request.threads));
      return 0;
    }
    run(std::move(request));
  } catch (const Error& error) {
    std::fprintf(stderr, "episcope_accuracy: %s\n", error.what());
    return 1;
  }
  return 0;
}
