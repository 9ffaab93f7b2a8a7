// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/sidecar_maps/map_file.h"

#include "engine/core/error.h"
#include "engine/core/numbers.h"
#include "engine/core/text.h"
#include "engine/io/base/exchange_files.h"
#include "engine/io/base/files.h"
#include "engine/io/base/hdf5_file.h"
#include "engine/io/base/image_file.h"
#include "engine/io/base/npy.h"
#include "engine/io/models/array_maps.h"
#include "engine/io/models/array_samples.h"
#include "engine/io/models/external_result.h"
#include "engine/io/models/mat5.h"
#include "engine/io/models/numpy_file.h"
#include "engine/io/models/scribble_file.h"
#include "engine/io/models/sidecar_maps/map_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

using Kinds = std::initializer_list<MapKind>;

std::unique_ptr<const ArrayFile> open_map_archive(const fs::path& path) {
  if (suffix_of(path) == ".mat") return open_matlab_file(path);
  if (has_hdf5_name(path)) {
    return std::make_unique<const Hdf5Arrays>(std::make_shared<const Hdf5Input>(path));
  }
  return std::make_unique<const NumpyFile>(path);
}

/// The axes of an array as maps of all views or of one; empty if it is neither.
std::optional<ArrayLayout> map_layout(const ArrayEntry& entry, GridShape grid) {
  if (!entry.other_kind.empty()) return std::nullopt;
  const std::size_t rank = entry.shape.size();
  if (rank != 2 && rank != 4) return std::nullopt;
  const std::string axes = rank == 2 ? "yx" : "vuyx";
  const ArrayLayout layout{entry.shape, in_index_order(axes, entry.order)};
  const bool is_single = layout.has_one_view();
  const bool has_pixels = layout.height() > 1 && layout.width() > 1;
  if (!has_pixels || !(is_single || layout.grid() == grid)) return std::nullopt;
  return layout;
}

struct FoundMap {
  ArrayEntry entry;
  ArrayLayout layout;
};

/// The first one whose name is of these kinds.
const FoundMap* named_map(const std::vector<FoundMap>& maps, Kinds kinds) {
  const auto named = std::ranges::find_if(maps, [&](const FoundMap& map) {
    const auto kind = map_kind(last_name(map.entry.name));
    return kind && std::ranges::find(kinds, *kind) != kinds.end();
  });
  return named == maps.end() ? nullptr : &*named;
}

/// `others` are the kinds to look for where no name is of `kinds`.
FoundMap find_archived_map(const ArrayFile& file, GridShape grid, Kinds kinds, Kinds others) {
  std::vector<FoundMap> maps;
  for (const ArrayEntry& entry : file.entries()) {
    if (auto layout = map_layout(entry, grid)) maps.push_back({entry, std::move(*layout)});
  }
  if (const FoundMap* named = named_map(maps, kinds)) return *named;
  if (const FoundMap* named = named_map(maps, others)) return *named;
  if (maps.size() == 1) return maps.front();
  const std::string held = joined(file.entries(), ", ", [](const ArrayEntry& entry) {
    return entry.name + " (" + content_text(entry) + ")";
  });
  throw IoError(file.path(),
                fmt::format("the file holds {}: {} of one view or of {}×{} views; store the map "
                            "alone or name it after what it is",
                            held.empty() ? "no array" : held,
                            maps.empty() ? "no map" : "several maps", grid.v, grid.u));
}

template <class T>
ViewStack<T> read_archived(const fs::path& path, GridShape grid, Kinds kinds, Kinds others = {}) {
  const std::unique_ptr<const ArrayFile> file = open_map_archive(path);
  const FoundMap map = find_archived_map(*file, grid, kinds, others);
  return read_map_stack<T>(*file->open(map.entry), map.layout, Progress());
}

/// Reads labels from named arrays.
ViewStack<std::int32_t> read_archived_labels(const fs::path& path, GridShape grid) {
  return read_archived<std::int32_t>(path, grid, {MapKind::Labels});
}

}  // namespace

bool is_archive_of_maps(const fs::path& path) {
  const std::string suffix = suffix_of(path);
  return suffix == ".npz" || suffix == ".mat";
}

ViewStack<float> read_archived_values(const fs::path& path, GridShape grid) {
  return read_archived<float>(path, grid, {MapKind::Disparity, MapKind::Depth}, {MapKind::Labels});
}

bool holds_archived_fractions(const fs::path& path, GridShape grid) {
  const std::unique_ptr<const ArrayFile> file = open_map_archive(path);
  const FoundMap map = find_archived_map(*file, grid, {MapKind::Labels}, {});
  return is_float(map.entry.type) &&
         has_fractions(read_map_stack<float>(*file->open(map.entry), map.layout, Progress()));
}

