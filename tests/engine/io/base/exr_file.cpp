// SPDX-License-Identifier: BSD-3-Clause
#include "tests/engine/io/base/exr_file.h"

#include <cstdint>
#include <cstring>
#include <fstream>
#include <string_view>

namespace episcope::test {
namespace {

constexpr std::string_view kSignature("\x76\x2f\x31\x01\x02\0\0\0", 8);

template <class T>
std::string raw(T value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
  return name + '\0' + type + '\0' + raw(static_cast<std::int32_t>(value.size())) + value;
}

std::string list_of(const ExrChannels& channels) {
  constexpr std::int32_t kFloat = 2;
  std::string list;
  for (const auto& [name, image] : channels) {
    list += name + '\0' + raw(kFloat) + std::string(4, '\0');
    list += raw(std::int32_t{1}) + raw(std::int32_t{1});
  }
  return list + '\0';
}

}  // namespace

void write_exr(const std::filesystem::path& path, const ExrChannels& channels,
               const std::optional<DisplayWindow>& display) {
  const ImageView<const float>& first = channels.begin()->second;
  const std::string box = std::string(8, '\0') + raw(std::int32_t{first.width - 1}) +
                          raw(std::int32_t{first.height - 1});
  const std::string picture =
      display ? raw(display->left) + raw(display->top) + raw(display->right) + raw(display->bottom)
              : box;
  std::string file(kSignature);
  file += attribute("channels", "chlist", list_of(channels));
  file += attribute("compression", "compression", std::string(1, '\0'));
  file += attribute("dataWindow", "box2i", box) + attribute("displayWindow", "box2i", picture);
  file += attribute("lineOrder", "lineOrder", std::string(1, '\0'));
  file += attribute("pixelAspectRatio", "float", raw(1.0F));
  file += attribute("screenWindowCenter", "v2f", std::string(8, '\0'));
  file += attribute("screenWindowWidth", "float", raw(1.0F)) + '\0';
  const std::size_t line = 4 * channels.size() * static_cast<std::size_t>(first.width);
  const std::size_t rows = file.size() + 8 * static_cast<std::size_t>(first.height);
  for (int y = 0; y < first.height; ++y) {
    file += raw(std::uint64_t{rows + static_cast<std::size_t>(y) * (line + 8)});
  }
  for (int y = 0; y < first.height; ++y) {
    file += raw(std::int32_t{y}) + raw(static_cast<std::int32_t>(line));
    for (const auto& [name, image] : channels) {
      file.append(reinterpret_cast<const char*>(image.row(y)),
                  4 * static_cast<std::size_t>(image.width));
    }
  }
  std::ofstream(path, std::ios::binary) << file;
}

}  // namespace episcope::test
