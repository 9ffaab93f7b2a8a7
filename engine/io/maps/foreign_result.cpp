// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/maps/foreign_result.h"

#include "engine/core/error.h"
#include "engine/core/text/join.h"
#include "engine/core/text/suffix.h"
#include "engine/io/arrays/array_samples.h"
#include "engine/io/arrays/npy_file.h"
#include "engine/io/durable/system_error.h"
#include "engine/io/grid/decode_image.h"
#include "engine/io/hdf5/hdf5_file.h"
#include "engine/io/maps/parse_number.h"
#include "engine/io/maps/pfm.h"
#include "engine/io/maps/submission_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <vector>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

DisparityField center_field(const fs::path& path, const Image<float>& map, GridShape grid) {
  if (map.channels() != 1) {
    throw IoError(
        path, fmt::format("this map has {} channels, but a disparity map has 1; export it again",
                          map.channels()));
  }
  DisparityField field;
  field.disparity = ViewStack<float>({1, 1}, map.height(), map.width(), 1, grid.center());
  std::copy_n(map.data(), map.size(), field.disparity.data());
  mark_invalid(field);
  return field;
}

Image<float> read_float_tiff(const fs::path& path) {
  AnyImage decoded = decode_image(path);
  if (auto* map = std::get_if<Image<float>>(&decoded)) return std::move(*map);
  throw IoError(path,
                "this picture has " + describe_image(decoded) +
                    ", but a disparity map needs 32-bit float samples; export it in that format");
}

/// The one dataset of an HDF5 file that can be a disparity map.
Hdf5Dataset find_map(const Hdf5Input& file) {
  std::vector<Hdf5Dataset> maps;
  for (const Hdf5Dataset& dataset : file.datasets()) {
    const bool is_map = dataset.shape.size() == 2 || dataset.shape.size() == 4;
    if (!is_map || dataset.type != Hdf5Type::Float) continue;
    maps.push_back(dataset);
  }
  if (maps.size() == 1) return maps.front();
  // Several float datasets are not ambiguous if only one has the expected name.
  const auto is_named = [](const Hdf5Dataset& map) {
    return lower_case(map.name).find("disp") != std::string::npos;
  };
  if (std::ranges::count_if(maps, is_named) == 1) return *std::ranges::find_if(maps, is_named);
  for (const Hdf5Dataset& map : maps) {
    if (lower_case(map.name) == "disparity") return map;
  }
  const std::string found = maps.empty() ? "none was found"
                                         : fmt::format("{} were found ({})", maps.size(),
                                                       joined(maps, ", ", &Hdf5Dataset::name));
  throw IoError(file.path(),
                fmt::format("one dataset of float samples with 2 or 4 axes is expected, but {}; "
                            "store the disparity alone",
                            found));
}

DisparityField read_hdf5_map(const fs::path& path, GridShape grid) {
  const Hdf5Input file(path);
  const Hdf5Dataset map = find_map(file);
  const auto length = [&](std::size_t axis) { return static_cast<int>(map.shape[axis]); };
  const std::size_t rank = map.shape.size();
  const bool is_single = rank == 2 || (map.shape[0] == 1 && map.shape[1] == 1);
  const GridShape stored = is_single ? GridShape{1, 1} : GridShape{length(0), length(1)};
  if (std::any_of(map.shape.begin(), map.shape.end(), [](std::size_t n) { return n == 0; })) {
    throw IoError(path, "the dataset " + map.name + " is empty; export it again");
  }
  if (!is_single && !(stored == grid)) {
    throw IoError(path, fmt::format("the dataset {} has the shape {}, but the light field has "
                                    "{}×{} views; name the light field that it belongs to",
                                    map.name, shape_text(map.shape), grid.v, grid.u));
  }
  DisparityField field;
  field.disparity = ViewStack<float>(stored, length(rank - 2), length(rank - 1), 1,
                                     is_single ? grid.center() : ViewIndex{});
  file.read(map.name, {Hdf5Shape(rank, 0), map.shape}, field.disparity.data());
  mark_invalid(field);
  return field;
}