namespace {

template <std::size_t N>
bool has_suffix(const fs::path& path, const std::array<std::string_view, N>& suffixes) {
  return std::ranges::find(suffixes, suffix_of(path)) != suffixes.end();
}

template <class T>
ViewStack<T> single(const Image<T>& image) {
  ViewStack<T> stack({1, 1}, image.height(), image.width());
  std::copy_n(image.data(), image.size(), stack.data());
  return stack;
}

/// A 4-D array of maps of all views; empty for another number of axes.
ViewStack<std::int32_t> read_label_grid(const NpyFile& file, GridShape grid) {
  if (file.shape().size() != 4) return {};
  const IndexOrder order = file.header().is_fortran ? IndexOrder::Fortran : IndexOrder::C;
  const ArrayLayout layout{file.shape(), in_index_order(std::string("vuyx"), order)};
  if (layout.grid() == grid) return read_map_stack<std::int32_t>(file, layout, Progress());
  throw IoError(file.path(),
                fmt::format("the array has the shape {}, but maps of {}×{} views are expected; "
                            "save it again or remove it",
                            shape_text(file.header().shape), grid.v, grid.u));
}

/// Values with what is not finite marked as invalid.
DisparityField marked(ViewStack<float> values) {
  DisparityField field{std::move(values), {}};
  mark_invalid(field);
  return field;
}

StoredLabels read_npy_label_maps(const fs::path& path, GridShape grid) {
  const NpyFile file(path);
  StoredLabels labels{read_label_grid(file, grid)};
  if (labels.numbers.empty()) {
    labels.numbers = single(read_label_map(file, file.header().is_fortran));
  }
  return labels;
}

std::int32_t packed_level(float value, const fs::path& path) {
  if (const auto level = whole_int(value)) return *level;
  throw IoError(path,
                "labels are expected to be whole numbers, but the image holds fractions; save "
                "labels as integers");
}

template <class T>
StoredLabels picture_labels(const Image<T>& image, const fs::path& path) {
  StoredLabels labels{ViewStack<std::int32_t>({1, 1}, image.height(), image.width())};
  const T* in = image.data();
  const std::size_t count = labels.numbers.size();
  const int channels = image.channels();
  for (std::size_t i = 0; i < count && !labels.are_colors && channels == 3; ++i) {
    labels.are_colors = in[3 * i] != in[3 * i + 1] || in[3 * i] != in[3 * i + 2];
  }
  if (labels.are_colors && !std::is_same_v<T, std::uint8_t>) {
    throw IoError(path, "colors of labels are expected in 8 bits; save labels as integers");
  }
  std::int32_t* out = labels.numbers.data();
  for (std::size_t i = 0; i < count; ++i) {
    const T* pixel = in + i * static_cast<std::size_t>(channels);
    if constexpr (std::is_same_v<T, std::uint8_t>) {
      out[i] = labels.are_colors ? packed({pixel[0], pixel[1], pixel[2]}) : pixel[0];
    } else if constexpr (std::is_same_v<T, float>) {
      out[i] = packed_level(pixel[0], path);
    } else {
      out[i] = pixel[0];
    }
  }
  return labels;
}

}  // namespace

bool can_hold_values(const fs::path& path) {
  if (has_text_suffix(path)) return true;
  return has_suffix(path, std::array<std::string_view, 9>{".npy", ".npz", ".mat", ".pfm", ".tif",
                                                          ".tiff", ".exr", ".h5", ".hdf5"});
}

bool can_hold_labels(const fs::path& path) {
  return has_suffix(
      path, std::array<std::string_view, 10>{".npy", ".npz", ".mat", ".png", ".tif", ".tiff",
                                             ".bmp", ".pgm", ".h5", ".hdf5"});
}

DisparityField read_values(const fs::path& path, GridShape grid) {
  if (is_archive_of_maps(path)) return marked(read_archived_values(path, grid));
  DisparityField field = read_disparity_map(path, grid);
  if (!(field.disparity.grid() == GridShape{1, 1}) || field.disparity.first() == ViewIndex{}) {
    return field;
  }
  // Of the center view; here all single maps are at (0, 0).
  const ViewStack<float>& map = field.disparity;
  DisparityField moved{ViewStack<float>({1, 1}, map.height(), map.width()), {}};
  std::copy_n(map.data(), map.size(), moved.disparity.data());
  if (!field.valid.empty()) {
    moved.valid = ViewStack<std::uint8_t>({1, 1}, map.height(), map.width());
    std::copy_n(field.valid.data(), field.valid.size(), moved.valid.data());
  }
  return moved;
}

StoredLabels read_stored_labels(const fs::path& path, GridShape grid) {
  if (suffix_of(path) == ".npy") return read_npy_label_maps(path, grid);
  if (is_archive_of_maps(path) || has_hdf5_name(path)) return {read_archived_labels(path, grid)};
  return std::visit([&](const auto& image) { return picture_labels(image, path); },
                    decode_image(path));
}

