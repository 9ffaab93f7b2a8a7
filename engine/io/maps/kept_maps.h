// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/map_block.h"
#include "engine/io/durable/file_descriptor.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace episcope::io {

/// A file of maps that passes of a run in blocks keep for later ones, one after the other, each
/// float32 `[v][u][y][x]`, without a header. Members throw IoError that names `target`.
class KeptMaps {
 public:
  /// How large the file of `count` maps is.
  [[nodiscard]] static std::uintmax_t byte_size(const MapGeometry& maps, int count);
  /// Makes the file at `path`, whatever is there. Throws IoError also if the disk has no room.
  static void create(const std::filesystem::path& path, const MapGeometry& maps, int count,
                     const std::filesystem::path& target);

  KeptMaps() = default;
  /// Opens a file that `create` made.
  KeptMaps(const std::filesystem::path& path, const MapGeometry& maps,
           const std::filesystem::path& target);

  [[nodiscard]] ViewStack<float> read(const MapBlock& block, int number) const;
  /// All of a block, from number 0 on; is on the disk when it returns.
  void write(const MapBlock& block, const std::vector<ViewStack<float>>& kept) const;

 private:
  [[nodiscard]] std::uintmax_t at(int number, ViewIndex view, int row) const;
  void require(bool is_done) const;

  std::filesystem::path target_;
  MapGeometry maps_;
  FileDescriptor file_;
};

}  // namespace episcope::io
