// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/exr_channels.h"

#include "engine/core/text/suffix.h"
#include "engine/io/grid/exr_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <string_view>

namespace episcope::io {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Channel = ExrHeader::Channel;

std::string_view last_part(std::string_view name) {
  const auto dot = name.rfind('.');
  return dot == std::string_view::npos ? name : name.substr(dot + 1);
}

bool is_depth(const std::string& name) {
  return last_part(name) == "Z" || lower_case(name).find("depth") != std::string::npos;
}

/// New names of some channels, by their place in the list.
using Names = std::map<std::size_t, char>;

Names names_of_depth(const std::vector<Channel>& channels) {
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (is_depth(channels[i].name)) return {{i, 'Y'}};
  }
  return {};
}

Names names_of_layer(const std::vector<Channel>& channels) {
  std::map<std::string, Names> layers;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const std::string& name = channels[i].name;
    const std::string_view part = last_part(name);
    const bool is_colour = part == "R" || part == "G" || part == "B";
    if (is_colour && part.size() < name.size()) {
      layers[name.substr(0, name.size() - 1)][i] = part.front();
    }
  }
  std::erase_if(layers, [](const auto& layer) { return layer.second.size() != 3; });
  const auto combined = std::ranges::find_if(layers, [](const auto& layer) {
    return lower_case(layer.first).find("combined") != std::string::npos;
  });
  if (combined != layers.end()) return combined->second;
  return layers.empty() ? Names{} : layers.begin()->second;
}

Names names_of(const std::vector<Channel>& channels, PicturePart part) {
  if (part == PicturePart::Depth) {
    if (Names depth = names_of_depth(channels); !depth.empty()) return depth;
  }
  const bool is_known = std::ranges::any_of(channels, [](const Channel& channel) {
    const std::string& name = channel.name;
    return name == "R" || name == "G" || name == "B" || name == "Y";
  });
  if (is_known || channels.empty()) return {};
  if (Names layer = names_of_layer(channels); !layer.empty()) return layer;
  if (Names depth = names_of_depth(channels); !depth.empty()) return depth;
  return channels.size() == 1 ? Names{{0, 'Y'}} : Names{};
}

/// The list with the names, the others renamed such that all stay in order: rows are stored in the
/// order of names.
Bytes list_with(const Bytes& bytes, const std::vector<Channel>& channels, const Names& names) {
  Bytes list;
  char before = 'A';  // first letter of what is not wanted
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const auto found = names.find(i);
    const std::string name =
        found == names.end() ? fmt::format("{}{:05}", before, i) : std::string(1, found->second);
    if (found != names.end()) before = static_cast<char>(found->second + 1);
    list.insert(list.end(), name.begin(), name.end());
    list.push_back(0);
    const auto rest = bytes.begin() + static_cast<std::ptrdiff_t>(channels[i].rest);
    list.insert(list.end(), rest, rest + ExrHeader::kBytesOfChannel);
  }
  list.push_back(0);
  return list;
}

void set_number(Bytes& bytes, std::size_t at, std::size_t count, std::uint64_t value) {
  for (std::size_t i = 0; i < count && at + i < bytes.size(); ++i) {
    bytes[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
  }
}

/// Replaces the list, and moves the places of the rows: the first of them follow right behind.
void replace_list(Bytes& bytes, const ExrHeader& header, const Bytes& list) {
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

Bytes bytes_of(const std::filesystem::path& path) {
  constexpr std::string_view kSignature = "\x76\x2f\x31\x01";
  std::ifstream in(path, std::ios::binary);
  Bytes bytes(kSignature.size());
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  const bool is_exr = in && std::equal(bytes.begin(), bytes.end(), kSignature.begin(),
                                       [](std::uint8_t a, char b) { return a == std::uint8_t(b); });
  if (!is_exr) return {};
  bytes.insert(bytes.end(), std::istreambuf_iterator<char>(in), {});
  return bytes;
}

}  // namespace

std::optional<Bytes> exr_with_known_channels(const std::filesystem::path& path, PicturePart part) {
  Bytes bytes = bytes_of(path);
  if (bytes.empty()) return std::nullopt;
  const ExrHeader header = exr_header(path, bytes);
  const Names names = names_of(header.channels, part);
  if (names.empty()) return std::nullopt;
  replace_list(bytes, header, list_with(bytes, header.channels, names));
  return bytes;
}

}  // namespace episcope::io
