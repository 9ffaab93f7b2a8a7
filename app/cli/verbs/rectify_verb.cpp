// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"
#include "app/cli/input.h"
#include "app/cli/output.h"
#include "app/cli/verbs/verbs.h"
#include "app/session/capture_work.h"
#include "engine/capture/solve_pose.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iostream>
#include <utility>

namespace episcope::cli {
namespace {

struct RectifyRequest {
  std::string input;
  std::string camera;
  std::string output;
  std::string picks;
  std::string pairs;
  std::optional<double> step;
  bool equalize = false;
  bool is_json = false;
  Overwrite overwrite = Overwrite::No;
  JobOptions job;
  ReadOptions read;
};

bool parse(const VerbArguments& arguments, RectifyRequest& request) {
  Arguments parser(
      "rectify",
      {"Makes a light field of photographs taken on a grid: undistorted, with rows and columns\n"
       "aligned, and shifted so that the scene lies at disparity 0. Each sample is interpolated\n"
       "once.",
       "episcope-cli rectify photographs/ --camera camera.yml --step 12 -o lf.h5"});
  parser.positional("FOLDER", request.input, "The photographs, or any light field");
  parser.required_option("--camera", request.camera, text_value("CAMERA.yml"),
                         "The camera, as calibrate writes it");
  parser.required_option("-o,--output", request.output, text_value("OUT.h5"),
                         "Light field to write");
  parser.option("--step", request.step, real_value("LENGTH", 1e-9, 1e9),
                "Step of the gantry in the unit of the mesh (default 1: depth is in steps)");
  parser.flag("--even-gain", request.equalize, true,
              "Divide each view by its gain, as measured against the center");
  parser.option("--picks", request.picks, text_value("PICKS.csv"),
                "Pairs picked in the photograph of the center view, to transfer");
  parser.option("--pairs", request.pairs, text_value("PAIRS.csv"),
                "File for the transferred picks, in pixels of the rectified center view");
  parser.flag("--json", request.is_json, "Print one JSON object instead of text");
  parser.flag("--overwrite", request.overwrite, Overwrite::Yes, "Replace an existing light field");
  request.read.needs_truth = false;
  if (!parse_reading(parser, arguments, request.job, request.read)) return false;
  if (request.picks.empty() != request.pairs.empty()) {
    throw UsageError("--picks and --pairs belong together: what to carry over, and where to");
  }
  return true;
}

Json errors_json(const capture::RowErrors& errors) {
  return Json::object({{"median", errors.median}, {"percentile_95", errors.percentile_95}});
}

Json answer(const capture::Rectified& rectified, const std::string& output) {
  const LightField& field = *rectified.light_field;
  Json json;
  json["width"] = field.width();
  json["height"] = field.height();
  json["points"] = rectified.points;
  json["vertical_disparity_before_px"] = errors_json(rectified.before);
  json["vertical_disparity_after_px"] = errors_json(rectified.after);
  json["roll_degrees"] = rectified.alignment.roll_degrees();
  json["shift"] = field.info().camera.shift;
  json["focal_length_px"] = field.info().camera.focal_length;
  json["gains"] = rectified.gains;
  json["output"] = output;
  json["written"] = std::vector<std::string>{output};
  return json;
}

void print(const capture::Rectified& rectified, const std::string& output) {
  const LightField& field = *rectified.light_field;
  const auto [low, high] = std::ranges::minmax(rectified.gains);
  std::cout << fmt::format(
      "{}: {}×{} views of {}×{} px, shifted by {:.3f} px per view step\n"
      "vertical disparity of neighbors (median, 95 %): before {:.3f}, {:.3f} px, after {:.3f}, "
      "{:.3f} px, of {} points\n"
      "the camera was turned by {:.3f}° against the gantry; gains {:.3f} … {:.3f}\n",
      output, field.grid().v, field.grid().u, field.width(), field.height(),
      field.info().camera.shift, rectified.before.median, rectified.before.percentile_95,
      rectified.after.median, rectified.after.percentile_95, rectified.points,
      -rectified.alignment.roll_degrees(), low, high);
}

void check_outputs(const RectifyRequest& request) {
  check_hdf5_output("rectify", request.output);
  protect_input(request.output, request.input);
  check_light_field_output(request.output, request.overwrite);
  if (request.pairs.empty()) return;
  check_output_file(request.pairs);
  protect_input(request.pairs, request.picks);
}

}  // namespace

void run_rectify(const VerbArguments& arguments, std::stop_token stop) {
  RectifyRequest request;
  if (!parse(arguments, request)) return;
  check_outputs(request);
  const capture::LensCamera camera = capture::read_camera(request.camera);
  std::vector<capture::PointPair> picks;
  if (!request.picks.empty()) picks = capture::read_pairs(request.picks);
  Job job(std::move(stop), request.job);
  Scene scene = load_input(request.input, request.read, job.progress().part(0, 0.2));
  for (const auto& warning : scene.convention.warnings) job.note(warning);
  CaptureWork work{.lens = CaptureLens{.camera = camera},
                   .rectify = {request.step.value_or(1), request.equalize}};
  work.objects = {{.name = request.picks, .pairs = std::move(picks)}};
  const RectifiedFile made = rectify_to_file({std::move(scene), std::move(work), request.output},
                                             job.progress().part(0.2, 1));
  const std::vector<capture::PointPair>& pairs = made.work.objects[0].pairs;
  const capture::Rectified& rectified = made.rectified;
  if (!pairs.empty()) capture::write_pairs(request.pairs, pairs);
  job.finish();
  if (request.is_json) {
    Json json = answer(rectified, request.output);
    if (!pairs.empty()) json["written"].push_back(request.pairs);
    return print_answer(std::move(json), job.notes());
  }
  print(rectified, request.output);
  if (!pairs.empty()) std::cout << request.pairs << ": " << pairs.size() << " pairs\n";
}

}  // namespace episcope::cli
