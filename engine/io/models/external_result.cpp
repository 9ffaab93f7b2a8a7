// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/external_result.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/text.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/exchange_files.h"
#include "engine/io/base/files.h"
#include "engine/io/base/hdf5_file.h"
#include "engine/io/base/image_file.h"
#include "engine/io/base/npy.h"
#include "engine/io/base/tiff_file.h"
#include "engine/io/models/array_file.h"
#include "engine/io/models/array_samples.h"
#include "engine/io/models/choose_layout.h"
#include "engine/io/models/mat5.h"
#include "engine/io/models/numpy_file.h"
#include "engine/io/models/sidecar_maps/map_name.h"
#include "engine/io/models/stored_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <system_error>

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

/// The channel of depth, else the first: maps are written as grey, or with the same value in all.
Image<float> read_exr_map(const fs::path& path) {
  const AnyImage decoded = decode_image(path, PicturePart::Depth);
  const auto* image = std::get_if<Image<float>>(&decoded);
  if (image == nullptr) {
    throw IoError(path, "this picture has " + describe_image(decoded) +
                            ", but a map needs 32-bit float samples; export it in that format");
  }
  Image<float> map(image->height(), image->width());
  for (std::size_t i = 0; i < map.size(); ++i) {
    map.data()[i] = image->data()[i * static_cast<std::size_t>(image->channels())];
  }
  return map;
}

Image<float> read_float_tiff(const fs::path& path) {
  AnyImage decoded = decode_image(path);
  if (auto* map = std::get_if<Image<float>>(&decoded)) return std::move(*map);
  throw IoError(path,
                "this picture has " + describe_image(decoded) +
                    ", but a disparity map needs 32-bit float samples; export it in that format");
}

/// How many pages of the size of the first one follow each other, up to one more than `most`:
/// smaller ones are reduced copies.
int count_full_pages(const fs::path& path, int most) {
  constexpr std::uint64_t kWidth = 256, kHeight = 257;
  TiffFile file(path);
  const std::vector<std::uint64_t> pages = file.directories(most);
  const auto length = [&](std::uint64_t page, std::uint64_t tag) {
    const auto value = file.tag(page, tag);
    return value ? value->number : 0;
  };
  int count = 0;
  for (const std::uint64_t page : pages) {
    const bool is_full = length(page, kWidth) == length(pages.front(), kWidth) &&
                         length(page, kHeight) == length(pages.front(), kHeight);
    if (!is_full) break;
    ++count;
  }
  return count;
}

/// The map of the center view, or a page for each view, row by row.
DisparityField read_tiff_maps(const fs::path& path, GridShape grid) {
  const int pages = count_full_pages(path, grid.count());
  if (pages < 2) return center_field(path, read_float_tiff(path), grid);
  if (pages != grid.count()) {
    throw IoError(path,
                  fmt::format("this file has {} pages, but maps of one view or of {}×{} views "
                              "are expected, row by row; save the page of the center view "
                              "alone, or one for each view",
                              pages > grid.count() ? fmt::format("more than {}", grid.count())
                                                   : std::to_string(pages),
                              grid.v, grid.u));
  }
  DisparityField field;
  const std::vector<SeenImage> decoded = decode_pages(path, pages);
  for (int i = 0; i < pages; ++i) {
    const auto* map = std::get_if<Image<float>>(&decoded[static_cast<std::size_t>(i)].image);
    if (!map || map->channels() != 1) return center_field(path, read_float_tiff(path), grid);
    ViewStack<float>& maps = field.disparity;
    if (i == 0) maps = ViewStack<float>(grid, map->height(), map->width());
    std::copy_n(map->data(), map->size(), maps.view(grid.view_at(i)).data);
  }
  mark_invalid(field);
  return field;
}

bool names_disparity(const std::string& name) {
  return lower_case(name).find("disp") != std::string::npos;
}

/// Without those that claim to be true, if there are others: an estimate is looked for.
template <class T, class NameOf>
void leave_out_truth(std::vector<T>& maps, const NameOf& name_of) {
  const auto is_true = [&](const T& map) { return map_claim(name_of(map)) == MapClaim::True; };
  if (!std::ranges::all_of(maps, is_true)) std::erase_if(maps, is_true);
}

