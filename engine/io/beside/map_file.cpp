// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/beside/map_file.h"

#include "engine/core/array/whole_int.h"
#include "engine/core/error.h"
#include "engine/core/text/suffix.h"
#include "engine/io/arrays/npy_file.h"
#include "engine/io/beside/archived_map.h"
#include "engine/io/beside/map_name.h"
#include "engine/io/beside/text_map.h"
#include "engine/io/grid/decode_image.h"
#include "engine/io/grid/image_header.h"
#include "engine/io/hdf5/hdf5_file.h"
#include "engine/io/labels/label_list.h"
#include "engine/io/maps/foreign_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestSide = 65536;  ///< In px.

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
template <class T>
ViewStack<T> read_grid(const NpyFile& file, GridShape grid) {
  const ArrayShape& shape = file.shape();
  if (shape.size() != 4) return {};
  const bool fits = !file.header().is_fortran && shape[0] == static_cast<std::size_t>(grid.v) &&
                    shape[1] == static_cast<std::size_t>(grid.u);
  if (!fits) {
    throw IoError(file.path(),
                  fmt::format("the array has the shape {}, but maps of {}×{} views are expected in "
                              "C order; save it again or remove it",
                              array_shape_text(file.header().shape), grid.v, grid.u));
  }
  ViewStack<T> stack(grid, static_cast<int>(shape[2]), static_cast<int>(shape[3]));
  file.read(ArrayShape(4, 0), shape, stack.data());
  return stack;
}

/// Values with what is not finite marked as invalid.
DisparityField marked(ViewStack<float> values) {
  DisparityField field{std::move(values), {}};
  mark_invalid(field);
  return field;
}

DisparityField read_npy_values(const fs::path& path, GridShape grid) {
  const NpyFile file(path);
  ViewStack<float> maps = read_grid<float>(file, grid);
  if (maps.empty()) maps = single(read_map(file, file.header().is_fortran));
  return marked(std::move(maps));
}

/// The channel of depth, else the first: maps are written as grey, or with the same value in all.
DisparityField read_exr_values(const fs::path& path) {
  const AnyImage decoded = decode_image(path, PicturePart::Depth);
  const auto* image = std::get_if<Image<float>>(&decoded);
  if (image == nullptr) {
    throw IoError(path, "this picture has " + describe_image(decoded) +
                            ", but a map needs 32-bit float samples; export it in that format");
  }
  ViewStack<float> values({1, 1}, image->height(), image->width());
  for (std::size_t i = 0; i < values.size(); ++i) {
    values.data()[i] = image->data()[i * static_cast<std::size_t>(image->channels())];
  }
  return marked(std::move(values));
}

/// Whether a picture holds levels of grey, or colours, and no floats.
bool holds_levels(const fs::path& path) {
  if (!is_image_name(path)) return false;
  if (!can_hold_values(path)) return true;
  const auto header = stated_image_header(path);
  return header && header->sample_type != SampleType::Float32;
}

/// Levels of grey as numbers. Throws IoError for colours, which are no numbers.
DisparityField read_picture_values(const fs::path& path) {
  return std::visit(
      [&](const auto& image) {
        ViewStack<float> values({1, 1}, image.height(), image.width());
        const int channels = image.channels();
        for (std::size_t i = 0; i < values.size(); ++i) {
          const auto* pixel = image.data() + i * static_cast<std::size_t>(channels);
          const bool is_grey =
              std::all_of(pixel, pixel + channels, [&](auto level) { return level == *pixel; });
          if (!is_grey) {
            throw IoError(path,
                          "this picture has colours, but levels of grey are expected, which "
                          "stand for numbers; export the map without a colour map");
          }
          values.data()[i] = static_cast<float>(*pixel);
        }
        return marked(std::move(values));
      },
      decode_image(path));
}

StoredLabels read_npy_label_maps(const fs::path& path, GridShape grid) {
  const NpyFile file(path);
  StoredLabels labels{read_grid<std::int32_t>(file, grid)};
  if (labels.numbers.empty()) {
    labels.numbers = single(read_label_map(file, file.header().is_fortran));
  }
  return labels;
}

