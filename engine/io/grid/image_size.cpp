// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/image_size.h"

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

namespace episcope::io {
namespace {

enum class Endian { Big, Little };

/// A file of which single numbers are read; `is_good` turns false where it ends.
class Header {
 public:
  explicit Header(const std::filesystem::path& path) : file_(path, std::ios::binary) {}

  [[nodiscard]] bool is_good() const { return static_cast<bool>(file_); }
  void seek(std::uint64_t place) { file_.seekg(static_cast<std::streamoff>(place)); }

  /// The next `bytes` of the file, as a number.
  std::uint32_t number(int bytes, Endian endian) {
    std::uint32_t value = 0;
    for (int i = 0; i < bytes; ++i) {
      const auto byte = static_cast<std::uint32_t>(file_.get() & 0xFF);
      value = endian == Endian::Big ? value << 8 | byte : value | byte << 8 * i;
    }
    return value;
  }

  bool begins_with(std::string_view text) {
    std::string begin(text.size(), '\0');
    seek(0);
    file_.read(begin.data(), static_cast<std::streamsize>(begin.size()));
    if (file_ && begin == text) return true;
    file_.clear();
    return false;
  }

 private:
  std::ifstream file_;
};

std::optional<ImageSize> checked(const Header& header, std::uint32_t height, std::uint32_t width) {
  constexpr std::uint32_t kLargest = std::numeric_limits<int>::max();
  if (!header.is_good() || height == 0 || width == 0 || height > kLargest || width > kLargest) {
    return std::nullopt;
  }
  return ImageSize{static_cast<int>(height), static_cast<int>(width)};
}

std::optional<ImageSize> png_size(Header& header) {
  header.seek(16);  // after the signature, length and type of the first chunk
  const std::uint32_t width = header.number(4, Endian::Big);
  return checked(header, header.number(4, Endian::Big), width);
}

std::optional<ImageSize> bmp_size(Header& header) {
  header.seek(18);
  const std::uint32_t width = header.number(4, Endian::Little);
  // Rows from top to bottom are told by a negative height.
  const auto height = static_cast<std::int32_t>(header.number(4, Endian::Little));
  return checked(header, static_cast<std::uint32_t>(std::llabs(height)), width);
}

/// The size is in the segment that begins a frame, SOF0 … SOF15 without DHT, JPG and DAC.
std::optional<ImageSize> jpeg_size(Header& header) {
  std::uint64_t place = 2;
  while (header.is_good()) {
    header.seek(place);
    if (header.number(1, Endian::Big) != 0xFF) return std::nullopt;
    const std::uint32_t marker = header.number(1, Endian::Big);
    if (marker == 0xFF) {  // a fill byte
      ++place;
      continue;
    }
    const std::uint32_t length = header.number(2, Endian::Big);
    if (length < 2) return std::nullopt;
    const bool is_frame =
        marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (is_frame) {
      (void)header.number(1, Endian::Big);  // bits of a sample
      const std::uint32_t height = header.number(2, Endian::Big);
      return checked(header, height, header.number(2, Endian::Big));
    }
    place += 2 + length;
  }
  return std::nullopt;
}

std::optional<ImageSize> tiff_size(Header& header, Endian endian) {
  constexpr std::uint32_t kWidth = 256;
  constexpr std::uint32_t kHeight = 257;
  constexpr std::uint32_t kShort = 3;
  header.seek(4);
  header.seek(header.number(4, endian));
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  const std::uint32_t entries = header.number(2, endian);
  for (std::uint32_t i = 0; i < entries && header.is_good(); ++i) {
    const std::uint32_t tag = header.number(2, endian);
    const std::uint32_t type = header.number(2, endian);
    (void)header.number(4, endian);  // count
    const bool is_short = type == kShort;
    const std::uint32_t value = header.number(is_short ? 2 : 4, endian);
    if (is_short) (void)header.number(2, endian);
    if (tag == kWidth) width = value;
    if (tag == kHeight) height = value;
  }
  return checked(header, height, width);
}

}  // namespace

std::optional<ImageSize> image_size(const std::filesystem::path& path) {
  Header header(path);
  if (header.begins_with("\x89PNG\r\n\x1A\n")) return png_size(header);
  if (header.begins_with("\xFF\xD8")) return jpeg_size(header);
  if (header.begins_with("BM")) return bmp_size(header);
  if (header.begins_with(std::string_view("II*\0", 4))) return tiff_size(header, Endian::Little);
  if (header.begins_with(std::string_view("MM\0*", 4))) return tiff_size(header, Endian::Big);
  return std::nullopt;
}

}  // namespace episcope::io
