// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace episcope::io {

/// Where the channels of an OpenEXR file are told, in bytes from its beginning.
struct ExrHeader {
  struct Channel {
    std::string name;
    std::size_t rest = 0;  ///< What follows the name, `kBytesOfChannel`.
  };
  static constexpr std::size_t kBytesOfChannel = 16;

  std::size_t list = 0;  ///< Where the list of channels is, and how long,
  std::size_t list_size = 0;
  std::size_t end = 0;  ///< where the header ends and the places of the rows begin.
  std::uint64_t compression = 0;
  std::vector<Channel> channels;
};

/// The header of a file, of which all bytes are given; without channels if the file is cut off, has
/// several parts, is deep, or is packed by DWA. Throws IoError if an attribute, of any part, does
/// not have the size of its type or is longer than the file: OpenEXR takes memory for what such a
/// file seems to claim. (OpenEXR File Layout, openexr.com)
[[nodiscard]] ExrHeader exr_header(const std::filesystem::path& path,
                                   std::span<const std::uint8_t> bytes);

/// Unsigned, the lowest byte first; what is behind the end counts as 0.
[[nodiscard]] std::uint64_t little_number(std::span<const std::uint8_t> bytes, std::size_t at,
                                          std::size_t count);

}  // namespace episcope::io