/// `[y][x]`, or `[v][u][y][x]`.
DisparityField read_npy_field(const fs::path& path, GridShape grid) {
  const NpyFile file(path);
  if (file.shape().size() != 4) return center_field(path, read_npy_map(path), grid);
  const ArrayLayout layout{
      file.shape(), in_index_order(std::string("vuyx"),
                                   file.header().is_fortran ? IndexOrder::Fortran : IndexOrder::C)};
  if (layout.has_one_view()) return center_field(path, read_npy_map(path), grid);
  if (!(layout.grid() == grid)) {
    throw IoError(path, fmt::format("the array has the shape {}, but the light field has {}×{} "
                                    "views; name the light field that it belongs to",
                                    array_shape_text(file.header().shape), grid.v, grid.u));
  }
  DisparityField field;
  field.disparity = read_map_stack<float>(file, layout, Progress(1));
  mark_invalid(field);
  return field;
}

/// `disp_maps/<scene>.pfm`, or the only map if no scene is named.
fs::path submitted_map(const fs::path& folder, const std::string& scene) {
  const fs::path named = submitted_map_file(folder, scene);
  const fs::path maps = named.parent_path();
  if (!fs::is_directory(maps)) {
    throw IoError(folder,
                  "this folder has no disp_maps, unlike a submission to the 2016 benchmark; name a "
                  "result file");
  }
  if (!scene.empty() && fs::exists(named)) return named;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(maps)) {
    if (suffix_of(entry.path()) == ".pfm") found.push_back(entry.path());
  }
  if (found.size() == 1 && scene.empty()) return found.front();
  throw IoError(maps, fmt::format("there is no map {}.pfm among the {} here; name the scene",
                                  scene.empty() ? "<scene>" : scene, found.size()));
}

double read_seconds(const fs::path& path) {
  std::ifstream in(path);
  std::string word;
  if (!(in >> word)) return 0;
  return std::max(0.0, parse_number(word).value_or(0));
}

}  // namespace

void mark_invalid(DisparityField& field) {
  float* begin = field.disparity.data();
  float* end = begin + field.disparity.size();
  if (std::all_of(begin, end, [](float d) { return std::isfinite(d); })) return;
  if (field.valid.empty()) {
    const ViewStack<float>& like = field.disparity;
    field.valid =
        ViewStack<std::uint8_t>(like.grid(), like.height(), like.width(), 1, like.first());
    std::fill_n(field.valid.data(), field.valid.size(), std::uint8_t{1});
  }
  for (float* d = begin; d != end; ++d) {
    if (std::isfinite(*d)) continue;
    *d = 0;
    field.valid.data()[d - begin] = 0;
  }
}

DisparityField read_disparity_map(const fs::path& path, GridShape grid) {
  require_readable_file(path);
  const std::string suffix = suffix_of(path);
  if (suffix == ".pfm") return center_field(path, read_pfm_map(path), grid);
  if (suffix == ".npy") return read_npy_field(path, grid);
  if (suffix == ".tif" || suffix == ".tiff") {
    return center_field(path, read_float_tiff(path), grid);
  }
  if (has_hdf5_signature(path) || suffix == ".h5" || suffix == ".hdf5") {
    return read_hdf5_map(path, grid);
  }
  throw IoError(
      path,
      "this is not a disparity map: a result file, another HDF5 file, a PFM, a float TIFF "
      "or an .npy array is expected; choose another file");
}

Estimate read_foreign_result(const fs::path& path, GridShape grid, const std::string& scene) {
  Estimate estimate;
  if (!fs::is_directory(path)) {
    estimate.field = read_disparity_map(path, grid);
    estimate.method = path.stem().string();
    return estimate;
  }
  const fs::path map = submitted_map(path, scene);
  estimate.field = read_disparity_map(map, grid);
  estimate.method = fs::absolute(path / "x").parent_path().filename().string();
  estimate.source = map.stem().string();
  estimate.seconds = read_seconds(submitted_runtime_file(path, map.stem().string()));
  return estimate;
}

}  // namespace episcope::io
