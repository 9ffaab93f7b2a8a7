// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/exr_header.h"

#include "engine/core/error.h"

#include <map>
#include <string_view>

namespace episcope::io {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t kAfterVersion = 8;
constexpr std::uint64_t kParts = 0x1000;  ///< Flags of the version.
constexpr std::uint64_t kDeep = 0x800;
constexpr std::uint64_t kDwa = 8;  ///< The first compression that goes by names.

/// Up to the next 0, which `at` is moved behind.
std::string take_text(Bytes bytes, std::size_t& at) {
  std::string text;
  while (at < bytes.size() && bytes[at] != 0) text += static_cast<char>(bytes[at++]);
  ++at;
  return text;
}

/// Moves `at` behind the list.
std::vector<ExrHeader::Channel> take_channels(Bytes bytes, std::size_t& at) {
  std::vector<ExrHeader::Channel> channels;
  while (at < bytes.size() && bytes[at] != 0) {
    std::string name = take_text(bytes, at);
    channels.push_back({std::move(name), at});
    at += ExrHeader::kBytesOfChannel;
  }
  ++at;
  return channels;
}

struct Attribute {
  std::string name;
  std::string type;
  std::size_t at = 0;  ///< Where its value is, and how long.
  std::size_t size = 0;
};

/// OpenEXR reads values of these types without a look at their size.
bool has_size_of_type(Bytes bytes, const Attribute& attribute) {
  static const std::map<std::string_view, std::size_t> sizes{
      {"box2f", 16},      {"box2i", 16},   {"chromaticities", 32},
      {"compression", 1}, {"double", 8},   {"envmap", 1},
      {"float", 4},       {"int", 4},      {"keycode", 28},
      {"lineOrder", 1},   {"m33d", 72},    {"m33f", 36},
      {"m44d", 128},      {"m44f", 64},    {"rational", 8},
      {"tiledesc", 9},    {"timecode", 8}, {"v2d", 16},
      {"v2f", 8},         {"v2i", 8},      {"v3d", 24},
      {"v3f", 12},        {"v3i", 12}};
  if (attribute.type == "chlist") {
    std::size_t at = attribute.at;
    (void)take_channels(bytes, at);
    return at == attribute.at + attribute.size;
  }
  if (attribute.type == "preview") {
    const std::uint64_t width = little_number(bytes, attribute.at, 4);
    return attribute.size == 8 + 4 * width * little_number(bytes, attribute.at + 4, 4);
  }
  const auto known = sizes.find(attribute.type);
  return known == sizes.end() || known->second == attribute.size;
}

/// From `at` on, which is moved to what follows.
Attribute take_attribute(const std::filesystem::path& path, Bytes bytes, std::size_t& at) {
  Attribute attribute{take_text(bytes, at), take_text(bytes, at)};
  attribute.size = static_cast<std::size_t>(little_number(bytes, at, 4));
  attribute.at = at + 4;
  const bool is_in_file =
      attribute.at <= bytes.size() && attribute.size <= bytes.size() - attribute.at;
  if (!is_in_file || !has_size_of_type(bytes, attribute)) {
    throw IoError(path,
                  "the image cannot be decoded: its header is damaged; copy or export it again");
  }
  at = attribute.at + attribute.size;
  return attribute;
}

/// From `at` on, which is moved to what follows.
ExrHeader take_header(const std::filesystem::path& path, Bytes bytes, std::size_t& at) {
  ExrHeader header;
  while (at < bytes.size() && bytes[at] != 0) {
    const Attribute attribute = take_attribute(path, bytes, at);
    if (attribute.name == "compression") header.compression = little_number(bytes, attribute.at, 1);
    if (attribute.type != "chlist") continue;
    header.list = attribute.at;
    header.list_size = attribute.size;
    std::size_t list = attribute.at;
    header.channels = take_channels(bytes, list);
  }
  header.end = ++at;
  return header;
}

}  // namespace

std::uint64_t little_number(Bytes bytes, std::size_t at, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = count; i-- > 0;) {
    value = value << 8 | (at + i < bytes.size() ? bytes[at + i] : 0);
  }
  return value;
}

ExrHeader exr_header(const std::filesystem::path& path, Bytes bytes) {
  std::size_t at = kAfterVersion;
  ExrHeader header = take_header(path, bytes, at);
  const std::uint64_t version = little_number(bytes, 4, 4);
  if ((version & kParts) != 0) {
    while (at < bytes.size() && bytes[at] != 0) (void)take_header(path, bytes, at);
  }
  const bool is_whole = header.end < bytes.size();
  if ((version & (kParts | kDeep)) != 0 || !is_whole || header.compression >= kDwa) return {};
  return header;
}

}  // namespace episcope::io
