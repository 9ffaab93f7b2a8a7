// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/submission.h"

#include "app/session/result_files.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/core/text_table.h"
#include "engine/io/base/files.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <vector>

namespace episcope {
namespace {

namespace fs = std::filesystem;

constexpr double kFarthest = 20;  // px per view step, either way

bool is_map(const fs::path& path) {
  const auto form = map_form_of(path);
  return form && *form != MapForm::PointCloud;
}

/// Files below the folder that `accepts` takes, sorted.
template <class Accepts>
std::vector<fs::path> files_below(const fs::path& folder, Accepts accepts) {
  std::vector<fs::path> files;
  constexpr auto options = fs::directory_options::skip_permission_denied;
  for (const auto& entry : fs::recursive_directory_iterator(folder, options)) {
    if (entry.is_regular_file() && accepts(entry.path())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<fs::path> maps_of(const fs::path& folder, const std::string& scene) {
  const std::string name = lower_case(scene);
  auto maps = files_below(folder, [&](const fs::path& path) {
    return is_map(path) && lower_case(path.stem().string()) == name;
  });
  if (!maps.empty()) return maps;
  return files_below(folder, [&](const fs::path& path) {
    return is_map(path) && lower_case(path.parent_path().filename().string()) == name;
  });
}

double seconds_of(const fs::path& folder, const std::string& scene) {
  const auto texts = files_below(folder, [&](const fs::path& path) {
    return lower_case(path.extension().string()) == ".txt" &&
           lower_case(path.stem().string()) == lower_case(scene);
  });
  if (texts.empty()) return 0;
  std::ifstream in(texts.front());
  std::string word;
  in >> word;
  const double seconds = io::parse_number(word).value_or(0);
  return std::isfinite(seconds) ? std::max(0.0, seconds) : 0;
}

void check_values(const fs::path& map, ViewIndex view, bool asks_for_depth, Estimate& estimate) {
  if (!estimate.field.contains(view)) {
    throw IoError(map,
                  "does not cover the center view " + view_text(view) + ", which is evaluated");
  }
  const DisparityView values = estimate.field.view(view);
  std::size_t missing = 0, count = 0;
  double farthest = 0;
  const int border = estimate.border_px;
  for (int y = border; y < values.disparity.height - border; ++y) {
    for (int x = border; x < values.disparity.width - border; ++x) {
      ++count;
      if (!values.is_valid(y, x)) {
        ++missing;
      } else {
        farthest = std::max(farthest, std::abs(double{values.disparity.at(y, x)}));
      }
    }
  }
  if (missing == count) throw IoError(map, "contains no finite value in the center view");
  if (farthest > kFarthest && asks_for_depth) {
    estimate.notes.push_back(map.filename().string() + ": disparities reach " +
                             fixed_text(farthest, 1) +
                             " px; are they depth instead of px per view step?");
  }
}

}  // namespace

std::string submission_name(const fs::path& folder) {
  return (fs::absolute(folder) / "x").lexically_normal().parent_path().filename().string();
}

void check_submission(const fs::path& folder) {
  std::error_code ignored;
  if (fs::is_directory(folder, ignored)) return;
  throw IoError(folder, "is not a folder; a submission is a folder of maps named after the scenes");
}

std::optional<Estimate> read_submission(const fs::path& folder, const Scene& scene,
                                        const io::MapReading& reading) {
  const LightField& light_field = *scene.light_field;
  const std::string& name = light_field.info().name;
  const std::vector<fs::path> maps = maps_of(folder, name);
  if (maps.empty()) return std::nullopt;
  if (maps.size() > 1) {
    throw IoError(folder, "contains several maps of " + name + ", " + maps[0].filename().string() +
                              " and " + maps[1].filename().string() + "; keep one");
  }
  Estimate estimate = read_result_of(light_field, maps.front(), reading);
  check_fits(estimate, light_field, maps.front().string());
  bring_to_focus(estimate, light_field, Progress());
  const auto better = find_better_reading(estimate, scene);
  check_values(maps.front(), light_field.center(), !better, estimate);
  if (is_of_other_samples(estimate, light_field)) {
    estimate.notes.push_back(maps.front().filename().string() +
                             ": it was estimated from other samples than those of this scene");
  }
  if (better) {
    estimate.notes.push_back(maps.front().filename().string() + ": " +
                             better_reading_text(*better));
  }
  if (!(estimate.seconds > 0)) estimate.seconds = seconds_of(folder, name);
  return estimate;
}

}  // namespace episcope
