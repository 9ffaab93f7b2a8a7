// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/maps/draft_file.h"

#include "engine/core/error.h"
#include "engine/io/durable/atomic_file.h"
#include "engine/io/durable/system_error.h"
#include "engine/io/hdf5/hdf5_file.h"
#include "engine/io/hdf5/map_writer.h"
#include "engine/io/maps/result_provenance.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <optional>
#include <utility>

namespace episcope::io {
namespace {

constexpr std::uintmax_t kStructure = 1 << 16;

// A dataset of the result.
struct Dataset {
  DraftMap map;
  const char* name;
  const char* unit;
  bool is_mask = false;
  bool is_of_layers = false;
};
constexpr Dataset kDatasets[] = {
    {DraftMap::Disparity, "disparity", kDisparityUnit},
    {DraftMap::Confidence, "confidence", ""},
    {DraftMap::Foreground, "disparity_foreground", kDisparityUnit, false, true},
    {DraftMap::Background, "disparity_background", kDisparityUnit, false, true},
    {DraftMap::Layers, "layers", "surfaces", false, true},
    {DraftMap::Valid, "valid", "", true},
    {DraftMap::ForegroundValid, "valid_foreground", "", true, true},
    {DraftMap::BackgroundValid, "valid_background", "", true, true},
};

bool is_mask(DraftMap map) {
  return map >= DraftMap::Valid;
}
std::size_t sample_bytes(DraftMap map) {
  return is_mask(map) || map == DraftMap::Layers ? 1 : sizeof(float);
}

std::vector<Dataset> datasets_of(const DraftShape& shape) {
  std::vector<Dataset> datasets;
  for (const Dataset& dataset : kDatasets) {
    if (dataset.is_mask && !shape.has_valid) continue;
    if (dataset.is_of_layers && !shape.has_layers) continue;
    datasets.push_back(dataset);
  }
  return datasets;
}

template <class T>
std::span<const std::uint8_t> bytes_of(ImageView<const T> map) {
  return {reinterpret_cast<const std::uint8_t*>(map.data), map.size() * sizeof(T)};
}
template <class T>
std::span<std::uint8_t> bytes_to(ImageView<T> map) {
  return {reinterpret_cast<std::uint8_t*>(map.data), map.size() * sizeof(T)};
}

// Of a disparity or of its mask.
template <class Maps>
auto& field_in(Maps& maps, DraftMap map) {
  switch (map) {
    case DraftMap::Foreground:
    case DraftMap::ForegroundValid:
      return maps.layered.foreground;
    case DraftMap::Background:
    case DraftMap::BackgroundValid:
      return maps.layered.background;
    default:
      return maps.field;
  }
}

// Disparity as files have it.
std::span<const std::uint8_t> marked_disparity(const DisparityField& field, ViewIndex view,
                                               std::vector<float>& marked) {
  const ImageView<const float> disparity = field.disparity.view(view);
  if (field.valid.empty()) return bytes_of(disparity);
  const std::uint8_t* const valid = field.valid.view(view).data;
  marked.assign(disparity.data, disparity.data + disparity.size());
  for (std::size_t i = 0; i < marked.size(); ++i) {
    if (valid[i] == 0) marked[i] = std::numeric_limits<float>::quiet_NaN();
  }
  return {reinterpret_cast<const std::uint8_t*>(marked.data()), marked.size() * sizeof(float)};
}

std::span<const std::uint8_t> bytes_in(const BlockMaps& maps, DraftMap map, ViewIndex view,
                                       std::vector<float>& marked) {
  if (is_mask(map)) return bytes_of(field_in(maps, map).valid.view(view));
  if (map == DraftMap::Confidence) return bytes_of(maps.confidence.view(view));
  if (map == DraftMap::Layers) return bytes_of(maps.layered.layers.view(view));
  return marked_disparity(field_in(maps, map), view, marked);
}

// Where the samples of a map that is no mask go.
std::span<std::uint8_t> target_in(BlockMaps& maps, DraftMap map, ViewIndex view) {
  if (map == DraftMap::Confidence) return bytes_to(maps.confidence.view(view));
  if (map == DraftMap::Layers) return bytes_to(maps.layered.layers.view(view));
  return bytes_to(field_in(maps, map).disparity.view(view));
}

}  // namespace

void DraftFile::create(const std::filesystem::path& path, const DraftShape& shape,
                       const std::filesystem::path& target) {
  const MapGeometry& maps = shape.maps;
  const std::uintmax_t pixels =
      static_cast<std::uintmax_t>(maps.grid.count()) * maps.height * maps.width;
  std::uintmax_t bytes = kStructure;
  for (const Dataset& dataset : datasets_of(shape)) bytes += pixels * sample_bytes(dataset.map);
  AtomicFile file(path, bytes);
  Hdf5Output output(file);
  const Hdf5Shape extent = map_shape(maps.grid, maps.height, maps.width);
  const char* const axes = map_axes(maps.grid);
  output.add_group(kResultGroup);
  for (const Dataset& dataset : datasets_of(shape)) {
    const std::string name = in_group(dataset.name);
    if (sample_bytes(dataset.map) == 1) {
      output.reserve_dataset<std::uint8_t>(name, extent, axes, dataset.unit);
    } else {
      output.reserve_dataset<float>(name, extent, axes, dataset.unit);
    }
  }
  output.close();
  {
    const FileDescriptor reserved(file.temporary(), O_RDWR);
    errno = reserved.ok()
                ? posix_fallocate(reserved.id(), 0,
                                  static_cast<off_t>(std::filesystem::file_size(file.temporary())))
                : errno;
    if (errno != 0) throw write_error(target);
  }
  file.commit();
}

DraftFile::DraftFile(const std::filesystem::path& path, const DraftShape& shape,
                     const std::filesystem::path& target)
    : target_(target), shape_(shape), file_(path, O_RDWR) {
  require(file_.ok());
  const Hdf5Input input(path);
  for (const Dataset& dataset : datasets_of(shape)) {
    const std::string name = in_group(dataset.name);
    const std::optional<std::uintmax_t> offset = sample_bytes(dataset.map) == 1
                                                     ? input.place_in_file<std::uint8_t>(name)
                                                     : input.place_in_file<float>(name);
    if (!offset) {
      throw IoError(path,
                    std::string(dataset.name) + " is not where it should be; remove this file");
    }
    places_.push_back({dataset.map, *offset});
  }
  std::ranges::sort(places_, {}, &Place::offset);
}

std::uintmax_t DraftFile::map_bytes(const Place& place) const {
  const MapGeometry& maps = shape_.maps;
  return sample_bytes(place.map) * static_cast<std::uintmax_t>(maps.grid.count()) * maps.height *
         maps.width;
}

std::uintmax_t DraftFile::at(const Place& place, ViewIndex view, int row) const {
  const MapGeometry& maps = shape_.maps;
  const auto index =
      static_cast<std::uintmax_t>(view.v - maps.first.v) * maps.grid.u + (view.u - maps.first.u);
  return place.offset + (index * maps.height + row) * maps.width * sample_bytes(place.map);
}

void DraftFile::require(bool is_done) const {
  if (!is_done) throw write_error(target_);
}

std::uintmax_t DraftFile::byte_size() const {
  struct stat facts {};
  require(::fstat(file_.id(), &facts) == 0);
  return static_cast<std::uintmax_t>(facts.st_size);
}

std::vector<FileBytes> DraftFile::rest() const {
  std::vector<FileBytes> rest;
  std::uintmax_t begin = 0;
  const auto add_until = [&](std::uintmax_t end) {
    if (end <= begin) return;
    FileBytes gap{begin, std::vector<std::uint8_t>(end - begin)};
    require(read_all_at(file_.id(), gap.bytes, begin));
    rest.push_back(std::move(gap));
  };
  for (const Place& place : places_) {
    add_until(place.offset);
    begin = place.offset + map_bytes(place);
  }
  add_until(byte_size());
  return rest;
}

void DraftFile::restore(const std::filesystem::path& path, const std::vector<FileBytes>& rest,
                        std::uintmax_t byte_size) {
  const FileDescriptor file(path, O_RDWR);
  bool is_done = file.ok();
  for (const FileBytes& gap : rest) {
    is_done = is_done && write_all_at(file.id(), gap.bytes, gap.offset);
  }
  is_done = is_done && ::ftruncate(file.id(), static_cast<off_t>(byte_size)) == 0 &&
            ::fdatasync(file.id()) == 0;
  if (!is_done) throw write_error(path);
}

BlockMaps DraftFile::read(const MapBlock& block) const {
  const ViewRectangle& views = block.views;
  const auto empty = [&]<class T>(T) {
    return ViewStack<T>(views.grid, block.rows(), shape_.maps.width, 1, views.first);
  };
  BlockMaps maps{{empty(0.0F), {}}, empty(0.0F)};
  if (shape_.has_layers) {
    maps.layered = {{empty(0.0F), {}}, {empty(0.0F), {}}, empty(std::uint8_t{})};
  }
  for (const Place& place : places_) {
    if (is_mask(place.map)) continue;
    for (int i = 0; i < views.grid.count(); ++i) {
      const ViewIndex view = views.grid.view_at(i, views.first);
      require(read_all_at(file_.id(), target_in(maps, place.map, view),
                          at(place, view, block.first_row)));
    }
  }
  return maps;
}

void DraftFile::write_strips(const FileDescriptor& to, bool is_aside, const MapBlock& block,
                             const BlockMaps& maps) const {
  std::vector<float> marked;
  std::uintmax_t end = 0;
  for (int i = 0; i < block.views.grid.count(); ++i) {
    const ViewIndex view = block.views.grid.view_at(i, block.views.first);
    for (const Place& place : places_) {
      if (is_mask(place.map) && maps.field.valid.empty()) continue;
      const std::span<const std::uint8_t> bytes = bytes_in(maps, place.map, view, marked);
      require(write_all_at(to.id(), bytes, is_aside ? end : at(place, view, block.first_row)));
      end += bytes.size();
    }
  }
  require(::fdatasync(to.id()) == 0);
}

void DraftFile::write(const MapBlock& block, const BlockMaps& maps) const {
  write_strips(file_, false, block, maps);
}

void DraftFile::write_aside(const FileDescriptor& aside, const MapBlock& block,
                            const BlockMaps& maps) const {
  write_strips(aside, true, block, maps);
}

void DraftFile::take_from(const FileDescriptor& aside, const MapBlock& block,
                          bool has_valid) const {
  std::vector<std::uint8_t> bytes;
  std::uintmax_t end = 0;
  for (int i = 0; i < block.views.grid.count(); ++i) {
    const ViewIndex view = block.views.grid.view_at(i, block.views.first);
    for (const Place& place : places_) {
      if (is_mask(place.map) && !has_valid) continue;
      bytes.resize(sample_bytes(place.map) * block.rows() * shape_.maps.width);
      require(read_all_at(aside.id(), bytes, end) &&
              write_all_at(file_.id(), bytes, at(place, view, block.first_row)));
      end += bytes.size();
    }
  }
  require(::fdatasync(file_.id()) == 0);
}

}  // namespace episcope::io
