// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"
#include "app/cli/output.h"
#include "app/cli/verbs/verbs.h"
#include "engine/core/error.h"
#include "engine/io/models/external_result.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <iostream>

namespace episcope::cli {
namespace {

struct ValidateRequest {
  std::string folder;
  std::vector<std::string> scenes;
  Extent size{512, 512};  ///< Width and height.
  bool is_json = false;
};

bool parse(const VerbArguments& arguments, ValidateRequest& request) {
  Arguments parser(
      "validate",
      {"Checks a submission to the 2016 benchmark: a map and a runtime for every scene, sizes,\n"
       "finite samples, little endian.",
       "episcope-cli validate ours\n"
       "  episcope-cli validate ours --scenes boxes cotton dino --json"});
  parser.positional("FOLDER", request.folder, "The submission: disp_maps, runtimes");
  parser.list_option("--scenes", request.scenes, "NAME",
                     "Scenes to expect; by default the twelve of the benchmark");
  constexpr int most = 1 << 16;
  parser.option("--size", request.size, extent_value("WxH", most),
                "Width and height of the maps (default 512x512)");
  parser.flag("--json", request.is_json, "Print one JSON object");
  return parser.parse(arguments);
}

std::vector<io::SubmittedScene> wanted_scenes(const ValidateRequest& request) {
  std::vector<io::SubmittedScene> scenes;
  for (const std::string& name : request.scenes) scenes.push_back({.name = name});
  if (scenes.empty()) scenes = io::benchmark_scenes();
  for (io::SubmittedScene& scene : scenes) {
    scene.width = request.size.first;
    scene.height = request.size.second;
  }
  return scenes;
}

void print_problems(const ValidateRequest& request, std::size_t scenes,
                    const std::vector<std::string>& problems) {
  if (!request.is_json) {
    for (const std::string& problem : problems) std::cout << problem << '\n';
    if (problems.empty()) std::cout << request.folder << ": " << scenes << " scenes are complete\n";
    return;
  }
  print_answer(Json::object({{"folder", request.folder},
                             {"scenes", scenes},
                             {"complete", problems.empty()},
                             {"problems", problems}}));
}

}  // namespace

void run_validate(const VerbArguments& arguments, std::stop_token) {
  ValidateRequest request;
  if (!parse(arguments, request)) return;
  const std::vector<io::SubmittedScene> scenes = wanted_scenes(request);
  if (!std::filesystem::is_directory(request.folder)) {
    throw IoError(request.folder, "is not a folder; a submission holds disp_maps and runtimes");
  }
  const std::vector<std::string> problems = io::submission_problems(request.folder, scenes);
  print_problems(request, scenes.size(), problems);
  if (problems.empty()) return;
  throw Error(fmt::format("{} would not be accepted: {} problems, the first: {}", request.folder,
                          problems.size(), problems.front()));
}

}  // namespace episcope::cli
