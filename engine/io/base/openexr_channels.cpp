// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/openexr_channels.h"

#include "engine/core/error.h"
#include "engine/core/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace episcope::io {
namespace {

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
  ExrWindow data, display;
};

using ByteSpan = std::span<const std::uint8_t>;

constexpr std::size_t kAfterVersion = 8;
constexpr std::uint64_t kManyParts = 0x1000;  ///< Flags of the version.
constexpr std::uint64_t kDeep = 0x800;
constexpr std::uint64_t kDwa = 8;  ///< The first compression that goes by names.

/// Unsigned, the lowest byte first; what is behind the end counts as 0.
std::uint64_t little_number(ByteSpan bytes, std::size_t at, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = count; i-- > 0;) {
    value = value << 8 | (at + i < bytes.size() ? bytes[at + i] : 0);
  }
  return value;
}

/// Up to the next 0, which `at` is moved behind.
std::string take_text(ByteSpan bytes, std::size_t& at) {
  std::string text;
  while (at < bytes.size() && bytes[at] != 0) text += static_cast<char>(bytes[at++]);
  ++at;
  return text;
}

/// Moves `at` behind the list.
std::vector<ExrHeader::Channel> take_channels(ByteSpan bytes, std::size_t& at) {
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
bool has_size_of_type(ByteSpan bytes, const Attribute& attribute) {
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
Attribute take_attribute(const std::filesystem::path& path, ByteSpan bytes, std::size_t& at) {
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

/// Of a box of four whole numbers: the left, top, right and bottom pixel.
ExrWindow window_at(ByteSpan bytes, std::size_t at) {
  const auto number = [&](std::size_t i) {
    return std::int64_t{static_cast<std::int32_t>(little_number(bytes, at + 4 * i, 4))};
  };
  return {number(0), number(1), number(2) - number(0) + 1, number(3) - number(1) + 1};
}

/// From `at` on, which is moved to what follows.
ExrHeader take_header(const std::filesystem::path& path, ByteSpan bytes, std::size_t& at) {
  ExrHeader header;
  while (at < bytes.size() && bytes[at] != 0) {
    const Attribute attribute = take_attribute(path, bytes, at);
    if (attribute.name == "compression") header.compression = little_number(bytes, attribute.at, 1);
    if (attribute.name == "dataWindow") header.data = window_at(bytes, attribute.at);
    if (attribute.name == "displayWindow") header.display = window_at(bytes, attribute.at);
    if (attribute.type != "chlist") continue;
    header.list = attribute.at;
    header.list_size = attribute.size;
    std::size_t list = attribute.at;
    header.channels = take_channels(bytes, list);
  }
  header.end = ++at;
  return header;
}

/// The header of a file, of which all bytes are given; without channels if the file is cut off, has
/// several parts, is deep, or is packed by DWA. Throws IoError if an attribute, of any part, does
/// not have the size of its type or is longer than the file: OpenEXR takes memory for what such a
/// file seems to claim. (OpenEXR File Layout, openexr.com)
ExrHeader exr_header(const std::filesystem::path& path, ByteSpan bytes) {
  std::size_t at = kAfterVersion;
  ExrHeader header = take_header(path, bytes, at);
  const std::uint64_t version = little_number(bytes, 4, 4);
  if ((version & kManyParts) != 0) {
    while (at < bytes.size() && bytes[at] != 0) (void)take_header(path, bytes, at);
  }
  const bool is_whole = header.end < bytes.size();
  const bool can_rename =
      (version & (kManyParts | kDeep)) == 0 && is_whole && header.compression < kDwa;
  if (!can_rename) header.channels.clear();
  return header;
}

using ExrBytes = std::vector<std::uint8_t>;
using Channel = ExrHeader::Channel;

std::string_view last_part(std::string_view name) {
  const auto dot = name.rfind('.');
  return dot == std::string_view::npos ? name : name.substr(dot + 1);
}

bool is_depth(const std::string& name) {
  return last_part(name) == "Z" || lower_case(name).find("depth") != std::string::npos;
}

/// New names of some channels, by their place in the list.
using ExrNames = std::map<std::size_t, char>;

ExrNames names_of_depth(const std::vector<Channel>& channels) {
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (is_depth(channels[i].name)) return {{i, 'Y'}};
  }
  return {};
}

ExrNames names_of_layer(const std::vector<Channel>& channels) {
  std::map<std::string, ExrNames> layers;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const std::string& name = channels[i].name;
    const std::string_view part = last_part(name);
    const bool is_color = part == "R" || part == "G" || part == "B" || part == "A";
    if (is_color && part.size() < name.size()) {
      layers[name.substr(0, name.size() - 1)][i] = part.front();
    }
  }
  std::erase_if(layers, [](const auto& layer) {
    const auto is_color = [](const auto& one) { return one.second != 'A'; };
    return std::ranges::count_if(layer.second, is_color) != 3;
  });
  const auto combined = std::ranges::find_if(layers, [](const auto& layer) {
    return lower_case(layer.first).find("combined") != std::string::npos;
  });
  if (combined != layers.end()) return combined->second;
  return layers.empty() ? ExrNames{} : layers.begin()->second;
}

ExrNames names_of(const std::vector<Channel>& channels, PicturePart part) {
  if (part == PicturePart::Depth) {
    if (ExrNames depth = names_of_depth(channels); !depth.empty()) return depth;
  }
  const bool is_known = std::ranges::any_of(channels, [](const Channel& channel) {
    const std::string& name = channel.name;
    return name == "R" || name == "G" || name == "B" || name == "Y";
  });
  if (is_known || channels.empty()) return {};
  if (ExrNames layer = names_of_layer(channels); !layer.empty()) return layer;
  if (ExrNames depth = names_of_depth(channels); !depth.empty()) return depth;
  return channels.size() == 1 ? ExrNames{{0, 'Y'}} : ExrNames{};
}

/// The list with the names, the others renamed such that all stay in order: rows are stored in the
/// order of names.
ExrBytes list_with(const ExrBytes& bytes, const std::vector<Channel>& channels,
                   const ExrNames& names) {
  ExrBytes list;
  char before = '0';  // first letter of what is not wanted
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const auto found = names.find(i);
    const std::string name =
        found == names.end() ? fmt::format("{}{:05}", before, i) : std::string(1, found->second);
    if (found != names.end()) before = found->second;
    list.insert(list.end(), name.begin(), name.end());
    list.push_back(0);
    const auto rest = bytes.begin() + static_cast<std::ptrdiff_t>(channels[i].rest);
    list.insert(list.end(), rest, rest + ExrHeader::kBytesOfChannel);
  }
  list.push_back(0);
  return list;
}