OwnFile own_file(const fs::path& path) {
  if (!has_hdf5_name(path) || !has_hdf5_signature(path)) return OwnFile::None;
  try {
    const Hdf5Input file(path);
    if (file.has(kTrueLabels)) return OwnFile::None;
    if (file.has("SCRIBBLES")) return OwnFile::Scribbles;
    if (file.has("LABELS")) return OwnFile::Segmentation;
    return file.has("estimate") ? OwnFile::Result : OwnFile::None;
  } catch (const IoError&) {
    return OwnFile::None;  // what is wrong with it is said when it is read
  }
}

Image<std::uint8_t> read_mask(const fs::path& path) {
  StoredLabels stored = read_stored_labels(path, {1, 1});
  const ViewStack<std::int32_t>& numbers = stored.numbers;
  Image<std::uint8_t> mask(numbers.height(), numbers.width());
  std::transform(numbers.data(), numbers.data() + numbers.size(), mask.begin(),
                 [](std::int32_t value) { return static_cast<std::uint8_t>(value != 0); });
  return mask;
}

namespace {

constexpr int kMostTimes = 8;

/// How many times `small` both sides of `large` are; 0 if it is no small whole number.
int times_of(int large_height, int large_width, int small_height, int small_width) {
  const int times = small_height > 0 ? large_height / small_height : 0;
  const bool is_whole = times > 1 && times <= kMostTimes && large_height == times * small_height &&
                        large_width == times * small_width;
  return is_whole ? times : 0;
}

DisparityField empty_like(const DisparityField& field, int height, int width) {
  const ViewStack<float>& maps = field.disparity;
  return {ViewStack<float>(maps.grid(), height, width, 1, maps.first()),
          ViewStack<std::uint8_t>(maps.grid(), height, width, 1, maps.first())};
}

/// Calls `set(view of the result, y, x)` for all pixels, with the map of the view.
template <class Set>
void for_pixels(const DisparityField& field, DisparityField& result, const Set& set) {
  const ViewStack<float>& out = result.disparity;
  for (int i = 0; i < out.grid().count(); ++i) {
    const ViewIndex view = out.grid().view_at(i, out.first());
    const DisparityView map = field.view(view);
    for (int y = 0; y < out.height(); ++y) {
      for (int x = 0; x < out.width(); ++x) set(map, view, y, x);
    }
  }
}

DisparityField reduced(const DisparityField& field, int times) {
  const ViewStack<float>& maps = field.disparity;
  DisparityField result = empty_like(field, maps.height() / times, maps.width() / times);
  std::vector<float> values;
  for_pixels(field, result, [&](const DisparityView& map, ViewIndex view, int y, int x) {
    values.clear();
    for (int i = 0; i < times * times; ++i) {
      const int from_y = times * y + i / times;
      const int from_x = times * x + i % times;
      if (map.is_valid(from_y, from_x)) values.push_back(map.disparity.at(from_y, from_x));
    }
    result.valid.view(view).at(y, x) = values.empty() ? 0 : 1;
    if (values.empty()) return;
    result.disparity.view(view).at(y, x) = quantile(values, 0.5);
  });
  return result;
}

DisparityField enlarged(const DisparityField& field, int times) {
  const ViewStack<float>& maps = field.disparity;
  DisparityField result = empty_like(field, maps.height() * times, maps.width() * times);
  for_pixels(field, result, [&](const DisparityView& map, ViewIndex view, int y, int x) {
    const bool is_there = map.is_valid(y / times, x / times);
    result.valid.view(view).at(y, x) = is_there ? 1 : 0;
    if (is_there) result.disparity.view(view).at(y, x) = map.disparity.at(y / times, x / times);
  });
  return result;
}

}  // namespace

ResampledMaps resample_to(DisparityField& field, int height, int width) {
  const int map_height = field.disparity.height();
  const int map_width = field.disparity.width();
  const std::string size = fmt::format("{}×{} px", map_width, map_height);
  if (const int times = times_of(map_height, map_width, height, width)) {
    field = reduced(field, times);
    return {static_cast<double>(times),
            fmt::format("Maps of {}, {} times the size of the views, were reduced: of the values "
                        "in each pixel the median counts.",
                        size, times)};
  }
  if (const int times = times_of(height, width, map_height, map_width)) {
    field = enlarged(field, times);
    return {1.0 / times, fmt::format("Maps of {}, a part of {} of the size of the views, were "
                                     "enlarged: each value stands for {}×{} pixels.",
                                     size, fmt::format("1/{}", times), times, times)};
  }
  return {};
}

}  // namespace episcope::io