/// The place, among the names of all arrays that can be a disparity map, of the one that is meant:
/// the only one, or the only one of the expected name. `what`: what an array is called.
std::size_t meant_map(const fs::path& path, const std::vector<std::string>& names,
                      const std::string& what) {
  if (names.size() == 1) return 0;
  const auto place_of = [&names](const auto& found) {
    return static_cast<std::size_t>(found - names.begin());
  };
  if (std::ranges::count_if(names, names_disparity) == 1) {
    return place_of(std::ranges::find_if(names, names_disparity));
  }
  const auto exact = std::ranges::find_if(
      names, [](const std::string& name) { return lower_case(name) == "disparity"; });
  if (exact != names.end()) return place_of(exact);
  const std::string found =
      names.empty() ? "none was found"
                    : fmt::format("{} were found ({})", names.size(), joined(names, ", "));
  throw IoError(path, fmt::format("one {} with 2 or 4 axes is expected, but {}; store the "
                                  "disparity {}",
                                  what, found, names.empty() ? "as one" : "alone"));
}

}  // namespace

bool can_be_map(const Hdf5Dataset& dataset) {
  const bool has_axes = dataset.shape.size() == 2 || dataset.shape.size() == 4;
  const bool has_numbers = dataset.type == Hdf5Type::Float ||
                           (dataset.type != Hdf5Type::Other && names_disparity(dataset.name));
  return has_axes && has_numbers;
}

