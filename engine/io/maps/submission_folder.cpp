// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/maps/submission_folder.h"

#include "engine/core/error.h"
#include "engine/io/durable/atomic_file.h"
#include "engine/io/durable/make_folder.h"
#include "engine/io/maps/parse_number.h"
#include "engine/io/maps/pfm.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <system_error>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMaps = "disp_maps";
constexpr const char* kRuntimes = "runtimes";

/// Fills the gaps of a row with the farther of the values beside them; false if it has no value.
bool fill_row(const DisparityView& map, int y, float* row) {
  const int width = map.disparity.width;
  std::optional<float> left;
  for (int x = 0; x < width;) {
    if (map.is_valid(y, x)) {
      left = row[x] = map.disparity.at(y, x);
      ++x;
      continue;
    }
    int end = x;
    while (end < width && !map.is_valid(y, end)) ++end;
    if (end == width && !left) return false;
    const float right = end < width ? map.disparity.at(y, end) : *left;
    std::fill(row + x, row + end, std::min(left.value_or(right), right));
    x = end;
  }
  return true;
}

/// Rows without a value become like the nearest that has some.
void fill_bare_rows(const std::vector<bool>& is_bare, Image<float>& map) {
  const int height = map.height();
  for (int y = 0; y < height; ++y) {
    if (!is_bare[y]) continue;
    int distance = 1;
    const auto has_values = [&](int row) { return row >= 0 && row < height && !is_bare[row]; };
    while (!has_values(y - distance) && !has_values(y + distance)) ++distance;
    const int from = has_values(y - distance) ? y - distance : y + distance;
    std::copy_n(map.row(from), map.width(), map.row(y));
  }
}

Image<float> filled(const DisparityView& map, std::size_t& gaps) {
  Image<float> result(map.disparity.height, map.disparity.width);
  std::vector<bool> is_bare(static_cast<std::size_t>(result.height()));
  gaps = 0;
  for (int y = 0; y < result.height(); ++y) {
    for (int x = 0; x < result.width(); ++x) gaps += map.is_valid(y, x) ? 0 : 1;
    is_bare[y] = !fill_row(map, y, result.row(y));
  }
  if (gaps == result.size()) throw InvalidInput("the map has no value that could be submitted");
  fill_bare_rows(is_bare, result);
  return result;
}

std::string first_line(const fs::path& path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  return line;
}

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

/// Without white space around it.
std::string trimmed(std::string text) {
  while (!text.empty() && is_blank(text.back())) text.pop_back();
  text.erase(text.begin(), std::find_if_not(text.begin(), text.end(), is_blank));
  return text;
}

/// The header as the benchmark's own tool reads it, line by line; what is wrong with it.
struct PfmLines {
  std::string kind, size, scale;
  std::streamoff samples = 0;
};

PfmLines lines_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  const auto next = [&in] {
    std::string line;
    do {
      line.clear();
      std::getline(in, line);
    } while (in && line.starts_with('#'));
    return trimmed(line);
  };
  PfmLines lines;
  lines.kind = next();
  lines.size = next();
  lines.scale = next();
  lines.samples = in ? std::streamoff{in.tellg()} : 0;
  return lines;
}

std::string map_problem(const fs::path& path, const SubmittedScene& scene) {
  const PfmLines lines = lines_of(path);
  if (lines.kind != "Pf") return "is not a PFM of one channel, which begins with the line Pf";
  const std::string size = fmt::format("{} {}", scene.width, scene.height);
  if (lines.size != size) {
    return fmt::format("has the size \"{}\" in its second line, but \"{}\" is expected",
                       lines.size.substr(0, 30), size);
  }
  const double scale = parse_number(lines.scale).value_or(0);
  if (scale == 0 || !std::isfinite(scale)) return "has no scale in its third line";
  if (scale > 0) return "is big endian: its scale is above 0; write it as little endian";
  const std::uintmax_t samples = sizeof(float) * std::uintmax_t(scene.width) * scene.height;
  if (fs::file_size(path) != static_cast<std::uintmax_t>(lines.samples) + samples) {
    return "does not hold as many samples as its size says";
  }
  const Image<float> map = read_pfm(path);
  const auto bad = std::ranges::count_if(map, [](float d) { return !std::isfinite(d); });
  return bad == 0 ? "" : fmt::format("has {} samples that are not finite", bad);
}

std::string runtime_problem(const fs::path& path) {
  const std::optional<double> seconds = parse_number(trimmed(first_line(path)));
  const bool is_time = seconds && std::isfinite(*seconds) && *seconds > 0;
  return is_time ? "" : "has no number of seconds above 0 in its first line";
}

/// Adds a sentence if the file is missing, or `problem_of` finds a problem.
template <class ProblemOf>
void check_file(const fs::path& path, const char* what, std::vector<std::string>& problems,
                ProblemOf problem_of) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) {
    problems.push_back(fmt::format("{} is missing: {}", path.string(), what));
    return;
  }
  try {
    const std::string problem = problem_of(path);
    if (!problem.empty()) problems.push_back(path.string() + " " + problem);
  } catch (const IoError& error) {
    problems.emplace_back(error.what());
  }
}

}  // namespace

std::vector<SubmittedScene> benchmark_scenes() {
  std::vector<SubmittedScene> scenes;
  for (const char* name : {"backgammon", "dots", "pyramids", "stripes", "boxes", "cotton", "dino",
                           "sideboard", "bedroom", "bicycle", "herbs", "origami"}) {
    scenes.push_back({.name = name});
  }
  return scenes;
}

fs::path submitted_map_file(const fs::path& folder, const std::string& scene) {
  return folder / kMaps / (scene + ".pfm");
}

fs::path submitted_runtime_file(const fs::path& folder, const std::string& scene) {
  return folder / kRuntimes / (scene + ".txt");
}

std::size_t write_submitted_scene(const fs::path& folder, const std::string& scene,
                                  const DisparityView& map, double seconds) {
  if (!(seconds > 0) || !std::isfinite(seconds)) {
    throw InvalidInput(
        "a submission states the seconds that every scene took, but those of this result are not "
        "known; estimate it again");
  }
  std::size_t gaps = 0;
  const Image<float> whole = filled(map, gaps);
  for (const char* part : {kMaps, kRuntimes}) make_folder(folder / part);
  write_pfm(submitted_map_file(folder, scene), whole.view());
  const std::string text = fmt::format("{:.10f}\n", seconds);
  write_atomically(submitted_runtime_file(folder, scene), text);
  return gaps;
}

std::vector<std::string> submission_problems(const fs::path& folder,
                                             const std::vector<SubmittedScene>& scenes) {
  std::vector<std::string> problems;
  for (const SubmittedScene& scene : scenes) {
    check_file(submitted_map_file(folder, scene.name), "the map of the scene", problems,
               [&](const fs::path& path) { return map_problem(path, scene); });
    check_file(submitted_runtime_file(folder, scene.name), "the seconds that the scene took",
               problems, [](const fs::path& path) { return runtime_problem(path); });
  }
  return problems;
}

}  // namespace episcope::io
