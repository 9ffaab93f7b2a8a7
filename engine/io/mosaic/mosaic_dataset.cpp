// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/mosaic/mosaic_dataset.h"

#include "engine/core/array/transposed.h"
#include "engine/core/error.h"
#include "engine/core/text/suffix.h"
#include "engine/io/arrays/array_file.h"
#include "engine/io/open/view_memory.h"

#include <algorithm>
#include <sstream>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestSide = 1'000'000;  ///< In px.

Mosaic kind_of_name(const std::string& name) {
  std::istringstream words(lower_case(last_name(name)));
  for (std::string word; std::getline(words, word, '_');) {
    if (word == "sai") return Mosaic::Views;
    if (word == "macpi") return Mosaic::Lenslets;
  }
  return Mosaic::Auto;
}

bool can_be_picture(const Hdf5Dataset& dataset) {
  return dataset.shape.size() == 2 && dataset.type != Hdf5Type::Other &&
         std::ranges::all_of(dataset.shape,
                             [](std::size_t side) { return side > 1 && side <= kLongestSide; });
}

std::size_t area(const Hdf5Dataset& dataset) {
  return dataset.shape[0] * dataset.shape[1];
}

bool asks_for_mosaic(const OpenOptions& options) {
  return options.mosaic != Mosaic::Auto || options.lenslet > 0 || !options.grid.empty();
}

std::optional<Hdf5Dataset> choose(const Hdf5Input& file, const OpenOptions& options) {
  std::optional<Hdf5Dataset> best;
  for (const Hdf5Dataset& each : file.datasets()) {
    if (!can_be_picture(each)) continue;
    const bool has_name = kind_of_name(each.name) != Mosaic::Auto;
    const bool is_meant = options.dataset.empty() ? has_name : each.name == options.dataset;
    if (!is_meant || !(has_name || asks_for_mosaic(options))) continue;
    if (!best || area(each) > area(*best)) best = each;
  }
  return best;
}

/// Only a grid that divides the picture: a number of that name may mean something else.
GridShape stated_grid(const Hdf5Input& file, const MosaicDataset& dataset) {
  constexpr double kMostViews = 1000;
  const std::size_t height = dataset.shape[dataset.is_transposed ? 1 : 0];
  const std::size_t width = dataset.shape[dataset.is_transposed ? 0 : 1];
  for (const std::string& object : {dataset.name, std::string("/")}) {
    for (const char* name : {"angRes", "ang_res", "grid"}) {
      const std::vector<double> sides = file.numbers(object, name);
      const bool is_grid =
          (sides.size() == 1 || sides.size() == 2) &&
          std::ranges::all_of(sides, [](double side) { return side >= 1 && side <= kMostViews; });
      if (!is_grid) continue;
      const GridShape grid{static_cast<int>(sides.front()), static_cast<int>(sides.back())};
      const auto divides = [](int views, std::size_t side) {
        return side % static_cast<std::size_t>(views) == 0;
      };
      if (divides(grid.v, height) && divides(grid.u, width)) return grid;
    }
  }
  return {0, 0};
}

template <class T>
AnyImage read_as(const Hdf5Input& file, const MosaicDataset& dataset) {
  require_view_memory(file.path(), static_cast<double>(dataset.shape[0]) *
                                       static_cast<double>(dataset.shape[1]) * sizeof(T));
  Image<T> image(static_cast<int>(dataset.shape[0]), static_cast<int>(dataset.shape[1]));
  file.read(dataset.name, {Hdf5Shape(2, 0), dataset.shape}, image.data());
  if (dataset.is_transposed) return transposed(image);
  return image;
}

}  // namespace

std::optional<MosaicDataset> find_mosaic_dataset(const fs::path& path, const OpenOptions& options) {
  if (!has_hdf5_signature(path)) return std::nullopt;
  const Hdf5Input file(path);
  if (options.dataset.empty() && (file.has("LF") || file.has("estimate"))) return std::nullopt;
  const auto chosen = choose(file, options);
  if (!chosen) return std::nullopt;
  MosaicDataset dataset{chosen->name, chosen->shape, chosen->type};
  dataset.kind = kind_of_name(dataset.name);
  dataset.is_transposed = dataset.kind != Mosaic::Auto;
  dataset.grid = stated_grid(file, dataset);
  return dataset;
}

AnyImage read_mosaic_dataset(const fs::path& path, const MosaicDataset& dataset) {
  const Hdf5Input file(path);
  static_cast<void>(file.dataset(dataset.name));  // throws if the file cannot hold as much
  if (dataset.type == Hdf5Type::UInt8) return read_as<std::uint8_t>(file, dataset);
  if (dataset.type == Hdf5Type::UInt16) return read_as<std::uint16_t>(file, dataset);
  return read_as<float>(file, dataset);
}

std::vector<FileUse> uses_beside(const fs::path& path, const MosaicDataset& dataset) {
  std::vector<FileUse> uses{{"mosaics", 1, dataset.name, true}};
  for (const Hdf5Dataset& other : Hdf5Input(path).datasets()) {
    if (other.name == dataset.name) continue;
    uses.push_back({"array of " + shape_text(other.shape), 1, other.name, false});
  }
  return uses;
}

}  // namespace episcope::io
