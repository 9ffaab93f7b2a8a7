// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/poses/nerf_poses.h"

#include "engine/core/error.h"
#include "engine/io/json/bounded_json.h"

#include <nlohmann/json.hpp>

#include <stdexcept>

namespace episcope::io {
namespace {

using Json = nlohmann::json;

double focal_widths(const Json& json) {
  if (json.contains("camera_angle_x")) {
    return 0.5 / std::tan(0.5 * json.at("camera_angle_x").get<double>());
  }
  if (!json.contains("fl_x") || !json.contains("w")) return 0;
  return json.at("fl_x").get<double>() / json.at("w").get<double>();
}

CameraPose pose_of(const Json& frame, double focal) {
  const auto rows = frame.at("transform_matrix").get<std::vector<std::vector<double>>>();
  const auto column = [&](std::size_t c) {
    return Direction{rows.at(0).at(c), rows.at(1).at(c), rows.at(2).at(c)};
  };
  const double own = focal_widths(frame);
  return {.image = frame.at("file_path").get<std::string>(),
          .center = column(3),
          .right = normalized(column(0)),
          .down = normalized(times(-1, column(1))),
          .ahead = normalized(times(-1, column(2))),
          .focal_widths = own > 0 ? own : focal};
}

}  // namespace

std::vector<CameraPose> read_nerf_poses(const std::filesystem::path& path) {
  try {
    const Json json = read_json<Json>(path);
    const double focal = focal_widths(json);
    std::vector<CameraPose> poses;
    for (const Json& frame : json.at("frames")) poses.push_back(pose_of(frame, focal));
    return poses;
  } catch (const Json::exception& error) {
    throw IoError(path, std::string("these are no poses of cameras (") + error.what() +
                            "); export them again or remove the file");
  } catch (const InvalidInput& error) {
    throw IoError(path, std::string("these are no poses of cameras (") + error.what() +
                            "); export them again or remove the file");
  } catch (const std::out_of_range&) {
    throw IoError(path,
                  "a transform_matrix has less than 3 rows of 4 numbers; export it again or "
                  "remove the file");
  }
}

}  // namespace episcope::io
