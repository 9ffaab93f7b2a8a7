// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments/arguments.h"
#include "app/cli/arguments/usage_error.h"
#include "app/cli/output/job.h"
#include "app/cli/output/output_file.h"
#include "app/cli/verbs/verbs.h"
#include "engine/io/archive/write_scene.h"
#include "engine/scenes/builtin.h"

#include <algorithm>
#include <iostream>
#include <limits>

namespace episcope::cli {
namespace {

struct Request {
  std::string scene;
  std::string output;
  std::string views = "9x9";
  std::string size = "512x512";
  std::string noise = "0";
  std::string seed = "1";
  bool is_overwriting = false;
  JobOptions job;
};

std::string list_of_scenes() {
  std::string list =
      "Renders a built-in scene with exact truth, as lf.h5 of the archive form, with\n"
      "labels.h5 beside it if the scene has labels. Scenes:\n";
  for (const auto& scene : scenes::builtin_scenes()) {
    list += "  " + scene.id + ": " + scene.summary + "\n";
  }
  return list;
}

bool parse(const VerbArguments& arguments, Request& request) {
  Arguments parser("synthesize", {list_of_scenes(),
                                  "episcope-cli synthesize edge -o lf.h5 --views 9x9 "
                                  "--size 256x256"});
  parser.positional("SCENE", request.scene, "Id of a built-in scene");
  parser.required_option("-o,--output", request.output, "OUT.h5", "Light field to write");
  parser.option("--views", request.views, "VxU", "Camera rows and columns (default 9x9)");
  parser.option("--size", request.size, "WxH", "Pixels of a view (default 512x512)");
  parser.option("--noise", request.noise, "SIGMA",
                "Gaussian noise in grey levels of 255 (default 0)");
  parser.option("--seed", request.seed, "N", "Seed of the noise (default 1)");
  parser.flag("--overwrite", request.is_overwriting, "Replace a light field that is there");
  declare_job_options(parser, request.job);
  return parser.parse(arguments);
}

scenes::RenderOptions render_options(const Request& request) {
  constexpr int most_views = 101;
  constexpr int most_pixels = 8192;
  constexpr double most_noise = 255;
  const Extent views = parse_extent("--views", request.views, most_views);
  const Extent size = parse_extent("--size", request.size, most_pixels);
  scenes::RenderOptions options;
  options.grid = {views.first, views.second};
  options.width = size.first;
  options.height = size.second;
  options.noise_sigma = parse_real("--noise", request.noise, 0, most_noise);
  options.seed = static_cast<unsigned>(
      parse_integer("--seed", request.seed, 0, std::numeric_limits<int>::max()));
  return options;
}

void check_scene(const std::string& id) {
  std::vector<std::string> ids;
  for (const auto& scene : scenes::builtin_scenes()) ids.push_back(scene.id);
  if (std::find(ids.begin(), ids.end(), id) == ids.end()) {
    throw unknown_name("built-in scene", id, ids);
  }
}

}  // namespace

void run_synthesize(const VerbArguments& arguments, std::stop_token stop) {
  Request request;
  if (!parse(arguments, request)) return;
  check_scene(request.scene);
  const scenes::RenderOptions options = render_options(request);
  check_hdf5_output("synthesize", request.output);
  check_light_field_output(request.output, request.is_overwriting ? Overwrite::Yes : Overwrite::No);

  Job job(std::move(stop), request.job);
  job.progress().step("rendering " + request.scene);
  const Scene scene = scenes::render_builtin(request.scene, options, job.progress().part(0, 0.9));
  job.progress().step("writing " + request.output);
  io::write_archive(request.output, scene, job.progress().part(0.9, 1));
  job.finish();
  std::cout << request.output << ": " << request.scene << ", " << options.grid.v << "×"
            << options.grid.u << " views of " << options.width << "×" << options.height << " px\n";
}

}  // namespace episcope::cli
