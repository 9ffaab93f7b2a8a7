// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/poses/colmap_poses.h"

#include "engine/core/error.h"
#include "engine/io/durable/system_error.h"
#include "engine/io/maps/parse_number.h"
#include "engine/io/poses/colmap_pose.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <map>
#include <sstream>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

[[noreturn]] void refuse(const fs::path& path, int line) {
  throw IoError(path, fmt::format("line {} is not one of an export of COLMAP as text; export it "
                                  "again or remove the file",
                                  line));
}

double number_in(const fs::path& path, int line, const std::string& word) {
  const auto number = parse_number(word);
  if (!number) refuse(path, line);
  return *number;
}

/// By the ids of cameras: of every model the first parameter is a focal length.
std::map<std::string, double> focal_widths(const fs::path& path) {
  std::map<std::string, double> focals;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    const std::vector<std::string> words = words_of(line);
    if (words.size() < 5 || words[0].starts_with('#')) continue;
    const auto width = parse_number(words[2]);
    const auto focal = parse_number(words[4]);
    if (width && focal && *width > 0) focals[words[0]] = *focal / *width;
  }
  return focals;
}

}  // namespace

std::vector<CameraPose> read_colmap_poses(const fs::path& path) {
  require_readable_file(path);
  if (fs::file_size(path) > kLargestColmap) throw IoError(path, "this file is larger than 1 GB");
  const std::map<std::string, double> focals = focal_widths(path.parent_path() / "cameras.txt");
  std::vector<CameraPose> poses;
  std::ifstream in(path);
  bool is_of_points = false;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.starts_with('#')) continue;
    if (std::exchange(is_of_points, !is_of_points)) continue;
    const std::vector<std::string> words = words_of(line);
    if (words.size() < 10) refuse(path, number);
    std::array<double, 7> numbers{};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      numbers[i] = number_in(path, number, words[i + 1]);
    }
    CameraPose pose = colmap_pose(numbers);
    pose.image = words[9];
    const auto focal = focals.find(words[8]);
    if (focal != focals.end()) pose.focal_widths = focal->second;
    poses.push_back(std::move(pose));
  }
  return poses;
}

}  // namespace episcope::io
