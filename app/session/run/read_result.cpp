// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/run/read_result.h"

#include "app/session/scene/load_scene.h"
#include "engine/core/error.h"
#include "engine/core/text/suffix.h"
#include "engine/io/arrays/hdf5_array_reader.h"
#include "engine/io/arrays/npy_file.h"
#include "engine/io/frames/tiff_pages.h"
#include "engine/io/grid/image_header.h"
#include "engine/io/hdf5/hdf5_file.h"
#include "engine/io/maps/padding.h"
#include "engine/io/maps/result_file.h"
#include "engine/io/mosaic/mosaic_dataset.h"

#include <algorithm>

namespace episcope {
namespace {

namespace fs = std::filesystem;

bool is_map(const io::Hdf5Dataset& dataset) {
  return dataset.type == io::Hdf5Type::Float &&
         (dataset.shape.size() == 2 || dataset.shape.size() == 4);
}

/// Whether an HDF5 file holds what only comes with a light field: samples or true depth.
bool holds_light_field(const io::Hdf5Input& file) {
  const auto names = {"LF", "GT_DEPTH", "GT_DEPTH_FOREGROUND", "GT_DEPTH_BACKGROUND"};
  return std::any_of(names.begin(), names.end(),
                     [&file](const char* name) { return file.has(name); }) ||
         std::ranges::any_of(
             file.datasets(),
             [](const io::Hdf5Dataset& dataset) { return dataset.shape.size() == 5; }) ||
         io::find_mosaic_dataset(file.path(), {}).has_value() ||
         !io::hdf5_array_reader().find(file.path(), {}).empty();
}

/// An HDF5 file of another program with at least one map. Which one is meant is told on reading.
bool is_foreign_hdf5_result(const fs::path& path) {
  if (!io::has_hdf5_signature(path)) return false;
  const io::Hdf5Input file(path);
  const auto datasets = file.datasets();
  return !holds_light_field(file) && std::any_of(datasets.begin(), datasets.end(), is_map);
}

/// The views that a map from elsewhere covers.
GridShape grid_of_map(const fs::path& path) {
  GridShape grid{1, 1};
  if (suffix_of(path) == ".npy") {
    const io::NpyHeader header = io::NpyFile(path).header();
    if (header.shape.size() != 4) return grid;
    return {static_cast<int>(header.shape[0]), static_cast<int>(header.shape[1])};
  }
  if (!io::has_hdf5_signature(path)) return grid;
  for (const auto& dataset : io::Hdf5Input(path).datasets()) {
    if (!is_map(dataset) || dataset.shape.size() != 4) continue;
    grid = {static_cast<int>(dataset.shape[0]), static_cast<int>(dataset.shape[1])};
  }
  return grid;
}

/// A map alone, or one of all views by its name: other arrays of four axes are grey light fields.
bool is_npy_result(const fs::path& path) {
  try {
    const std::size_t axes = io::NpyFile(path).shape().size();
    const std::string name = lower_case(path.stem().string());
    return axes == 2 || (axes == 4 && name.find("disp") != std::string::npos);
  } catch (const IoError&) {
    return false;
  }
}

/// One page of floats in one channel; a picture of all views, or a page for each, is none.
bool is_tiff_map(const fs::path& path) {
  if (io::count_tiff_pages(path, 2) > 1) return false;
  const auto header = io::stated_image_header(path);
  if (!header) return true;  // told on reading
  return header->sample_type == SampleType::Float32 && header->channels == 1;
}

std::string size_text(int first, int second) {
  return std::to_string(first) + "×" + std::to_string(second);
}

}  // namespace

bool names_result(const std::string& path) {
  std::error_code ignored;
  if (!builtin_scene_id(path).empty() || !fs::is_regular_file(path, ignored)) return false;
  const std::string suffix = suffix_of(path);
  if (suffix == ".npy") return is_npy_result(path);
  if (suffix == ".tif" || suffix == ".tiff") return is_tiff_map(path);
  return suffix == ".pfm" || io::is_result_file(path) || is_foreign_hdf5_result(path);
}

Estimate read_result_of(const LightField& light_field, const fs::path& path) {
  std::error_code ignored;
  const bool is_hdf5 = fs::is_regular_file(path, ignored) && io::has_hdf5_signature(path);
  if (is_hdf5 && holds_light_field(io::Hdf5Input(path)) && !io::is_result_file(path)) {
    throw IoError(path,
                  "holds a light field or true depth and no estimated disparity; name a result");
  }
  Estimate estimate = io::read_result(path, light_field.grid(), light_field.info().name);
  if (estimate.confidence.empty() && estimate.layered.layers.empty()) {
    const std::string note =
        io::remove_padding(estimate.field, light_field.height(), light_field.width());
    if (!note.empty()) estimate.notes.push_back(note);
  }
  if (!io::is_result_file(path)) {
    const io::BareBorder border =
        io::find_bare_border(estimate.field, light_field.height(), light_field.width());
    estimate.border_px = border.width_px;
    if (!border.note.empty()) estimate.notes.push_back(border.note);
  }
  return estimate;
}

Estimate read_result_alone(const fs::path& path) {
  // Larger than any: a result file says itself where in the grid its views are.
  constexpr GridShape any_grid{1 << 14, 1 << 14};
  return io::read_result(path, io::is_result_file(path) ? any_grid : grid_of_map(path));
}

void check_fits(const Estimate& estimate, const LightField& light_field, const std::string& file) {
  const auto& map = estimate.field.disparity;
  if (map.height() != light_field.height() || map.width() != light_field.width()) {
    throw InvalidInput(file + ": the maps have " + size_text(map.width(), map.height()) +
                       " pixels, but the light field " + light_field.info().name + " has " +
                       size_text(light_field.width(), light_field.height()) +
                       "; open the light field that the result belongs to.");
  }
  const ViewIndex last{map.first().v + map.grid().v - 1, map.first().u + map.grid().u - 1};
  if (!light_field.grid().contains(map.first()) || !light_field.grid().contains(last)) {
    throw InvalidInput(file + ": the maps cover " + size_text(map.grid().v, map.grid().u) +
                       " views, but the light field " + light_field.info().name + " has " +
                       size_text(light_field.grid().v, light_field.grid().u) +
                       "; open the light field that the result belongs to.");
  }
}

bool is_of_other_samples(const Estimate& estimate, const LightField& light_field) {
  return estimate.source_hash != 0 && estimate.source_hash != light_field.sample_hash();
}

}  // namespace episcope
