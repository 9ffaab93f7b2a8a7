// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"
#include "app/cli/input.h"
#include "app/cli/output.h"
#include "app/cli/streams.h"
#include "app/cli/verbs/verbs.h"
#include "app/session/capture_work.h"
#include "app/session/load_scene.h"
#include "engine/capture/mesh_file.h"
#include "engine/capture/solve_pose.h"
#include "engine/capture/view_surface.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/io/formats/write_scene.h"
#include "engine/io/models/order/order_check.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <memory>
#include <utility>

namespace episcope::cli {
namespace {

constexpr const char* kPipedForms = "; - is one on standard input: HDF5, .npy, .npz, .mat or TIFF";

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
  parser.positional("FOLDER", request.input,
                    std::string("The photographs, or any light field") + kPipedForms);
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
  parser.flag("--overwrite", request.overwrite, Overwrite::Yes,
              "Replace an existing light field, and other pairs");
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
  if (request.overwrite == Overwrite::Yes || !std::filesystem::exists(request.pairs)) return;
  try {
    (void)capture::read_pairs(request.pairs);
  } catch (const Error&) {  // Else it would be refused once the light field is written.
    throw IoError(
        request.pairs,
        std::string("exists and holds something else; choose another name, or ") + kByOption);
  }
}

}  // namespace

void run_rectify(const VerbArguments& arguments, std::stop_token stop) {
  RectifyRequest request;
  if (!parse(arguments, request)) return;
  const InputStream from(request.input, stop);
  from.require_light_field();
  check_outputs(request);
  const capture::LensCamera camera = capture::read_camera(request.camera);
  std::vector<capture::PointPair> picks;
  if (!request.picks.empty()) picks = capture::read_pairs(request.picks);
  Job job(std::move(stop), request.job);
  Scene scene = load_input(request.input, request.read, job, job.progress().part(0, 0.2));
  CaptureWork work{.lens = CaptureLens{.camera = camera},
                   .rectify = {request.step.value_or(1), request.equalize}};
  work.objects = {{.name = request.picks, .pairs = std::move(picks)}};
  const RectifiedFile made = rectify_to_file({std::move(scene), std::move(work), request.output},
                                             job.progress().part(0.2, 1));
  const std::vector<capture::PointPair>& pairs = made.work.objects[0].pairs;
  const capture::Rectified& rectified = made.rectified;
  if (!pairs.empty()) {
    write_output(request.pairs, request.overwrite,
                 [&](const std::filesystem::path& path) { capture::write_pairs(path, pairs); });
  }
  job.finish();
  if (request.is_json) {
    Json json = answer(rectified, request.output);
    if (!pairs.empty()) json["written"].push_back(request.pairs);
    return print_answer(std::move(json), job.notes());
  }
  print(rectified, request.output);
  if (!pairs.empty()) std::cout << request.pairs << ": " << pairs.size() << " pairs\n";
}

