// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"
#include "app/cli/input.h"
#include "app/cli/job.h"
#include "app/cli/output.h"
#include "app/cli/verbs/verbs.h"
#include "app/session/load_scene.h"
#include "app/session/raw_scene.h"
#include "engine/capture/demo_folder.h"
#include "engine/io/formats/write_scene.h"
#include "engine/scenes/builtin.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iostream>
#include <limits>
#include <optional>

namespace episcope::cli {
namespace {

constexpr int kMostViews = 101;
constexpr int kMostPixels = 8192;
constexpr int kLeastSensor = 240;
constexpr double kMostNoise = 255;

struct SynthesizeRequest {
  std::string scene;
  std::string output;
  std::optional<Extent> views;
  std::optional<Extent> size;
  std::optional<double> noise;
  std::optional<int> seed;
  std::optional<capture::CameraModel> camera;
  Overwrite overwrite = Overwrite::No;
  bool is_json = false;
  JobOptions job;
};

std::string list_of_scenes() {
  std::string list =
      "Renders a built-in scene with exact ground truth as lf.h5 in the archive form, with\n"
      "labels.h5 next to it if the scene has labels. With --camera, writes to a folder OUT what a\n"
      "plenoptic camera records of it, for decode. Scenes:\n";
  for (const auto& scene : scenes::builtin_scenes()) {
    list += "  " + scene.id + ": " + scene.summary + "\n";
  }
  list +=
      "  gantry: the input of a capture, written to a folder OUT: photographs of a grid and of a\n"
      "    pattern, a scanned mesh, picked points, and the commands to go on with\n";
  return list;
}

bool parse(const VerbArguments& arguments, SynthesizeRequest& request) {
  Arguments parser("synthesize", {list_of_scenes(),
                                  "episcope-cli synthesize edge -o lf.h5 --grid 9x9 "
                                  "--size 256x256"});
  parser.positional("SCENE", request.scene,
                    "Id of a built-in scene; a random one with its kind: 'random?kind=thin'");
  parser.required_option("-o,--output", request.output, text_value("OUT.h5"),
                         "Light field to write");
  parser.option("--grid", request.views, extent_value("VxU", kMostViews),
                "Camera rows and columns (default 9x9)");
  parser.option("--size", request.size, extent_value("WxH", kMostPixels),
                "Pixels of a view (default 512x512), or of the sensor of --camera");
  parser.option("--camera", request.camera, choice_of<capture::CameraModel>(),
                "Raw picture of a plenoptic camera: 3280x3280 px, 7728x5368, 1600x1200");
  parser.option("--noise-sigma", request.noise, real_value("SIGMA", 0, kMostNoise),
                "Standard deviation of Gaussian noise, in gray levels of 255 (default 0)");
  parser.option("--seed", request.seed, integer_value("N", 0, std::numeric_limits<int>::max()),
                "Seed of a random scene and of the noise (default 1)");
  parser.earlier_name("--views", "--grid");
  parser.earlier_name("--noise", "--noise-sigma");
  parser.flag("--overwrite", request.overwrite, Overwrite::Yes, "Replace an existing light field");
  parser.flag("--json", request.is_json, "Print one JSON object instead of a line");
  declare_job_options(parser, request.job);
  if (!parser.parse(arguments)) return false;
  if (const std::string id = builtin_scene_id(request.scene); !id.empty()) request.scene = id;
  parser.check_uses({{{"--overwrite"},
                      request.scene != kGantryScene,
                      "on the folder of the gantry, which must be empty"},
                     {{"--overwrite", "--grid"}, !request.camera, "with --camera"}});
  return true;
}

/// The scene with options behind its name, "edge?grid=5x5&seed=3"; those of a camera are left out.
std::string scene_text(const SynthesizeRequest& request) {
  std::string text = request.scene;
  const auto add = [&text](const std::string& option) {
    text += (text.find('?') == std::string::npos ? '?' : '&') + option;
  };
  const auto add_extent = [&add](const char* key, const std::optional<Extent>& extent) {
    if (extent) add(fmt::format("{}={}x{}", key, extent->first, extent->second));
  };
  if (!request.camera) {
    add_extent("grid", request.views);
    add_extent("size", request.size);
    if (request.noise) add(fmt::format("noise={}", *request.noise));
  }
  if (request.seed) add(fmt::format("seed={}", *request.seed));
  return text;
}

/// The folder of the gantry, in place of a light field.
void synthesize_gantry(const SynthesizeRequest& request, std::stop_token stop) {
  const capture::DemoOptions options = gantry_options(scene_text(request));
  Job job(std::move(stop), request.job);
  capture::write_demo_folder(request.output, options, job.progress());
  job.finish();
  if (request.is_json) {
    return print_answer(Json::object({{"scene", kGantryScene}, {"output", request.output}}),
                        job.notes(), {request.output});
  }
  std::cout << request.output << ": photographs, pattern, mesh and picks; see readme.txt\n";
}

capture::SyntheticCamera camera_of(const SynthesizeRequest& request) {
  capture::SyntheticCamera camera = capture::synthetic_camera(*request.camera);
  if (request.size) {
    camera.width = request.size->first;
    camera.height = request.size->second;
    if (camera.width % 4 != 0 || std::min(camera.width, camera.height) < kLeastSensor) {
      throw UsageError(
          fmt::format("--size is {}x{}, but a sensor has at least {} px along each "
                      "side, and a width that divides by 4",
                      camera.width, camera.height, kLeastSensor));
    }
  }
  if (request.noise) camera.noise = *request.noise / kMostNoise;
  if (request.seed) camera.seed = static_cast<unsigned>(*request.seed);
  return camera;
}

/// The folder of a raw picture, in place of a light field.
void synthesize_raw(const SynthesizeRequest& request, std::stop_token stop) {
  const capture::SyntheticCamera camera = camera_of(request);
  const scenes::BuiltinRequest scene = scenes::read_request(scene_text(request));
  Job job(std::move(stop), request.job);
  const RawFolder files = write_raw_folder(request.output, scene, camera, job.progress());
  job.finish();
  if (request.is_json) {
    return print_answer(Json::object({{"scene", request.scene},
                                      {"camera", name_of(*request.camera)},
                                      {"raw", files.raw.string()},
                                      {"white", files.white.string()},
                                      {"ideal", files.ideal.string()},
                                      {"output", request.output}}),
                        job.notes(), {request.output});
  }
  std::cout << request.output << ": raw picture, white picture and ideal views; see readme.txt\n";
}

Json answer_json(const SynthesizeRequest& request, const scenes::RenderOptions& options) {
  return Json::object({{"scene", request.scene},
                       {"views", Json::object({{"v", options.grid.v}, {"u", options.grid.u}})},
                       {"height", options.height},
                       {"width", options.width},
                       {"output", request.output}});
}

}  // namespace

void run_synthesize(const VerbArguments& arguments, std::stop_token stop) {
  SynthesizeRequest request;
  if (!parse(arguments, request)) return;
  if (request.scene == kGantryScene) return synthesize_gantry(request, std::move(stop));
  check_builtin_scene(request.scene);
  if (request.camera) return synthesize_raw(request, std::move(stop));
  const auto [id, options] = scenes::read_request(scene_text(request));
  check_hdf5_output("synthesize", request.output);
  check_light_field_output(request.output, request.overwrite);

  Job job(std::move(stop), request.job);
  job.progress().step("rendering " + request.scene);
  const Scene scene = scenes::render_builtin(id, options, job.progress().part(0, 0.9));
  job.progress().step("writing " + request.output);
  const std::filesystem::path labels = io::labels_place(request.output, scene);
  if (!scene.scribbles.empty() && labels == request.output) {
    job.note("the labels and scribbles are in " + request.output +
             " itself, because the labels.h5 beside it is of another light field");
  }
  io::write_archive(request.output, scene, job.progress().part(0.9, 1));
  job.finish();
  if (request.is_json) {
    return print_answer(answer_json(request, options), job.notes(),
                        files_written(request.output, labels));
  }
  std::cout << request.output << ": " << request.scene << ", " << options.grid.v << "×"
            << options.grid.u << " views of " << options.width << "×" << options.height << " px\n";
  print_labels_written(labels, request.output);
}

}  // namespace episcope::cli
