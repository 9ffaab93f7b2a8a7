// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"
#include "app/cli/job.h"
#include "app/cli/output.h"
#include "app/cli/verbs/verbs.h"
#include "engine/capture/calibrate.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iostream>

namespace episcope::cli {
namespace {

constexpr int kMostCorners = 100;

struct CalibrateRequest {
  std::vector<std::string> photographs;
  Extent size;
  capture::Pattern pattern;
  std::string output;
  Overwrite overwrite = Overwrite::No;
  bool is_json = false;
  JobOptions job;
};

bool parse(const VerbArguments& arguments, CalibrateRequest& request) {
  Arguments parser("calibrate",
                   {"Calibrates a camera from photographs of a flat pattern, with OpenCV: focal\n"
                    "length, center and distortion of the lens, as YAML that OpenCV reads.\n"
                    "Photographs that do not show the whole pattern sharply, or do not fit, are\n"
                    "named and left out.",
                    "episcope-cli calibrate pattern/*.jpg --board 9x6 -o camera.yml\n"
                    "  episcope-cli calibrate *.png --board 10x7 --kind charuco --square 0.02 "
                    "-o camera.yml"});
  parser.positionals("PHOTO", request.photographs, "Photographs of the pattern");
  parser.required_option("--board", request.size, extent_value("COLSxROWS", kMostCorners),
                         "Inner corners of a chessboard or ChArUco board, circles of a grid");
  parser.earlier_name("--pattern", "--board");
  parser.option("--kind", request.pattern.kind, choice_of<capture::PatternKind>(),
                "Kind of pattern (default chessboard)");
  parser.option("--square", request.pattern.square, real_value("LENGTH", 1e-9, 1e9),
                "Distance of neighboring points (default 1); the camera does not depend on it");
  parser.required_option("-o,--output", request.output, text_value("CAMERA.yml"),
                         "Camera to write");
  parser.flag("--overwrite", request.overwrite, Overwrite::Yes,
              "Replace a file that holds anything but this camera");
  parser.flag("--json", request.is_json, "Print one JSON object instead of a table");
  declare_job_options(parser, request.job);
  if (!parser.parse(arguments)) return false;
  constexpr int kFewest = 3;
  if (std::min(request.size.first, request.size.second) < kFewest) {
    throw UsageError(
        fmt::format("--board is {}x{}, but a pattern has at least {} points in a row and in a "
                    "column; count its inner corners, or its circles",
                    request.size.first, request.size.second, kFewest));
  }
  request.pattern.columns = request.size.first;
  request.pattern.rows = request.size.second;
  return true;
}

Json answer(const capture::Calibration& calibration, const std::string& output) {
  Json json;
  json["rms"] = calibration.camera.rms;
  Json photos = Json::array();
  for (const capture::PatternPhotograph& each : calibration.photographs) {
    Json photo;
    photo["file"] = each.name;
    if (each.rms > 0) photo["rms"] = each.rms;
    photo["used"] = each.is_used();
    if (!each.is_used()) photo["problem"] = each.problem;
    photos.push_back(std::move(photo));
  }
  const capture::LensCamera& camera = calibration.camera;
  json["photos"] = std::move(photos);
  json["focal_length_px"] = std::vector<double>{camera.focal_x, camera.focal_y};
  json["center_px"] = std::vector<double>{camera.center_x, camera.center_y};
  json["distortion"] = std::vector<double>(camera.distortion.begin(), camera.distortion.end());
  json["output"] = output;
  return json;
}

void print(const capture::Calibration& calibration, const std::string& output) {
  std::size_t used = 0;
  for (const capture::PatternPhotograph& each : calibration.photographs) {
    used += each.is_used() ? 1 : 0;
    std::cout << each.name << ": "
              << (each.is_used() ? fmt::format("error {:.3f} px", each.rms)
                                 : "left out, " + each.problem)
              << '\n';
  }
  const capture::LensCamera& camera = calibration.camera;
  std::cout << fmt::format(
      "{}: focal length {:.2f} × {:.2f} px, center ({:.2f}, {:.2f}), error {:.3f} px over {} of {} "
      "photographs\n",
      output, camera.focal_x, camera.focal_y, camera.center_x, camera.center_y, camera.rms, used,
      calibration.photographs.size());
}

}  // namespace

void run_calibrate(const VerbArguments& arguments, std::stop_token stop) {
  CalibrateRequest request;
  if (!parse(arguments, request)) return;
  check_output_file(request.output);
  for (const std::string& each : request.photographs) protect_input(request.output, each);
  Job job(std::move(stop), request.job);
  const capture::Calibration calibration = capture::calibrate(
      {request.photographs.begin(), request.photographs.end()}, request.pattern, job.progress());
  write_output(request.output, request.overwrite, [&](const std::filesystem::path& path) {
    capture::write_camera(path, calibration.camera);
  });
  job.finish();
  if (request.is_json) {
    return print_answer(answer(calibration, request.output), job.notes(), {request.output});
  }
  print(calibration, request.output);
}

}  // namespace episcope::cli
