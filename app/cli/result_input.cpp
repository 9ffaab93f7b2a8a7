// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/result_input.h"

#include "app/cli/output.h"
#include "app/session/load_scene.h"
#include "app/session/read_result.h"
#include "engine/core/error.h"
#include "engine/io/hdf5/hdf5_file.h"
#include "engine/io/maps/result_file.h"

#include <algorithm>

namespace episcope::cli {
namespace {

namespace fs = std::filesystem;

bool is_map(const io::Hdf5Dataset& dataset) {
  return dataset.type == io::Hdf5Type::Float &&
         (dataset.shape.size() == 2 || dataset.shape.size() == 4);
}

/// An HDF5 file of another program with at least one map. Which one is meant is told on reading.
bool is_foreign_hdf5_result(const fs::path& path) {
  if (!io::has_hdf5_signature(path)) return false;
  const io::Hdf5Input file(path);
  const auto datasets = file.datasets();
  return !holds_light_field(path) && std::any_of(datasets.begin(), datasets.end(), is_map);
}

/// The views that a map from elsewhere covers.
GridShape grid_of_map(const fs::path& path) {
  GridShape grid{1, 1};
  if (!io::has_hdf5_signature(path)) return grid;
  for (const auto& dataset : io::Hdf5Input(path).datasets()) {
    if (!is_map(dataset) || dataset.shape.size() != 4) continue;
    grid = {static_cast<int>(dataset.shape[0]), static_cast<int>(dataset.shape[1])};
  }
  return grid;
}

}  // namespace

bool names_result(const std::string& argument) {
  std::error_code ignored;
  if (!builtin_scene_id(argument).empty()) return false;
  if (!fs::is_regular_file(argument, ignored)) return false;
  const std::string suffix = suffix_of(argument);
  return suffix == ".pfm" || suffix == ".tif" || suffix == ".tiff" ||
         io::is_result_file(argument) || is_foreign_hdf5_result(argument);
}

Estimate read_result_alone(const fs::path& path) {
  // Larger than any: a result file says itself where in the grid its views are.
  constexpr GridShape any_grid{1 << 14, 1 << 14};
  return io::read_result(path, io::is_result_file(path) ? any_grid : grid_of_map(path));
}

std::string source_text(const std::string& input, const fs::path& result) {
  if (!builtin_scene_id(input).empty()) return input;
  fs::path source = fs::weakly_canonical(input);
  if (!source.has_filename()) source = source.parent_path();
  const fs::path folder = fs::weakly_canonical(fs::absolute(result)).parent_path();
  const bool share_folder = std::distance(source.begin(), source.end()) > 2 &&
                            std::distance(folder.begin(), folder.end()) > 1 &&
                            *std::next(source.begin()) == *std::next(folder.begin());
  if (!share_folder) return source.string();
  const std::string relative = source.lexically_relative(folder).string();
  const bool reads_as_builtin = !builtin_scene_id(relative).empty();
  return reads_as_builtin ? (fs::path(".") / relative).string() : relative;
}

std::string source_of(const Estimate& estimate, const fs::path& result) {
  if (estimate.source.empty() || !builtin_scene_id(estimate.source).empty()) {
    return estimate.source;
  }
  // An absolute path stands for itself.
  const fs::path source = result.parent_path() / estimate.source;
  std::error_code ignored;
  return fs::exists(source, ignored) ? source.string() : std::string();
}

void note_other_source(const Estimate& estimate, const LightField& light_field, Job& job) {
  if (!is_of_other_samples(estimate, light_field)) return;
  job.note("the result was estimated from other samples than those of " + light_field.info().name);
}

}  // namespace episcope::cli
