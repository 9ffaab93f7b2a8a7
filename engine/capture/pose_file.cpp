// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/pose_file.h"

#include "engine/core/error.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"
#include "engine/io/base/json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace episcope::capture {
namespace {

using Json = nlohmann::ordered_json;

Json pairs_json(const PoseStory& story) {
  Json pairs = Json::array();
  for (std::size_t i = 0; i < story.pairs.size(); ++i) {
    const PointPair& pair = story.pairs[i];
    const PairResidual& judged = story.solved.pairs[i];
    pairs.push_back({{"name", pair.name},
                     {"x_px", pair.x_px},
                     {"y_px", pair.y_px},
                     {"X", pair.point.x},
                     {"Y", pair.point.y},
                     {"Z", pair.point.z},
                     {"residual_px", judged.residual_px},
                     {"outlier", judged.is_outlier}});
    if (pair.is_locked) pairs.back()["locked"] = true;
  }
  return pairs;
}

/// The path of the mesh as it is found from the folder of the file.
std::string stored_mesh(const std::filesystem::path& mesh, const std::filesystem::path& path) {
  std::error_code error;
  const auto relative =
      std::filesystem::relative(mesh, std::filesystem::absolute(path, error).parent_path(), error);
  return error || relative.empty() ? std::filesystem::absolute(mesh).string() : relative.string();
}

bool is_rotation(const std::array<double, 9>& r) {
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      double product = 0;
      for (int c = 0; c < 3; ++c) product += r[3 * i + c] * r[3 * k + c];
      if (!(std::abs(product - (i == k ? 1 : 0)) < 1e-6)) return false;
    }
  }
  const double turn = r[0] * (r[4] * r[8] - r[5] * r[7]) - r[1] * (r[3] * r[8] - r[5] * r[6]) +
                      r[2] * (r[3] * r[7] - r[4] * r[6]);
  return turn > 0;
}

IoError no_pose(const std::filesystem::path& path) {
  return {path,
          "this is no pose: mesh, rotation (9 numbers) and translation (3) are expected; "
          "make one with episcope-cli pose"};
}

}  // namespace

std::string pose_json(const PoseStory& story, const std::filesystem::path& path) {
  const SolvedPose& solved = story.solved;
  Json json;
  json["mesh"] = stored_mesh(story.mesh, path);
  json["light_field"] = story.light_field;
  json["rotation"] = solved.pose.rotation;
  json["translation"] = solved.pose.translation;
  json["reprojection_error_px"] = solved.reprojection_error_px;
  json["delta_tz"] = solved.delta_tz;
  if (std::isfinite(solved.delta_tz_px)) json["delta_tz_px"] = solved.delta_tz_px;
  json["covariance"] = solved.covariance;
  if (story.camera.pinhole) {
    const Pinhole& pinhole = *story.camera.pinhole;
    json["pinhole"] = {pinhole.focal_px, pinhole.center_x, pinhole.center_y};
  }
  json["pairs"] = pairs_json(story);
  return json.dump(2) + "\n";
}

void write_pose(const std::filesystem::path& path, const PoseStory& story) {
  const std::string text = pose_json(story, path);
  io::write_atomically(path, text);
}

PoseStory read_pose(const std::filesystem::path& path) {
  if (!std::ifstream(path)) {
    throw IoError(path, "this file cannot be read; make one with episcope-cli pose");
  }
  PoseStory story;
  try {
    const auto json = io::read_json<Json>(path);
    story.mesh = json.at("mesh").get<std::string>();
    json.at("rotation").get_to(story.solved.pose.rotation);
    json.at("translation").get_to(story.solved.pose.translation);
    story.light_field = json.value("light_field", "");
  } catch (const Json::exception&) {
    throw no_pose(path);
  } catch (const InvalidInput&) {
    throw no_pose(path);
  }
  if (!is_rotation(story.solved.pose.rotation)) {
    throw IoError(path,
                  "rotation is no rotation matrix; make the pose again with episcope-cli pose");
  }
  if (story.mesh.is_relative()) {
    story.mesh = std::filesystem::absolute(path).parent_path() / story.mesh;
  }
  return story;
}

namespace {

constexpr const char* kHeader = "name,x_px,y_px,X,Y,Z";
constexpr const char* kLocked = ",locked";

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\"");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\"") + 1 - first);
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = line.find(',', begin);
    fields.push_back(trimmed(line.substr(begin, end - begin)));
    if (end == std::string::npos) return fields;
    begin = end + 1;
  }
}

PointPair pair_of(const std::filesystem::path& path, int line,
                  const std::vector<std::string>& fields) {
  const auto fail = [&](const std::string& what) -> IoError {
    return {path, fmt::format("line {} {}; a line is {}", line, what, kHeader)};
  };
  if (fields.size() != 6 && fields.size() != 7) {
    throw fail(fmt::format("has {} fields instead of 6", fields.size()));
  }
  double numbers[5];
  for (int i = 0; i < 5; ++i) {
    const auto number = io::parse_number(fields[i + 1]);
    if (!number) throw fail("has '" + fields[i + 1] + "' where a number belongs");
    numbers[i] = *number;
  }
  const std::string lock = fields.size() == 7 ? fields[6] : "0";
  if (lock != "0" && lock != "1") throw fail("has '" + lock + "' where 1 (locked) or 0 belongs");
  return {fields[0], numbers[0], numbers[1], {numbers[2], numbers[3], numbers[4]}, lock == "1"};
}

}  // namespace

std::vector<PointPair> read_pairs(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw IoError(path, "this file cannot be read; name the pairs, as CSV");
  std::vector<PointPair> pairs;
  std::string text;
  for (int line = 1; std::getline(file, text); ++line) {
    if (line == 1 && text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
    const std::string content = trimmed(text);
    if (content.empty() || content.starts_with('#')) continue;
    const std::vector<std::string> fields = fields_of(content);
    if (pairs.empty() && fields.size() > 1 && fields[1] == "x_px") continue;
    pairs.push_back(pair_of(path, line, fields));
  }
  if (pairs.empty()) {
    throw IoError(path, std::string("there are no pairs in this file; a line is ") + kHeader);
  }
  return pairs;
}

void write_pairs(const std::filesystem::path& path, std::span<const PointPair> pairs) {
  const bool has_locks = std::ranges::any_of(pairs, &PointPair::is_locked);
  std::string text = std::string(kHeader) + (has_locks ? kLocked : "") + "\n";
  for (const PointPair& pair : pairs) {
    if (pair.name.find_first_of(",\n\r") != std::string::npos) {
      throw IoError(path,
                    "the name '" + pair.name + "' has a comma or a line end; rename the pair");
    }
    text += fmt::format("{},{},{},{},{},{}", pair.name, pair.x_px, pair.y_px, pair.point.x,
                        pair.point.y, pair.point.z);
    if (has_locks) text += pair.is_locked ? ",1" : ",0";
    text += '\n';
  }
  io::write_atomically(path, text);
}

}  // namespace episcope::capture