/// GT_LABELS, or the only dataset.
StoredLabels read_hdf5_labels(const fs::path& path, GridShape grid) {
  const Hdf5Input file(path);
  const std::vector<Hdf5Dataset> all = file.datasets();
  if (!file.has(kTrueLabels) && all.size() != 1) {
    throw IoError(path, fmt::format("{} datasets were found and none of them is {}; store the "
                                    "labels alone",
                                    all.size(), kTrueLabels));
  }
  const Hdf5Dataset labels = file.dataset(file.has(kTrueLabels) ? kTrueLabels : all.front().name);
  const std::size_t rank = labels.shape.size();
  const bool is_map = rank == 2;
  const bool is_grid = rank == 4 && labels.shape[0] == static_cast<std::size_t>(grid.v) &&
                       labels.shape[1] == static_cast<std::size_t>(grid.u);
  if (!is_map && !is_grid) {
    throw IoError(path, fmt::format("the dataset {} has the shape {}, but labels of one view or of "
                                    "{}×{} views are expected; remove or replace it",
                                    labels.name, shape_text(labels.shape), grid.v, grid.u));
  }
  // That the file can hold as many is known: Hdf5Input looks at every dataset.
  const bool is_sound = std::ranges::all_of(
      labels.shape, [](std::size_t length) { return length > 0 && length <= kLongestSide; });
  if (!is_sound) {
    throw IoError(path, fmt::format("the dataset {} claims the shape {}, but sides of 1 to {} are "
                                    "expected; copy it again or remove it",
                                    labels.name, shape_text(labels.shape), kLongestSide));
  }
  StoredLabels stored{ViewStack<std::int32_t>(is_grid ? grid : GridShape{1, 1},
                                              static_cast<int>(labels.shape[rank - 2]),
                                              static_cast<int>(labels.shape[rank - 1]))};
  file.read(labels.name, {Hdf5Shape(rank, 0), labels.shape}, stored.numbers.data());
  return stored;
}

std::int32_t packed_level(float value, const fs::path& path) {
  if (const auto level = whole_int(value)) return *level;
  throw IoError(path,
                "labels are expected to be whole numbers, but the image holds fractions; save "
                "labels as integers");
}

template <class T>
StoredLabels labels_of(const Image<T>& image, const fs::path& path) {
  StoredLabels labels{ViewStack<std::int32_t>({1, 1}, image.height(), image.width())};
  const T* in = image.data();
  const std::size_t count = labels.numbers.size();
  const int channels = image.channels();
  for (std::size_t i = 0; i < count && !labels.are_colors && channels == 3; ++i) {
    labels.are_colors = in[3 * i] != in[3 * i + 1] || in[3 * i] != in[3 * i + 2];
  }
  if (labels.are_colors && !std::is_same_v<T, std::uint8_t>) {
    throw IoError(path, "colours of labels are expected in 8 bits; save labels as integers");
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

bool is_hdf5(const fs::path& path) {
  return has_suffix(path, std::array<std::string_view, 2>{".h5", ".hdf5"});
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
  if (suffix_of(path) == ".npy") return read_npy_values(path, grid);
  if (is_archive_of_maps(path)) return marked(read_archived_values(path, grid));
  if (suffix_of(path) == ".exr") return read_exr_values(path);
  if (has_text_suffix(path)) return marked(single(read_text_map(path)));
  if (holds_levels(path)) return read_picture_values(path);
  DisparityField field = read_disparity_map(path, grid);
  if (!(field.disparity.grid() == GridShape{1, 1}) || field.disparity.first() == ViewIndex{}) {
    return field;
  }
  // Of the centre view; here all single maps are at (0, 0).
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
  if (is_archive_of_maps(path)) return {read_archived_labels(path, grid)};
  if (is_hdf5(path)) return read_hdf5_labels(path, grid);
  return std::visit([&](const auto& image) { return labels_of(image, path); }, decode_image(path));
}

OwnFile own_file(const fs::path& path) {
  if (!is_hdf5(path) || !has_hdf5_signature(path)) return OwnFile::None;
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

}  // namespace episcope::io
