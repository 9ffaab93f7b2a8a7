// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/image_header.h"

#include "engine/io/grid/decode_image.h"
#include "engine/io/grid/file_bytes.h"

#include <array>
#include <cstdint>
#include <istream>
#include <optional>
#include <string_view>
#include <utility>

namespace episcope::io {
namespace {

int length(std::uint32_t value) {
  constexpr std::uint32_t longest = 1 << 24;
  return value <= longest ? static_cast<int>(value) : 0;
}

SampleType of_bits(std::uint32_t bits) {
  return bits > 8 ? SampleType::UInt16 : SampleType::UInt8;
}

ImageHeader png_header(FileBytes& file) {
  constexpr std::uint32_t grey = 0;
  const std::uint32_t color = file.number(25, 1, false);
  return {length(file.number(20, 4, false)), length(file.number(16, 4, false)),
          color == grey ? 1 : 3, of_bits(file.number(24, 1, false))};
}

/// The first frame header among the segments.
ImageHeader jpeg_header(FileBytes& file) {
  constexpr int most_segments = 1000;
  std::streamoff at = 2;
  for (int i = 0; i < most_segments && !file.is_short(); ++i) {
    const std::uint32_t marker = file.number(at, 2, false);
    if (marker >> 8 != 0xff) return {};
    if (marker == 0xffff) {  // a fill byte
      ++at;
      continue;
    }
    const bool is_table = marker == 0xffc4 || marker == 0xffc8 || marker == 0xffcc;
    if (marker >= 0xffc0 && marker <= 0xffcf && !is_table) {
      return {length(file.number(at + 5, 2, false)), length(file.number(at + 7, 2, false)),
              file.number(at + 9, 1, false) == 1 ? 1 : 3, of_bits(file.number(at + 4, 1, false))};
    }
    at += 2 + static_cast<std::streamoff>(file.number(at + 2, 2, false));
  }
  return {};
}

ImageHeader bmp_header(FileBytes& file) {
  const bool has_palette = file.number(28, 2, true) <= 8;  // which may be grey or not
  const std::uint32_t height = file.number(22, 4, true);   // negative where it is from the top
  constexpr std::uint32_t sign = 1U << 31;
  return {length((height & sign) != 0 ? ~height + 1 : height), length(file.number(18, 4, true)),
          has_palette ? 0 : 3, SampleType::UInt8};
}

ImageHeader pnm_header(FileBytes& file, int channels) {
  std::istream& in = file.at(2);
  std::array<std::uint32_t, 3> numbers{};
  for (std::uint32_t& number : numbers) {
    while ((in >> std::ws).peek() == '#') in.ignore(1 << 16, '\n');
    in >> number;
  }
  if (!in) return {};
  return {length(numbers[1]), length(numbers[0]), channels, of_bits(numbers[2] > 255 ? 16 : 8)};
}

ImageHeader tiff_header(FileBytes& file, bool is_little_endian) {
  const auto number = [&](std::streamoff at, int count) {
    return file.number(at, count, is_little_endian);
  };
  constexpr std::uint32_t short_type = 3;
  constexpr std::uint32_t float_format = 3;
  ImageHeader header{0, 0, 1, SampleType::UInt8};
  std::uint32_t bits = 8;
  std::uint32_t format = 1;
  bool is_turned = false;  // decoded upright
  const std::streamoff directory = number(4, 4);
  const std::uint32_t entries = number(directory, 2);
  for (std::uint32_t i = 0; i < entries && !file.is_short(); ++i) {
    const std::streamoff at = directory + 2 + 12 * static_cast<std::streamoff>(i);
    const std::uint32_t type = number(at + 2, 2);
    const std::uint32_t count = number(at + 4, 4);
    // Several values do not fit into the entry, which says where they lie; all are alike.
    const std::streamoff place = type == short_type && count > 2 ? number(at + 8, 4) : at + 8;
    const std::uint32_t value = number(place, type == short_type ? 2 : 4);
    switch (number(at, 2)) {
      case 256:
        header.width = length(value);
        break;
      case 257:
        header.height = length(value);
        break;
      case 258:
        bits = value;
        break;
      case 274:
        is_turned = value >= 5 && value <= 8;
        break;
      case 277:
        header.channels = value < 3 ? 1 : 3;
        break;
      case 339:
        format = value;
        break;
      default:
        break;
    }
  }
  if (is_turned) std::swap(header.width, header.height);
  header.sample_type = format == float_format ? SampleType::Float32 : of_bits(bits);
  return header;
}

}  // namespace

std::optional<ImageHeader> stated_image_header(const std::filesystem::path& path) {
  FileBytes file(path);
  ImageHeader header;
  if (file.begins_with("\x89PNG\r\n\x1a\n")) {
    header = png_header(file);
  } else if (file.begins_with("\xff\xd8")) {
    header = jpeg_header(file);
  } else if (file.begins_with("BM")) {
    header = bmp_header(file);
  } else if (file.begins_with("P5") || file.begins_with("P2")) {
    header = pnm_header(file, 1);
  } else if (file.begins_with("P6") || file.begins_with("P3")) {
    header = pnm_header(file, 3);
  } else if (file.begins_with(std::string_view("II*\0", 4))) {
    header = tiff_header(file, true);
  } else if (file.begins_with(std::string_view("MM\0*", 4))) {
    header = tiff_header(file, false);
  }
  const bool is_whole = header.height > 0 && header.width > 0 && !file.is_short();
  return is_whole ? std::optional(header) : std::nullopt;
}

ImageHeader read_image_header(const std::filesystem::path& path) {
  if (const auto header = stated_image_header(path); header && header->channels > 0) return *header;
  return std::visit(
      []<class T>(const Image<T>& image) {
        constexpr SampleType type = sizeof(T) == 1   ? SampleType::UInt8
                                    : sizeof(T) == 2 ? SampleType::UInt16
                                                     : SampleType::Float32;
        return ImageHeader{image.height(), image.width(), image.channels(), type};
      },
      decode_image(path));
}

}  // namespace episcope::io