void set_number(ExrBytes& bytes, std::size_t at, std::size_t count, std::uint64_t value) {
  for (std::size_t i = 0; i < count && at + i < bytes.size(); ++i) {
    bytes[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
  }
}

/// Replaces the list, and moves the places of the rows: the first of them follow right behind.
void replace_list(ExrBytes& bytes, const ExrHeader& header, const ExrBytes& list) {
  const std::uint64_t moved = std::uint64_t{list.size()} - std::uint64_t{header.list_size};
  std::uint64_t rows = bytes.size();
  for (std::size_t at = header.end; at < rows; at += 8) {
    const std::uint64_t place = little_number(bytes, at, 8);
    rows = std::min(rows, place);
    set_number(bytes, at, 8, place + moved);
  }
  set_number(bytes, header.list - 4, 4, list.size());
  const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(header.list);
  const auto after = bytes.erase(begin, begin + static_cast<std::ptrdiff_t>(header.list_size));
  bytes.insert(after, list.begin(), list.end());
}

ExrBytes bytes_of(const std::filesystem::path& path) {
  constexpr std::string_view kExrSignature = "\x76\x2f\x31\x01";
  std::ifstream in(path, std::ios::binary);
  ExrBytes bytes(kExrSignature.size());
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  const bool is_exr = in && std::equal(bytes.begin(), bytes.end(), kExrSignature.begin(),
                                       [](std::uint8_t a, char b) { return a == std::uint8_t(b); });
  if (!is_exr) return {};
  bytes.insert(bytes.end(), std::istreambuf_iterator<char>(in), {});
  return bytes;
}

}  // namespace

std::optional<ExrPicture> read_exr(const std::filesystem::path& path, PicturePart part) {
  ExrBytes bytes = bytes_of(path);
  if (bytes.empty()) return std::nullopt;
  const ExrHeader header = exr_header(path, bytes);
  ExrPicture picture{{}, header.data, header.display};
  const ExrNames names = names_of(header.channels, part);
  if (names.empty()) return picture;
  replace_list(bytes, header, list_with(bytes, header.channels, names));
  picture.renamed = std::move(bytes);
  return picture;
}

}  // namespace episcope::io
