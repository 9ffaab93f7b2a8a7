// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"
#include "app/cli/input.h"
#include "app/cli/output.h"
#include "app/cli/verbs/verbs.h"
#include "engine/capture/mesh_file.h"
#include "engine/capture/solve_pose.h"
#include "engine/capture/view_surface.h"
#include "engine/core/error.h"
#include "engine/io/formats/write_scene.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <iostream>
#include <list>

namespace episcope::cli {
namespace {

struct GroundTruthRequest {
  std::string input;
  std::vector<std::string> poses;
  std::string output;
  std::optional<double> step;
  capture::DepthOptions depth;
  bool is_json = false;
  Overwrite overwrite = Overwrite::No;
  JobOptions job;
  ReadOptions read;
};

bool parse(const VerbArguments& arguments, GroundTruthRequest& request) {
  Arguments parser(
      "ground-truth",
      {"Adds the exact depth of meshes to all views of a light field. Each pixel takes the depth\n"
       "of the polygon with the largest visible area. Silhouettes, discontinuities and holes are\n"
       "masked; labels tell the meshes apart.",
       "episcope-cli ground-truth raw.h5 --pose head.json --pose box.json -o lf.h5"});
  parser.positional("INPUT", request.input, "A light field, as rectify writes it");
  parser.list_option("--pose", request.poses, "POSE.json", "Pose of a mesh, as pose writes it");
  parser.required_option("-o,--output", request.output, text_value("OUT.h5"),
                         "Light field to write, with GT_DEPTH, its mask and labels");
  parser.option("--step", request.step, real_value("LENGTH", 1e-9, 1e9),
                "Step of the grid in the unit of the mesh (default: from the light field)");
  parser.option("--jump", request.depth.jump_px, real_value("PX", 1e-6, 1e6),
                "Smallest jump of disparity that is masked, in px (default 0.1)");
  parser.flag("--both-sides", request.depth.both_sides, true,
              "Show both sides of faces, for meshes whose faces are not oriented");
  parser.flag("--json", request.is_json, "Print one JSON object instead of text");
  parser.flag("--overwrite", request.overwrite, Overwrite::Yes, "Replace an existing light field");
  request.read.needs_truth = false;
  return parse_reading(parser, arguments, request.job, request.read);
}

GroundTruth truth_of(const GroundTruthRequest& request, Scene& scene, const Progress& progress) {
  std::list<capture::TriangleMesh> meshes;
  std::vector<capture::PlacedMesh> placed;
  for (const std::string& file : request.poses) {
    const capture::PoseStory story = capture::read_pose(file);
    meshes.push_back(capture::read_mesh(story.mesh, progress.part(0, 0.1)));
    placed.push_back({&meshes.back(), story.solved.pose});
  }
  const LightField& field = *scene.light_field;
  const capture::DepthGrid grid{field.grid(), field.height(), field.width(), field.info().camera};
  return capture::visible_depth(placed, grid, request.depth, progress.part(0.1, 1));
}

/// The light field with the step that was given.
LightFieldPtr with_step(const LightFieldPtr& field, double step) {
  LightFieldInfo info = field->info();
  info.camera.baseline = step;
  auto samples = std::visit([](const auto& stack) -> LightField::Samples { return stack.clone(); },
                            field->samples());
  return std::make_shared<LightField>(std::move(samples), std::move(info), field->valid().clone());
}

void print(const GroundTruthRequest& request, const Scene& scene,
           const std::filesystem::path& labels, const Job& job) {
  const GroundTruth& truth = *scene.truth;
  std::size_t valid = 0;
  std::size_t seen = 0;
  for (std::size_t i = 0; i < truth.field.valid.size(); ++i) {
    valid += truth.field.valid.data()[i];
    seen += truth.labels.data()[i] > 0 ? 1 : 0;
  }
  const double all = static_cast<double>(truth.field.valid.size());
  const double valid_percent = 100 * static_cast<double>(valid) / all;
  const double seen_percent = 100 * static_cast<double>(seen) / all;
  if (request.is_json) {
    Json json;
    json["views"] = scene.light_field->grid().count();
    json["meshes"] = request.poses.size();
    json["valid_percent"] = valid_percent;
    json["mesh_percent"] = seen_percent;
    json["output"] = request.output;
    json["written"] = files_written(request.output, labels);
    return print_answer(std::move(json), job.notes());
  }
  std::cout << fmt::format(
      "{}: depth of {} views from {} mesh{}; meshes cover {:.1f} % of the "
      "pixels, {:.1f} % have depth\n",
      request.output, scene.light_field->grid().count(), request.poses.size(),
      request.poses.size() == 1 ? "" : "es", seen_percent, valid_percent);
  print_labels_written(labels, request.output);
}

}  // namespace

void run_ground_truth(const VerbArguments& arguments, std::stop_token stop) {
  GroundTruthRequest request;
  if (!parse(arguments, request)) return;
  if (request.poses.empty()) throw UsageError("name at least one pose: --pose POSE.json");
  check_hdf5_output("ground-truth", request.output);
  protect_input(request.output, request.input);
  check_light_field_output(request.output, request.overwrite);
  Job job(std::move(stop), request.job);
  Scene scene = load_input(request.input, request.read, job.progress().part(0, 0.05));
  for (const auto& warning : scene.convention.warnings) job.note(warning);
  if (request.step) scene.light_field = with_step(scene.light_field, *request.step);
  scene.truth =
      std::make_shared<GroundTruth>(truth_of(request, scene, job.progress().part(0.05, 0.9)));
  const std::filesystem::path labels = io::labels_place(request.output, scene);
  io::write_archive(request.output, scene, job.progress().part(0.9, 1));
  job.finish();
  print(request, scene, labels, job);
}

}  // namespace episcope::cli
