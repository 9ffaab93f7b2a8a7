// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/archive/archive_extras.h"

#include "engine/core/error.h"
#include "engine/io/archive/archive_names.h"

#include <fmt/format.h>

#include <cstring>

namespace episcope::io {

void read_positions(const Hdf5Input& file, GridShape grid, LightFieldInfo& info) {
  const std::vector<double> values = file.numbers("/", kPositions);
  if (values.empty()) return;
  const auto expected = 2 * static_cast<std::size_t>(grid.count());
  if (values.size() != expected) {
    throw IoError(file.path(), fmt::format("the attribute {} holds {} numbers, but {} are expected "
                                           "for {} views; correct or remove it",
                                           kPositions, values.size(), expected, grid.count()));
  }
  for (std::size_t i = 0; i < values.size(); i += 2) {
    info.positions.push_back({values[i], values[i + 1]});
  }
  info.position_unit = file.text("/", kPositionUnit).value_or("");
}

ViewStack<std::uint8_t> read_valid(const Hdf5Input& file, const FieldShape& shape,
                                   const Progress& progress) {
  if (!file.has(kValid)) return {};
  const Hdf5Shape stored = file.dataset(kValid).shape;
  const Hdf5Shape one{static_cast<std::size_t>(shape.height),
                      static_cast<std::size_t>(shape.width)};
  // Of a single view it has the two axes of a map.
  if (stored.size() != 4 && !(shape.grid.count() == 1 && stored == one)) {
    throw IoError(file.path(), fmt::format("the dataset {} has the shape {}, but one mask for each "
                                           "view is expected; correct or remove it",
                                           kValid, shape_text(stored)));
  }
  return read_maps<std::uint8_t>(file, kValid, shape, progress);
}

std::map<std::string, Image<std::uint8_t>> read_regions(const Hdf5Input& file,
                                                        const FieldShape& shape) {
  std::map<std::string, Image<std::uint8_t>> regions;
  const Hdf5Shape expected{static_cast<std::size_t>(shape.height),
                           static_cast<std::size_t>(shape.width)};
  for (const Hdf5Dataset& dataset : file.datasets()) {
    if (!dataset.name.starts_with(kRegionPrefix) || dataset.name.find('/') != std::string::npos) {
      continue;  // files are named by regions
    }
    if (dataset.shape != expected) {
      throw IoError(file.path(),
                    fmt::format("the dataset {} has the shape {}, but {} is expected; "
                                "correct or remove it",
                                dataset.name, shape_text(dataset.shape), shape_text(expected)));
    }
    Image<std::uint8_t> mask(shape.height, shape.width);
    file.read(dataset.name, {{0, 0}, expected}, mask.data());
    regions.emplace(dataset.name.substr(std::strlen(kRegionPrefix)), std::move(mask));
  }
  return regions;
}

}  // namespace episcope::io
