// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"
#include "app/cli/input.h"
#include "app/cli/output.h"
#include "app/cli/verbs/verbs.h"
#include "engine/capture/mesh_file.h"
#include "engine/capture/solve_pose.h"
#include "engine/core/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <iostream>

namespace episcope::cli {
namespace {

struct PoseRequest {
  std::string input;
  std::string mesh;
  std::string pairs;
  std::string output;
  bool is_json = false;
  JobOptions job;
  ReadOptions read;
};

bool parse(const VerbArguments& arguments, PoseRequest& request) {
  Arguments parser(
      "pose",
      {"Finds the pose of a mesh before the camera from pairs of points, in the center view\n"
       "and on the mesh: at least 4 pairs, better 10. Wrong picks are named. Each line of\n"
       "PAIRS.csv is name,x_px,y_px,X,Y,Z; a trailing ,1 locks a pair, which then never counts\n"
       "as a wrong pick.",
       "episcope-cli pose lf.h5 --mesh scan.ply --pairs pairs.csv -o pose.json"});
  parser.positional("INPUT", request.input, "A light field, as rectify writes it");
  parser.required_option("--mesh", request.mesh, text_value("MESH"), "Mesh as PLY, OBJ or STL");
  parser.required_option("--pairs", request.pairs, text_value("PAIRS.csv"), "The pairs");
  parser.required_option("-o,--output", request.output, text_value("POSE.json"), "Pose to write");
  parser.flag("--json", request.is_json, "Print one JSON object instead of a table");
  request.read.needs_truth = false;
  return parse_reading(parser, arguments, request.job, request.read);
}

Json answer(const capture::PoseStory& story, const std::string& output) {
  const capture::SolvedPose& solved = story.solved;
  Json json;
  json["reprojection_error_px"] = solved.reprojection_error_px;
  json["delta_tz"] = solved.delta_tz;
  if (std::isfinite(solved.delta_tz_px)) json["delta_tz_px"] = solved.delta_tz_px;
  Json pairs = Json::array();
  for (std::size_t i = 0; i < story.pairs.size(); ++i) {
    pairs.push_back(Json::object({{"name", story.pairs[i].name},
                                  {"residual_px", solved.pairs[i].residual_px},
                                  {"outlier", solved.pairs[i].is_outlier}}));
  }
  json["pairs"] = std::move(pairs);
  json["rotation"] = std::vector<double>(solved.pose.rotation.begin(), solved.pose.rotation.end());
  json["translation"] =
      std::vector<double>(solved.pose.translation.begin(), solved.pose.translation.end());
  json["output"] = output;
  return json;
}

void print(const capture::PoseStory& story, const std::string& output) {
  const capture::SolvedPose& solved = story.solved;
  for (std::size_t i = 0; i < story.pairs.size(); ++i) {
    std::cout << fmt::format("{}: off by {:.2f} px{}\n", story.pairs[i].name,
                             solved.pairs[i].residual_px,
                             solved.pairs[i].is_outlier ? ", probably a wrong pick; left out" : "");
  }
  std::cout << fmt::format(
      "{}: reprojection error {:.3f} px, depth error {:.3g} (unit of the mesh)", output,
      solved.reprojection_error_px, solved.delta_tz);
  if (std::isfinite(solved.delta_tz_px)) {
    std::cout << fmt::format(", {:.4f} px of disparity", solved.delta_tz_px);
  }
  std::cout << '\n';
}

}  // namespace

void run_pose(const VerbArguments& arguments, std::stop_token stop) {
  PoseRequest request;
  if (!parse(arguments, request)) return;
  check_output_file(request.output);
  for (const std::string& each : {request.input, request.mesh, request.pairs}) {
    protect_input(request.output, each);
  }
  capture::PoseStory story;
  story.mesh = request.mesh;
  story.light_field = request.input;
  story.pairs = capture::read_pairs(request.pairs);
  Job job(std::move(stop), request.job);
  const Scene scene = load_input(request.input, request.read, job.progress().part(0, 0.5));
  story.camera = scene.light_field->info().camera;
  if (!story.camera.pinhole) {
    throw IoError(request.input,
                  "the pinhole of this light field (focal length and center in px) is not known; "
                  "make the light field with episcope-cli rectify");
  }
  // Read for its errors alone: a mesh that cannot be used is told now, not by the next step.
  (void)capture::read_mesh(request.mesh, job.progress().part(0.5, 1));
  story.solved = capture::solve_pose(story.pairs, story.camera);
  capture::write_pose(request.output, story);
  job.finish();
  if (request.is_json) {
    return print_answer(answer(story, request.output), job.notes(), {request.output});
  }
  print(story, request.output);
}

}  // namespace episcope::cli
