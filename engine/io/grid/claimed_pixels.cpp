// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/claimed_pixels.h"

#include "engine/core/error.h"
#include "engine/io/grid/image_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHeaderBytes = 4096;
constexpr std::uint64_t kFewPixels = 16'000'000;
/// Of a byte: what the forms reach with pixels that are all alike.
constexpr std::uint64_t kMostPixels = 1100;

using Claim = std::optional<std::uint64_t>;

std::string beginning_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string bytes(kHeaderBytes, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

/// Unsigned; 0 where the bytes end.
std::uint64_t little(std::string_view bytes, std::size_t at, std::size_t count) {
  std::uint64_t number = 0;
  for (std::size_t i = count; i-- > 0;) {
    number = number << 8 | (at + i < bytes.size() ? static_cast<unsigned char>(bytes[at + i]) : 0);
  }
  return number;
}

std::uint64_t big(std::string_view bytes, std::size_t at, std::size_t count) {
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < count; ++i) number = number << 8 | little(bytes, at + i, 1);
  return number;
}

Claim webp_pixels(std::string_view bytes) {
  const std::string_view chunk = bytes.substr(12, 4);
  if (chunk == "VP8X") return (little(bytes, 24, 3) + 1) * (little(bytes, 27, 3) + 1);
  if (chunk == "VP8L") {
    const std::uint64_t sides = little(bytes, 21, 4);
    return ((sides & 0x3fff) + 1) * ((sides >> 14 & 0x3fff) + 1);
  }
  return (little(bytes, 26, 2) & 0x3fff) * (little(bytes, 28, 2) & 0x3fff);
}

Claim jpeg_2000_pixels(std::string_view bytes) {
  if (const auto box = bytes.find("ihdr"); box != std::string_view::npos) {
    return big(bytes, box + 4, 4) * big(bytes, box + 8, 4);
  }
  const auto size = bytes.find("\xff\x51");
  if (size == std::string_view::npos) return std::nullopt;
  return big(bytes, size + 6, 4) * big(bytes, size + 10, 4);
}

Claim exr_pixels(std::string_view bytes) {
  constexpr std::string_view name("dataWindow\0box2i\0", 17);
  const auto found = bytes.find(name);
  if (found == std::string_view::npos) return std::nullopt;
  const auto corner = [&](std::size_t i) {
    return std::int64_t{static_cast<std::int32_t>(little(bytes, found + name.size() + 4 * i, 4))};
  };
  const std::int64_t width = corner(3) - corner(1) + 1;
  const std::int64_t height = corner(4) - corner(2) + 1;
  if (width < 1 || height < 1) return std::nullopt;
  return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
}

/// "-Y 512 +X 768"
Claim radiance_pixels(std::string_view bytes) {
  const auto side = [&](std::string_view axis) -> std::uint64_t {
    const auto at = bytes.find(axis);
    std::uint32_t length = 0;
    if (at != std::string_view::npos) {
      std::from_chars(bytes.data() + at + axis.size(), bytes.data() + bytes.size(), length);
    }
    return length;
  };
  return side("Y ") * side("X ");
}

}  // namespace

std::optional<std::uint64_t> claimed_pixels(const fs::path& path) {
  const std::string bytes = beginning_of(path);
  const std::string_view begin(bytes);
  if (begin.starts_with("RIFF") && begin.substr(0, 12).ends_with("WEBP")) return webp_pixels(begin);
  if (begin.starts_with("\xff\x4f") || begin.substr(0, 12).find("jP  ") == 4) {
    return jpeg_2000_pixels(begin);
  }
  if (begin.starts_with("\x76\x2f\x31\x01")) return exr_pixels(begin);
  if (begin.starts_with("#?RA") || begin.starts_with("#?RGBE")) return radiance_pixels(begin);
  const auto header = stated_image_header(path);
  if (!header) return std::nullopt;
  return static_cast<std::uint64_t>(header->height) * static_cast<std::uint64_t>(header->width);
}

void require_plausible_picture(const fs::path& path) {
  if (const auto claimed = claimed_pixels(path)) require_plausible_pixels(path, *claimed);
}

void require_plausible_pixels(const fs::path& path, std::uint64_t claimed) {
  if (claimed <= kFewPixels) return;
  const std::uintmax_t bytes = fs::file_size(path);
  if (claimed <= most_plausible_pixels(bytes)) return;
  throw IoError(path, fmt::format("the image cannot be decoded: it claims {:.3g} million "
                                  "pixels, which its {} bytes cannot hold; copy or export it again",
                                  static_cast<double>(claimed) / 1e6, bytes));
}

std::uint64_t most_plausible_pixels(std::uintmax_t bytes) {
  const std::uint64_t dense = std::numeric_limits<std::uint32_t>::max();
  return std::max(kFewPixels, std::min<std::uint64_t>(bytes, dense) * kMostPixels);
}

}  // namespace episcope::io