namespace {

/// The one dataset of an HDF5 file that can be a disparity map: of floats, else of whole numbers.
Hdf5Dataset find_map(const Hdf5Input& file) {
  std::vector<Hdf5Dataset> maps = file.datasets();
  std::erase_if(maps, [](const Hdf5Dataset& dataset) { return !can_be_map(dataset); });
  const auto is_float = [](const Hdf5Dataset& map) { return map.type == Hdf5Type::Float; };
  if (std::ranges::any_of(maps, is_float)) std::erase_if(maps, std::not_fn(is_float));
  for (const Hdf5Dataset& other : maps.empty() ? file.datasets() : std::vector<Hdf5Dataset>()) {
    const std::string fault = file.fault_of(other.name);
    if (fault.empty() || other.shape.size() < 2) continue;
    throw IoError(file.path(), "the dataset " + other.name + " " + fault +
                                   "; store numbers alone, each field as a dataset of its own");
  }
  leave_out_truth(maps, [](const Hdf5Dataset& map) { return map.name; });
  std::vector<std::string> names;
  for (const Hdf5Dataset& map : maps) names.push_back(map.name);
  return maps[meant_map(file.path(), names, "dataset of float samples")];
}

/// The axes of an array that can be a disparity map; empty for any other, such as a single number.
std::string map_axes_of(const ArrayEntry& entry) {
  const std::size_t rank = entry.shape.size();
  if (!entry.other_kind.empty() || (rank != 2 && rank != 4)) return {};
  const std::string usual = rank == 2 ? "yx" : "vuyx";
  const std::string axes =
      entry.is_of_views() ? joined_axes(entry) : in_index_order(usual, entry.order);
  const ArrayLayout layout{entry.shape, axes};
  return layout.height() > 1 && layout.width() > 1 ? axes : std::string();
}

/// Whether views of a light field are among the arrays: rather that than maps by name or axes.
bool holds_light_field(const ArrayFile& file) {
  return std::ranges::any_of(light_fields_of(file, {}), [](const ArrayEntry* entry) {
    const bool has_views = entry->shape.size() > 3 || entry->is_of_views();
    return !has_other_name(*entry) && (has_views || has_light_field_name(*entry));
  });
}

/// Numbers with the meaning of their axes.
struct PlacedArray {
  std::unique_ptr<const ArrayInput> array;
  ArrayLayout layout;
};

/// The one array of a file that can be a disparity map: of floats, else of whole numbers.
PlacedArray find_map(const ArrayFile& file) {
  std::vector<const ArrayEntry*> maps;
  for (const bool are_floats : {true, false}) {
    for (const ArrayEntry& entry : file.entries()) {
      if (is_float(entry.type) == are_floats && !map_axes_of(entry).empty()) maps.push_back(&entry);
    }
    if (!maps.empty()) break;
  }
  leave_out_truth(maps, [](const ArrayEntry* map) { return map->name; });
  std::vector<std::string> names;
  for (const ArrayEntry* map : maps) names.push_back(map->name);
  const ArrayEntry& meant = *maps[meant_map(file.path(), names, "array of numbers")];
  return {file.open(meant), {meant.shape, map_axes_of(meant)}};
}

/// Opens an `.npz` or a MATLAB file of version 5 to 7; null for other files.
std::unique_ptr<const ArrayFile> open_map_archive(const fs::path& path) {
  if (suffix_of(path) == ".npz") return std::make_unique<const NumpyFile>(path);
  return is_mat5_file(path) ? open_matlab_file(path) : nullptr;
}

PlacedArray open_npy_maps(const fs::path& path) {
  auto file = std::make_unique<const NpyFile>(path);
  const IndexOrder order = file->header().is_fortran ? IndexOrder::Fortran : IndexOrder::C;
  const ArrayLayout layout{file->shape(), in_index_order(std::string("vuyx"), order)};
  return {std::move(file), layout};
}

DisparityField read_hdf5_map(const fs::path& path, GridShape grid) {
  const Hdf5Input file(path);
  const Hdf5Dataset map = find_map(file);
  if (std::any_of(map.shape.begin(), map.shape.end(), [](std::size_t n) { return n == 0; })) {
    throw IoError(path, "the dataset " + map.name + " is empty; export it again");
  }
  const ArrayLayout layout = stated_map_layout(file, map);
  if (!layout.has_one_view() && !(layout.grid() == grid)) {
    throw IoError(path, fmt::format("the dataset {} has the shape {}, but the light field has "
                                    "{}×{} views; name the light field that it belongs to",
                                    map.name, layout_text(layout, IndexOrder::C), grid.v, grid.u));
  }
  DisparityField field;
  field.disparity = read_laid_out<float>(file, map.name, layout,
                                         layout.has_one_view() ? grid.center() : ViewIndex{});
  float* const begin = field.disparity.data();
  float* const end = begin + field.disparity.size();
  for (const char* name : {"_FillValue", "missing_value"}) {  // of netCDF and xarray
    const auto none = file.number(map.name, name);
    if (none)
      std::replace(begin, end, static_cast<float>(*none), std::numeric_limits<float>::quiet_NaN());
  }
  const double scale = file.number(map.name, "scale_factor").value_or(1);
  const double offset = file.number(map.name, "add_offset").value_or(0);
  std::transform(begin, end, begin,
                 [=](float value) { return static_cast<float>(value * scale + offset); });
  mark_invalid(field);
  return field;
}

DisparityField read_placed(const PlacedArray& maps, GridShape grid) {
  const ArrayLayout& layout = maps.layout;
  const fs::path& path = maps.array->path();
  if (!layout.has_one_view() && !(layout.grid() == grid)) {
    throw IoError(path, fmt::format("the array has {}×{} maps of {}×{} pixels, but the light field "
                                    "has {}×{} views; name the light field that it belongs to",
                                    layout.grid().v, layout.grid().u, layout.width(),
                                    layout.height(), grid.v, grid.u));
  }
  DisparityField field;
  field.disparity = read_map_stack<float>(*maps.array, layout, Progress(1));
  if (layout.has_one_view()) {
    ViewStack<float> center({1, 1}, layout.height(), layout.width(), 1, grid.center());
    std::copy_n(field.disparity.data(), center.size(), center.data());
    field.disparity = std::move(center);
  }
  mark_invalid(field);
  return field;
}

/// `[y][x]`, or `[v][u][y][x]`.
DisparityField read_npy_field(const fs::path& path, GridShape grid) {
  if (NpyFile(path).shape().size() != 4) return center_field(path, read_npy_map(path), grid);
  return read_placed(open_npy_maps(path), grid);
}

DisparityField read_archive_field(const ArrayFile& file, GridShape grid) {
  if (holds_light_field(file)) {
    throw IoError(file.path(), "holds a light field and no estimated disparity; name a result");
  }
  return read_placed(find_map(file), grid);
}

bool has_size_of(const ViewStack<float>& maps, const ArrayLayout& layout) {
  return layout.grid() == maps.grid() && layout.height() == maps.height() &&
         layout.width() == maps.width();
}

/// The array of this name, if there is one of the shape of `maps`, for the same views; else empty.
ViewStack<float> read_beside(const fs::path& path, const std::string& name,
                             const ViewStack<float>& maps) {
  ViewStack<float> read;
  if (const auto archive = open_map_archive(path)) {
    const auto found = std::ranges::find(archive->entries(), name, &ArrayEntry::name);
    if (found == archive->entries().end() || map_axes_of(*found).empty()) return {};
    const ArrayLayout layout{found->shape, map_axes_of(*found)};
    if (!has_size_of(maps, layout)) return {};
    read = read_map_stack<float>(*archive->open(*found), layout, Progress(1));
  } else if (has_hdf5_signature(path)) {
    const Hdf5Input file(path);
    const std::vector<Hdf5Dataset> all = file.datasets();
    const auto found = std::ranges::find(all, name, &Hdf5Dataset::name);
    if (found == all.end() || (found->shape.size() != 2 && found->shape.size() != 4)) return {};
    const ArrayLayout layout = stated_map_layout(file, *found);
    if (!has_size_of(maps, layout)) return {};
    read = read_laid_out<float>(file, name, layout, {});
  }
  if (read.empty()) return {};
  read.keep_in_place({}, maps.grid(), maps.first());
  return read;
}

/// Adds what write_npz_maps and write_mat_maps store beside disparity, or another program under
/// the same names.
void add_maps_beside(const fs::path& path, Estimate& estimate) {
  const ViewStack<float>& maps = estimate.field.disparity;
  estimate.confidence = read_beside(path, "confidence", maps);
  const float* confidence = estimate.confidence.data();
  const auto is_share = [](float value) { return value >= 0 && value <= 1; };
  if (!std::all_of(confidence, confidence + estimate.confidence.size(), is_share)) {
    estimate.confidence = {};
    estimate.notes.emplace_back(finding_text("result.confidence"));
  }
  estimate.second.disparity = read_beside(path, "disparity_second", maps);
  mark_invalid(estimate.second);
  const ViewStack<float> valid = read_beside(path, "valid", maps);
  if (valid.empty()) return;
  estimate.field.require_mask();
  for (std::size_t i = 0; i < valid.size(); ++i) {
    if (!(valid.data()[i] > 0)) estimate.field.valid.data()[i] = 0;
  }
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
  field.require_mask();
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
    return read_tiff_maps(path, grid);
  }
  if (suffix == ".exr") return center_field(path, read_exr_map(path), grid);
  if (has_text_suffix(path)) return center_field(path, read_text_map(path), grid);
  if (const auto archive = open_map_archive(path)) return read_archive_field(*archive, grid);
  if (has_hdf5_signature(path) || has_hdf5_name(path)) {
    return read_hdf5_map(path, grid);
  }
  throw IoError(path, std::string("this is not a disparity map: a result file, ") + kMapForms +
                          " is expected; choose another file");
}

bool is_map_archive(const fs::path& path) {
  try {
    const auto file = open_map_archive(path);
    const auto is_map = [](const ArrayEntry& entry) { return !map_axes_of(entry).empty(); };
    return file && !holds_light_field(*file) && std::ranges::any_of(file->entries(), is_map);
  } catch (const Error&) {
    return false;
  }
}

GridShape grid_of_arrays(const fs::path& path) {
  if (const auto file = open_map_archive(path)) return find_map(*file).layout.grid();
  return NpyFile(path).shape().size() == 4 ? open_npy_maps(path).layout.grid() : GridShape{1, 1};
}

Estimate read_external_result(const fs::path& path, GridShape grid, const std::string& scene) {
  Estimate estimate;
  if (!fs::is_directory(path)) {
    estimate.field = read_disparity_map(path, grid);
    add_maps_beside(path, estimate);
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

namespace {

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
std::string without_blanks(std::string text) {
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
    return without_blanks(line);
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
  const std::optional<double> seconds = parse_number(without_blanks(first_line(path)));
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
