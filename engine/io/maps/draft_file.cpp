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

template <class T>
std::span<const std::uint8_t> bytes_of(ImageView<const T> map) {
  return {reinterpret_cast<const std::uint8_t*>(map.data), map.size() * sizeof(T)};
}

// Disparity as files have it.
std::span<const std::uint8_t> marked_disparity(const BlockMaps& maps, ViewIndex view,
                                               std::vector<float>& marked) {
  const ImageView<const float> disparity = maps.field.disparity.view(view);
  if (maps.field.valid.empty()) return bytes_of(disparity);
  const std::uint8_t* const valid = maps.field.valid.view(view).data;
  marked.assign(disparity.data, disparity.data + disparity.size());
  for (std::size_t i = 0; i < marked.size(); ++i) {
    if (valid[i] == 0) marked[i] = std::numeric_limits<float>::quiet_NaN();
  }
  return {reinterpret_cast<const std::uint8_t*>(marked.data()), marked.size() * sizeof(float)};
}

}  // namespace

void DraftFile::create(const std::filesystem::path& path, const DraftShape& shape,
                       const std::filesystem::path& target) {
  const MapGeometry& maps = shape.maps;
  const std::uintmax_t pixels =
      static_cast<std::uintmax_t>(maps.grid.count()) * maps.height * maps.width;
  const std::uintmax_t bytes = pixels * (2 * sizeof(float) + (shape.has_valid ? 1 : 0));
  AtomicFile file(path, bytes + kStructure);
  Hdf5Output output(file);
  const Hdf5Shape extent = map_shape(maps.grid, maps.height, maps.width);
  const char* const axes = map_axes(maps.grid);
  output.add_group(kResultGroup);
  output.reserve_dataset<float>(in_group("disparity"), extent, axes, kDisparityUnit);
  output.reserve_dataset<float>(in_group("confidence"), extent, axes, "");
  if (shape.has_valid) output.reserve_dataset<std::uint8_t>(in_group("valid"), extent, axes, "");
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
  const auto add = [&](Map map, const char* name, std::optional<std::uintmax_t> offset,
                       std::size_t sample_bytes) {
    if (!offset) {
      throw IoError(path, std::string(name) + " is not where it should be; remove this file");
    }
    places_.push_back({map, *offset, sample_bytes});
  };
  const auto disparity = in_group("disparity"), confidence = in_group("confidence");
  add(Map::Disparity, "disparity", input.place_in_file<float>(disparity), sizeof(float));
  add(Map::Confidence, "confidence", input.place_in_file<float>(confidence), sizeof(float));
  if (shape.has_valid) {
    add(Map::Valid, "valid", input.place_in_file<std::uint8_t>(in_group("valid")), 1);
  }
  std::ranges::sort(places_, {}, &Place::offset);
}

std::uintmax_t DraftFile::map_bytes(const Place& place) const {
  const MapGeometry& maps = shape_.maps;
  return place.sample_bytes * static_cast<std::uintmax_t>(maps.grid.count()) * maps.height *
         maps.width;
}

std::uintmax_t DraftFile::at(const Place& place, ViewIndex view, int row) const {
  const MapGeometry& maps = shape_.maps;
  const auto index =
      static_cast<std::uintmax_t>(view.v - maps.first.v) * maps.grid.u + (view.u - maps.first.u);
  return place.offset + (index * maps.height + row) * maps.width * place.sample_bytes;
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
  const auto empty = [&] {
    return ViewStack<float>(views.grid, block.rows(), shape_.maps.width, 1, views.first);
  };
  BlockMaps maps{{empty(), {}}, empty()};
  for (const Place& place : places_) {
    if (place.map == Map::Valid) continue;
    ViewStack<float>& stack = place.map == Map::Disparity ? maps.field.disparity : maps.confidence;
    for (int i = 0; i < views.grid.count(); ++i) {
      const ImageView<float> map = stack.view(stack.view_at(i));
      require(read_all_at(file_.id(),
                          {reinterpret_cast<std::uint8_t*>(map.data), map.size() * sizeof(float)},
                          at(place, stack.view_at(i), block.first_row)));
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
      if (place.map == Map::Valid && maps.field.valid.empty()) continue;
      const std::span<const std::uint8_t> bytes =
          place.map == Map::Disparity    ? marked_disparity(maps, view, marked)
          : place.map == Map::Confidence ? bytes_of(maps.confidence.view(view))
                                         : bytes_of(maps.field.valid.view(view));
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
      if (place.map == Map::Valid && !has_valid) continue;
      bytes.resize(place.sample_bytes * block.rows() * shape_.maps.width);
      require(read_all_at(aside.id(), bytes, end) &&
              write_all_at(file_.id(), bytes, at(place, view, block.first_row)));
      end += bytes.size();
    }
  }
  require(::fdatasync(file_.id()) == 0);
}

}  // namespace episcope::io
