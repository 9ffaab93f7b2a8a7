// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/map_block.h"
#include "engine/io/durable/file_descriptor.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace episcope::io {

/// What a draft of a result holds.
struct DraftShape {
  MapGeometry maps;
  bool has_valid = false;   ///< Whether some pixels may be marked as not valid.
  bool has_layers = false;  ///< Whether it holds two layers as well.
  int kept = 0;             ///< Maps beside it that passes keep for later ones.
};

/// Bytes of a file and where they are.
struct FileBytes {
  std::uintmax_t offset = 0;
  std::vector<std::uint8_t> bytes;
};

/// The maps of a draft, in the order in which they are made; masks of valid pixels last.
enum class DraftMap {
  Disparity,
  Confidence,
  Foreground,
  Background,
  Layers,
  Valid,
  ForegroundValid,
  BackgroundValid
};

/// An HDF5 file with the maps of a result, of which blocks are written in any order, without the
/// library. Members throw IoError that names `target`.
class DraftFile {
 public:
  /// Makes the file at `path`, whole but for the values of the maps. Throws IoError also if the
  /// disk has no room for these.
  static void create(const std::filesystem::path& path, const DraftShape& shape,
                     const std::filesystem::path& target);

  DraftFile() = default;
  /// Opens a file that `create` made.
  DraftFile(const std::filesystem::path& path, const DraftShape& shape,
            const std::filesystem::path& target);

  /// All but the maps.
  [[nodiscard]] std::vector<FileBytes> rest() const;
  [[nodiscard]] std::uintmax_t byte_size() const;
  /// Makes all but the maps of a file what it was, whatever was added or is damaged. Throws IoError
  /// that names `path`.
  static void restore(const std::filesystem::path& path, const std::vector<FileBytes>& rest,
                      std::uintmax_t byte_size);

  [[nodiscard]] BlockMaps read(const MapBlock& block) const;
  /// Is on the disk when it returns. Disparity is NaN where it is not valid.
  void write(const MapBlock& block, const BlockMaps& maps) const;
  /// The same into another file, from its beginning, and from there to where it belongs;
  /// `has_valid` tells whether the block had a mask.
  void write_aside(const FileDescriptor& aside, const MapBlock& block, const BlockMaps& maps) const;
  void take_from(const FileDescriptor& aside, const MapBlock& block, bool has_valid) const;

 private:
  // A dataset.
  struct Place {
    DraftMap map;
    std::uintmax_t offset = 0;
  };

  [[nodiscard]] std::uintmax_t at(const Place& place, ViewIndex view, int row) const;
  [[nodiscard]] std::uintmax_t map_bytes(const Place& place) const;
  void require(bool is_done) const;
  void write_strips(const FileDescriptor& to, bool is_aside, const MapBlock& block,
                    const BlockMaps& maps) const;

  std::filesystem::path target_;
  DraftShape shape_;
  FileDescriptor file_;
  std::vector<Place> places_;  // By offset.
};

}  // namespace episcope::io
