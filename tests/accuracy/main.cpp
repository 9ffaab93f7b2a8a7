// SPDX-License-Identifier: BSD-3-Clause
// Prints Markdown tables: how well every method does on scenes whose truth is known.
#include "engine/core/error.h"
#include "tests/accuracy/ablation.h"
#include "tests/accuracy/means.h"
#include "tests/accuracy/ranges.h"
#include "tests/accuracy/reliability.h"
#include "tests/accuracy/scene_sets.h"
#include "tests/accuracy/variant.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <map>

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
  bool is_ranges = false;
  bool is_twice = false;
  bool is_reliability = false;
  int size = 512;
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
  app.add_flag("--small{256}", request.size, "Built-in scenes of 256×256 px instead of 512×512");
  app.add_option("--size", request.size, "Side of the built-in scenes, px")
      ->check(CLI::Range(16, 4096));
  app.add_flag("--ranges", request.is_ranges,
               "Instead, the ranges that are found from the images, beside those of the truth");
  app.add_flag("--twice", request.is_twice,
               "Instead, errors with the true range beside those with twice the range");
  app.add_flag("--reliability", request.is_reliability,
               "Instead, of the center view, which share of the pixels with a confidence is right");
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

using TakeScene =
    std::function<void(const std::string& group, const std::string& name, const Scene& scene)>;

// Hands out the scenes asked for, one after the other, and tells of those that are not there.
void for_each_scene(const Request& request, const TakeScene& take) {
  const std::vector<SceneSet> sets = read_scene_sets(request.sets);
  const SceneSet set =
      scenes_with(*std::ranges::find(sets, request.set, &SceneSet::name), request.scenes);
  for (const SceneGroup& group : set.groups) {
    for (const std::string& name : group.scenes) {
      const auto scene =
          open_scene_of_set(name, request.size, request.data, Progress(request.threads));
      if (scene) {
        take(set.name + ", " + group.name, name, *scene);
      } else {
        std::fprintf(stderr, "%s is left out: it is not in the folder --data\n", name.c_str());
      }
    }
  }
}

void print_head(const Request& request, const std::string& head) {
  const std::string size = std::to_string(request.size);
  print("Set of scenes: " + request.set + "; built-in ones of 9×9 views of " + size + "×" + size +
        " px.\n\n" + head);
}

// Calls `measure_one(name, scene, variant)` for each scene and method. A method that refuses a
// scene is told of and left out of the means.
template <class MeasureOne>
void measure_all(const Request& request, const MeasureOne& measure_one) {
  const std::vector<Variant> methods = variants(request.methods, request.settings);
  for_each_scene(request,
                 [&](const std::string& group, const std::string& name, const Scene& scene) {
                   for (const Variant& variant : methods) {
                     try {
                       measure_one(group, name, scene, variant);
                     } catch (const Error& error) {
                       std::fprintf(stderr, "%s, %s: %s\n", name.c_str(),
                                    variant.estimator.info.name.c_str(), error.what());
                     }
                   }
                 });
}

ViewSelection views_of(const Request& request) {
  return request.center_only ? ViewSelection::Center : ViewSelection::All;
}

void print_errors(const Request& request) {
  std::vector<Measurement> measurements;
  print_head(request, table_head());
  measure_all(request, [&](const std::string& group, const std::string& name, const Scene& scene,
                           const Variant& variant) {
    Measurement measured = measure(name, scene, variant.estimator, variant.values,
                                   views_of(request), Progress(request.threads));
    measured.group = group;
    print(table_row(measured));
    measurements.push_back(std::move(measured));
  });
  print("\n" + means_table(means_of(measurements, request.set + ", all")));
}

void print_twice(const Request& request) {
  std::vector<TwiceRange> errors;
  print_head(request, twice_head());
  measure_all(request, [&](const std::string& group, const std::string& name, const Scene& scene,
                           const Variant& variant) {
    TwiceRange measured = measure_twice(name, scene, variant.estimator, variant.values,
                                        views_of(request), Progress(request.threads));
    measured.once.group = group;
    print(twice_row(measured));
    errors.push_back(std::move(measured));
  });
  print("\n" + twice_summary(errors));
}

void print_reliability(const Request& request) {
  std::map<std::string, Reliability> of_methods;
  measure_all(request, [&](const std::string&, const std::string& name, const Scene& scene,
                           const Variant& variant) {
    const Estimate estimate =
        variant.estimator.run(*scene.light_field, variant.values, {.views = ViewSelection::Center},
                              Progress(request.threads));
    if (estimate.confidence.empty()) throw InvalidInput("there is no confidence");
    const ViewIndex center = scene.light_field->center();
    of_methods[variant.estimator.info.name].add(estimate.field.view(center),
                                                estimate.confidence.view(center),
                                                scene.truth->field.view(center));
    std::fprintf(stderr, "%s, %s: done\n", name.c_str(), variant.estimator.info.name.c_str());
  });
  print_head(request, "");
  for (const auto& [method, reliability] : of_methods) {
    print(reliability_table(method, reliability) + "\n");
  }
}

void print_ranges(const Request& request) {
  std::vector<FoundRange> ranges;
  print_head(request, ranges_head());
  for_each_scene(request,
                 [&](const std::string& group, const std::string& name, const Scene& scene) {
                   FoundRange found = find_range(scene, Progress(request.threads));
                   found.group = group;
                   found.scene = name;
                   print(ranges_row(found));
                   ranges.push_back(std::move(found));
                 });
  print("\n" + ranges_summary(ranges));
}

void run(const Request& request) {
  if (!request.ablation.empty()) {
    run_ablation(read_ablation(request.ablation), print, Progress(request.threads));
  } else if (request.is_ranges) {
    print_ranges(request);
  } else if (request.is_twice) {
    print_twice(request);
  } else if (request.is_reliability) {
    print_reliability(request);
  } else {
    print_errors(request);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Errors of every method, with default parameters, on scenes with known truth.");
  Request request;
  declare(app, request);
  CLI11_PARSE(app, argc, argv);
  try {
    if (!request.profile.empty()) request.settings.push_back("profile=" + request.profile);
    run(request);
  } catch (const Error& error) {
    std::fprintf(stderr, "episcope_accuracy: %s\n", error.what());
    return 1;
  }
  return 0;
}
