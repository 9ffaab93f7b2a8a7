// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/maps/kept_maps.h"

#include "engine/io/durable/system_error.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace episcope::io {

std::uintmax_t KeptMaps::byte_size(const MapGeometry& maps, int count) {
  return sizeof(float) * static_cast<std::uintmax_t>(count) * maps.grid.count() * maps.height *
         maps.width;
}

void KeptMaps::create(const std::filesystem::path& path, const MapGeometry& maps, int count,
                      const std::filesystem::path& target) {
  const FileDescriptor file(path, O_RDWR | O_CREAT | O_TRUNC);
  if (!file.ok()) throw write_error(target);
  errno = posix_fallocate(file.id(), 0, static_cast<off_t>(byte_size(maps, count)));
  if (errno != 0) throw write_error(target);
}

KeptMaps::KeptMaps(const std::filesystem::path& path, const MapGeometry& maps,
                   const std::filesystem::path& target)
    : target_(target), maps_(maps), file_(path, O_RDWR) {
  require(file_.ok());
}

std::uintmax_t KeptMaps::at(int number, ViewIndex view, int row) const {
  const auto index = static_cast<std::uintmax_t>(view.v - maps_.first.v) * maps_.grid.u +
                     static_cast<std::uintmax_t>(view.u - maps_.first.u);
  return byte_size(maps_, number) + (index * maps_.height + row) * maps_.width * sizeof(float);
}

void KeptMaps::require(bool is_done) const {
  if (!is_done) throw write_error(target_);
}

ViewStack<float> KeptMaps::read(const MapBlock& block, int number) const {
  ViewStack<float> kept(block.views.grid, block.rows(), maps_.width, 1, block.views.first);
  for (int i = 0; i < kept.grid().count(); ++i) {
    const ViewIndex view = kept.view_at(i);
    const ImageView<float> map = kept.view(view);
    require(read_all_at(file_.id(),
                        {reinterpret_cast<std::uint8_t*>(map.data), map.size() * sizeof(float)},
                        at(number, view, block.first_row)));
  }
  return kept;
}

void KeptMaps::write(const MapBlock& block, const std::vector<ViewStack<float>>& kept) const {
  for (std::size_t number = 0; number < kept.size(); ++number) {
    for (int i = 0; i < kept[number].grid().count(); ++i) {
      const ViewIndex view = kept[number].view_at(i);
      const ImageView<const float> map = kept[number].view(view);
      require(write_all_at(
          file_.id(), {reinterpret_cast<const std::uint8_t*>(map.data), map.size() * sizeof(float)},
          at(static_cast<int>(number), view, block.first_row)));
    }
  }
  require(::fdatasync(file_.id()) == 0);
}

}  // namespace episcope::io