namespace {

struct PoseRequest {
  std::string input;
  std::string mesh;
  std::string pairs;
  std::string output;
  Overwrite overwrite = Overwrite::No;
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
  parser.positional("INPUT", request.input,
                    std::string("A light field, as rectify writes it") + kPipedForms);
  parser.required_option("--mesh", request.mesh, text_value("MESH"), "Mesh as PLY, OBJ or STL");
  parser.required_option("--pairs", request.pairs, text_value("PAIRS.csv"), "The pairs");
  parser.required_option("-o,--output", request.output, text_value("POSE.json"), "Pose to write");
  parser.flag("--overwrite", request.overwrite, Overwrite::Yes,
              "Replace a file that holds anything but this pose");
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

/// Names of pairs whose points are far outside of the mesh.
std::vector<std::string> pairs_off(const capture::TriangleMesh& mesh,
                                   const std::vector<capture::PointPair>& pairs) {
  constexpr double kFar = 0.02;  // of the diagonal of the mesh
  capture::Vertex low = mesh.vertices.front(), high = low;
  for (const capture::Vertex& vertex : mesh.vertices) {
    for (std::size_t axis = 0; axis < vertex.size(); ++axis) {
      low[axis] = std::min(low[axis], vertex[axis]);
      high[axis] = std::max(high[axis], vertex[axis]);
    }
  }
  const double margin = kFar * std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  std::vector<std::string> names;
  for (const capture::PointPair& pair : pairs) {
    const std::array<double, 3> point{pair.point.x, pair.point.y, pair.point.z};
    bool is_off = false;
    for (std::size_t axis = 0; axis < point.size(); ++axis) {
      is_off = is_off || point[axis] < low[axis] - margin || point[axis] > high[axis] + margin;
    }
    if (is_off) names.push_back(pair.name);
  }
  return names;
}

void note_doubts(const std::string& pose, const capture::PoseStory& story,
                 const capture::TriangleMesh& mesh, const LightField& field, Job& job) {
  constexpr double kLargeError = 0.005;  // of the diagonal of a view: 2 px of 320×240
  const double error_px = story.solved.reprojection_error_px;
  if (error_px > kLargeError * std::hypot(field.width(), field.height())) {
    job.note(fmt::format(
        "{}: the pairs are off by {:.1f} px on average: the pose is not to be trusted; check the "
        "picks, the order of their columns, and that they are of this light field and mesh",
        pose, error_px));
  }
  const std::vector<std::string> off = pairs_off(mesh, story.pairs);
  if (off.empty()) return;
  job.note(pose + ": the points of " + joined(off, ", ") +
           " lie outside of the mesh; pick them on its surface, in its unit");
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
  const InputStream from(request.input, stop);
  from.require_light_field();
  check_output_file(request.output);
  for (const std::string& each : {request.input, request.mesh, request.pairs}) {
    protect_input(request.output, each);
  }
  capture::PoseStory story;
  story.mesh = request.mesh;
  if (!from.is(request.input)) story.light_field = request.input;
  story.pairs = capture::read_pairs(request.pairs);
  Job job(std::move(stop), request.job);
  const Scene scene = load_input(request.input, request.read, job.progress().part(0, 0.5));
  story.camera = scene.light_field->info().camera;
  if (!story.camera.pinhole) {
    throw IoError(request.input,
                  "the pinhole of this light field (focal length and center in px) is not known; "
                  "make the light field with episcope-cli rectify");
  }
  const capture::TriangleMesh mesh = capture::read_mesh(request.mesh, job.progress().part(0.5, 1));
  story.solved = capture::solve_pose(story.pairs, story.camera);
  note_doubts(request.output, story, mesh, *scene.light_field, job);
  write_output(request.output, request.overwrite, [&](const std::filesystem::path& path) {
    capture::write_pose(path, story, request.output);
  });
  job.finish();
  if (request.is_json) {
    return print_answer(answer(story, request.output), job.notes(), {request.output});
  }
  print(story, request.output);
}

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
  parser.positional("INPUT", request.input,
                    std::string("A light field, as rectify writes it") + kPipedForms);
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

Scene with_truth(const GroundTruthRequest& request, const Scene& scene, Job& job) {
  const Progress progress = job.progress().part(0.05, 0.9);
  std::vector<PosedMesh> meshes;
  for (const std::string& file : request.poses) {
    const capture::PoseStory story = capture::read_pose(file);
    meshes.push_back({std::make_shared<const capture::TriangleMesh>(
                          capture::read_mesh(story.mesh, progress.part(0, 0.1))),
                      story.solved.pose});
    note_doubts(file, story, *meshes.back().mesh, *scene.light_field, job);
  }
  return with_mesh_truth(meshes, scene, progress.part(0.1, 1), request.depth);
}

/// The views are in order: they tell whether the truth is right.
void note_contradictions(const Scene& scene, Job& job) {
  const LightField& field = *scene.light_field;
  const io::OrderFinding found =
      io::find_order(field.samples(), {{field.center(), scene.truth->field.view(field.center())}},
                     {}, io::Flip::None, Progress());
  for (const std::string& warning : found.warnings) job.note(warning);
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
  const InputStream from(request.input, stop);
  from.require_light_field();
  check_hdf5_output("ground-truth", request.output);
  protect_input(request.output, request.input);
  check_light_field_output(request.output, request.overwrite);
  Job job(std::move(stop), request.job);
  Scene scene = load_input(request.input, request.read, job, job.progress().part(0, 0.05));
  if (request.step) {
    LightFieldInfo info = scene.light_field->info();
    info.camera.baseline = *request.step;
    scene.light_field = with_info(*scene.light_field, std::move(info));
  }
  scene = with_truth(request, scene, job);
  note_contradictions(scene, job);
  const std::filesystem::path labels = io::labels_place(request.output, scene);
  io::write_archive(request.output, scene, job.progress().part(0.9, 1));
  job.finish();
  print(request, scene, labels, job);
}

}  // namespace episcope::cli
