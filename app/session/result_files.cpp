// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/result_files.h"

#include "app/session/command_line.h"
#include "app/session/load_scene.h"
#include "app/session/result_fit.h"
#include "app/session/scene_summary.h"
#include "engine/core/disparity_field.h"
#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/hash.h"
#include "engine/core/shear.h"
#include "engine/core/text.h"
#include "engine/io/base/exchange_files.h"
#include "engine/io/base/files.h"
#include "engine/io/base/hdf5_file.h"
#include "engine/io/base/image_file.h"
#include "engine/io/base/image_header.h"
#include "engine/io/base/npy.h"
#include "engine/io/formats/array_reader.h"
#include "engine/io/formats/mosaic_layout.h"
#include "engine/io/formats/mosaic_reader.h"
#include "engine/io/formats/tiff_pages.h"
#include "engine/io/formats/write_arrays.h"
#include "engine/io/models/external_result.h"
#include "engine/io/models/map_padding.h"
#include "engine/io/models/reader.h"
#include "engine/io/models/result_file.h"
#include "engine/io/models/scribble_file.h"
#include "engine/io/models/stored_maps.h"
#include "engine/render/shade.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

namespace episcope {
namespace {

namespace fs = std::filesystem;

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
  return !holds_light_field(file) && std::ranges::any_of(datasets, io::can_be_map);
}

/// The views that a map from elsewhere covers.
GridShape grid_of_map(const fs::path& path) {
  GridShape grid{1, 1};
  if (suffix_of(path) == ".npy" || io::is_map_archive(path)) return io::grid_of_arrays(path);
  if (!io::has_hdf5_signature(path)) return grid;
  const io::Hdf5Input file(path);
  for (const auto& dataset : file.datasets()) {
    if (!io::can_be_map(dataset) || dataset.shape.size() != 4) continue;
    grid = io::stated_map_layout(file, dataset).grid();
  }
  return grid;
}

/// A map alone, or one of all views by its name: other arrays of four axes are gray light fields.
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

bool are_on_their_side(const ViewStack<float>& maps, const LightField& light_field) {
  const int height = light_field.height(), width = light_field.width();
  return height != width && maps.height() == width && maps.width() == height;
}

bool names_result(const std::string& path) {
  if (!builtin_scene_id(path).empty() || !io::is_file(path)) return false;
  const std::string suffix = suffix_of(path);
  if (suffix == ".npy") return is_npy_result(path);
  if (suffix == ".tif" || suffix == ".tiff") return is_tiff_map(path);
  return suffix == ".pfm" || suffix == ".csv" || io::is_result_file(path) ||
         is_foreign_hdf5_result(path) || io::is_map_archive(path);
}

namespace {

/// Refuses maps of any other program that lie on their side.
void require_upright(const Estimate& estimate, const LightField& light_field,
                     const fs::path& path) {
  const auto& map = estimate.field.disparity;
  if (!are_on_their_side(map, light_field)) return;
  throw IoError(path, "the maps have " + size_text(map.width(), map.height()) +
                          " pixels, but the views " +
                          size_text(light_field.width(), light_field.height()) +
                          ": rows and columns are exchanged; add --map-transpose");
}

/// Refuses maps that are a little larger than the views: which part belongs to these is not told.
void require_no_padding(const Estimate& estimate, const LightField& light_field,
                        const fs::path& path) {
  constexpr int kWidestPadding = 64;
  const auto& map = estimate.field.disparity;
  const int below = map.height() - light_field.height(), right = map.width() - light_field.width();
  const bool is_padded = std::min(below, right) >= 0 && std::max(below, right) > 0 &&
                         std::max(below, right) <= kWidestPadding;
  if (!is_padded) return;
  throw IoError(path, "the maps have " + size_text(map.width(), map.height()) +
                          " pixels, but the views " +
                          size_text(light_field.width(), light_field.height()) +
                          ": if they are padded, add --map-crop corner (on the right and below) or "
                          "--map-crop middle");
}

/// Drops what no longer has the size of the disparity beside it.
void keep_fitting_maps(Estimate& estimate) {
  const ViewStack<float>& maps = estimate.field.disparity;
  const auto fits = [&maps](const ViewStack<float>& other) {
    return other.height() == maps.height() && other.width() == maps.width();
  };
  if (!fits(estimate.confidence)) estimate.confidence = {};
  if (!fits(estimate.second.disparity)) estimate.second = {};
}

void remove_padding_of(Estimate& estimate, const LightField& light_field) {
  const bool is_own = !estimate.version.empty();
  if (is_own || !estimate.layered.layers.empty()) return;
  const std::string note =
      io::remove_padding(estimate.field, light_field.height(), light_field.width());
  if (!note.empty()) estimate.notes.push_back(note);
  keep_fitting_maps(estimate);
}

void find_border_of(Estimate& estimate, const LightField& light_field) {
  const io::BareBorder border =
      io::find_bare_border(estimate.field, light_field.height(), light_field.width());
  estimate.border_px = border.width_px;
  if (!border.note.empty()) estimate.notes.push_back(border.note);
  keep_fitting_maps(estimate);
}

bool is_hdf5_light_field(const fs::path& path) {
  return io::is_file(path) && io::has_hdf5_signature(path) &&
         holds_light_field(io::Hdf5Input(path)) && !io::is_result_file(path);
}

}  // namespace

bool names_light_field_only(const std::string& path) {
  return !builtin_scene_id(path).empty() || io::is_folder(path) || is_hdf5_light_field(path);
}

Estimate read_result_of(const LightField& light_field, const fs::path& path,
                        const io::MapReading& reading) {
  if (io::is_segmentation_file(path)) {
    throw IoError(path, std::string("holds labels and no disparity; ") + io::kRemedyForLabels);
  }
  if (is_hdf5_light_field(path)) {
    throw IoError(path,
                  "holds a light field or true depth and no estimated disparity; name a result");
  }
  Estimate estimate = io::read_result(path, light_field.grid(), light_field.info().name);
  io::apply_reading(reading, &light_field, estimate);
  require_upright(estimate, light_field, path);
  remove_padding_of(estimate, light_field);
  require_no_padding(estimate, light_field, path);
  if (!io::is_result_file(path) && estimate.border_px == 0) find_border_of(estimate, light_field);
  check_fits(estimate, light_field, path.string());
  return estimate;
}

Estimate result_from_maps(const LightField& light_field, DisparityField maps,
                          const std::string& method, const io::MapReading& reading) {
  Estimate estimate;
  estimate.field = std::move(maps);
  estimate.method = method;
  io::mark_invalid(estimate.field);
  io::apply_reading(reading, &light_field, estimate);
  remove_padding_of(estimate, light_field);
  if (estimate.border_px == 0) find_border_of(estimate, light_field);
  check_fits(estimate, light_field, method);
  return estimate;
}

Estimate read_result_alone(const fs::path& path, const io::MapReading& reading) {
  // Larger than any: a result file says itself where in the grid its views are.
  constexpr GridShape any_grid{1 << 14, 1 << 14};
  Estimate estimate =
      io::read_result(path, io::is_result_file(path) ? any_grid : grid_of_map(path));
  io::apply_reading(reading, nullptr, estimate);
  return estimate;
}

namespace {

IoError contradiction(const std::string& result, const std::string& key,
                      const ParameterValue& given, const ParameterValue* stored) {
  const std::string was =
      stored ? "with" + reading_options_text({{key, *stored}}) : "without --" + key;
  return {result, "was made " + was + ", but" + reading_options_text({{key, given}}) +
                      " was asked for; leave --" + key + " out, or name the file of another run"};
}

}  // namespace

io::OpenOptions options_for_result(const std::string& result, const Reading& of_result,
                                   const std::string& input, const ParameterSet& given) {
  const Schema<io::OpenOptions> schema = io::open_schema();
  const io::OpenOptions asked = schema.parse(given);
  if (of_result.reader.empty()) return asked;
  const ParameterValue* focus = find_value(given, Reading::kFocus);
  if (focus && asked.focus_px != of_result.focus_px()) {
    throw contradiction(result, Reading::kFocus, *focus, of_result.find(Reading::kFocus));
  }
  ParameterSet options = given;
  const bool is_same_form = reader_of(input, asked) == of_result.reader;
  for (const auto& [key, stored] : of_result.options) {
    if (!is_same_form && key != Reading::kFocus) continue;
    const ParameterValue* known = find_value(given, key);
    if (!known) options.emplace_back(key, stored);
    if (known && !(*known == stored)) throw contradiction(result, key, *known, &stored);
  }
  return schema.parse(options);
}

void bring_to_focus(Estimate& estimate, const LightField& light_field, const Progress& progress) {
  if (estimate.reading.reader.empty()) return;
  const double moved_px = light_field.info().reading.focus_px() - estimate.reading.focus_px();
  if (moved_px == 0) return;
  // It comes from the same samples if its light field would, at that plane, be this one.
  const std::uint64_t hash = estimate.source_hash == 0 ? 0 : light_field.sample_hash();
  estimate = sheared(estimate, {light_field.center(), hash}, moved_px, progress);
}

std::string source_text(const std::string& input, const fs::path& result) {
  if (input.empty() || !builtin_scene_id(input).empty()) return input;
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

std::string absolute_path(const std::string& text, const fs::path& result) {
  return (result.parent_path() / text).lexically_normal().string();
}

bool is_there(const std::string& input, const ParameterSet& reading) {
  if (!builtin_scene_id(input).empty()) return true;
  if (!io::is_folder(input)) return io::is_there(input);
  try {
    return !reader_of(input, io::open_schema().parse(reading)).empty();
  } catch (const IoError&) {
    return true;  // damaged, which opening it tells
  }
}

std::string existing_source(const std::string& source, const fs::path& result) {
  if (source.empty() || !builtin_scene_id(source).empty()) return source;
  // An absolute path stands for itself.
  const std::string input = (result.parent_path() / source).string();
  return is_there(input, io::read_reading(result).options) ? input : std::string();
}

std::string stated_source(const fs::path& result) {
  if (!io::is_result_file(result)) return {};
  return io::Hdf5Input(result).text(io::kResultGroup, "source").value_or("");
}

bool is_same_input(const std::string& a, const std::string& b) {
  const auto place = [](const fs::path& path) {
    return path.filename() == "lf.h5" ? path.parent_path() : path;
  };
  std::error_code ignored;
  return a == b || fs::equivalent(place(a), place(b), ignored);
}

namespace {

std::uint64_t stated_hash(const fs::path& result) {
  return hash_from_digits(io::Hdf5Input(result).text(io::kResultGroup, "source_hash").value_or(""));
}

/// Whether a folder is a light field; one plain picture alone need not be.
bool is_light_field(const fs::path& folder) {
  const io::FoundReader found = io::find_reader(folder, {});
  if (!found.reader || !io::is_image_name(found.path)) return found.reader != nullptr;
  if (io::mosaic_name(found.path) != io::MosaicName::Plain) return true;
  try {
    (void)io::find_mosaic_layout(io::decode_image(found.path), found.path, {});
    return true;
  } catch (const IoError&) {
    return false;
  }
}

}  // namespace

ResultOwner owner_of_result(const fs::path& result, const LightField* front,
                            const std::string& front_input) {
  if (io::is_result_file(result)) {
    const bool is_of_front = front && stated_hash(result) == front->sample_hash();
    return {is_of_front ? "" : existing_source(stated_source(result), result), true};
  }
  const fs::path folder = fs::absolute(result).parent_path();
  const bool is_beside_front =
      front && io::is_there(front_input) && io::is_inside_folder(front_input, folder);
  const bool has_owner = !is_beside_front && is_light_field(folder);
  return {has_owner ? folder.string() : "", false};
}

namespace {

// Of one px of disparity without a camera: what is seen is a quarter as deep as it is wide.
double z_per_px(const DisparityView& view) {
  const double length = extent(view).length();
  return length > 0 ? 0.25 * view.disparity.width / length : 1;
}

}  // namespace

std::optional<MapForm> map_form_of(const std::filesystem::path& path) {
  const std::string suffix = suffix_of(path);
  if (suffix == ".h5" || suffix == ".hdf5") return MapForm::Result;
  if (suffix == ".pfm") return MapForm::Pfm;
  if (suffix == ".tif" || suffix == ".tiff") return MapForm::Tiff;
  if (suffix == ".csv") return MapForm::Csv;
  if (suffix == ".npy") return MapForm::Npy;
  if (suffix == ".npz") return MapForm::Npz;
  if (suffix == ".mat") return MapForm::Mat;
  if (suffix == ".ply") return MapForm::PointCloud;
  return std::nullopt;
}

bool holds_all_views(MapForm form) {
  return form == MapForm::Result || form == MapForm::Npy || form == MapForm::Npz ||
         form == MapForm::Mat;
}

void save_result(const std::filesystem::path& path, const Estimate& estimate,
                 const std::string& input, const Progress& progress) {
  io::write_result(path, estimate, progress, {.source = source_text(input, path)});
}

namespace {

template <class T>
ViewStack<T> one_view(const ViewStack<T>& stack, ViewIndex view) {
  if (stack.empty() || !stack.contains(view)) return {};
  ViewStack<T> one({1, 1}, stack.height(), stack.width(), stack.channels(), view);
  std::copy_n(stack.view(view).data, one.size(), one.data());
  return one;
}

DisparityField one_view(const DisparityField& field, ViewIndex view) {
  return {one_view(field.disparity, view), one_view(field.valid, view)};
}

}  // namespace

Estimate one_view(const Estimate& estimate, ViewIndex view) {
  Estimate one;
  one.set_provenance(estimate.provenance());
  one.field = one_view(estimate.field, view);
  one.confidence = one_view(estimate.confidence, view);
  one.second = one_view(estimate.second, view);
  one.layered.foreground = one_view(estimate.layered.foreground, view);
  one.layered.background = one_view(estimate.layered.background, view);
  one.layered.layers = one_view(estimate.layered.layers, view);
  return one;
}

void save_map(const fs::path& path, const Estimate& estimate, ViewIndex view) {
  save_maps(path, one_view(estimate, view));
}

void save_maps(const fs::path& path, const Estimate& estimate) {
  const MapForm form = map_form_of(path).value_or(MapForm::Tiff);
  if (form == MapForm::Npz) return io::write_npz_maps(path, estimate);
  if (form == MapForm::Mat) return io::write_mat_maps(path, estimate);
  const ViewStack<float> maps = io::disparity_with_nan(estimate.field);
  if (form == MapForm::Npy) return io::write_npy_maps(path, maps);
  const ImageView<const float> first = std::as_const(maps).view(maps.first());
  if (form == MapForm::Pfm) return io::write_pfm(path, first);
  if (form == MapForm::Csv) return io::write_csv_map(path, first);
  io::write_tiff(path, first);
}

void save_point_cloud(const std::filesystem::path& path, const LightField& light_field,
                      ViewIndex view, const DisparityView& map) {
  const ShownDisparity shown(map, light_field.valid_of(view));
  io::write_ply(path, make_point_cloud(shown.view(), light_field.info().camera,
                                       render::shade_view(light_field, view),
                                       {.z_per_px = z_per_px(shown.view())}));
}

}  // namespace episcope
