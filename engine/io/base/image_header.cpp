// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/image_header.h"

#include "engine/core/error.h"
#include "engine/io/base/tiff_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <istream>
#include <limits>
#include <string>
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

/// Of plain ones, libraries bring 8 bits to their full range.
ImageHeader pnm_header(FileBytes& file, int channels, bool is_plain) {
  std::istream& in = file.at(2);
  std::array<std::uint32_t, 3> numbers{};
  for (std::uint32_t& number : numbers) {
    while ((in >> std::ws).peek() == '#') in.ignore(1 << 16, '\n');
    in >> number;
  }
  if (!in) return {};
  const bool is_word = numbers[2] > 255;
  const bool is_full = numbers[2] == 255 || numbers[2] >= 65535 || (is_plain && !is_word);
  return {length(numbers[1]), length(numbers[0]), channels, of_bits(is_word ? 16 : 8),
          is_full ? 0 : numbers[2]};
}

ImageHeader tiff_header(const std::filesystem::path& path) {
  constexpr std::uint64_t kWidth = 256, kHeight = 257, kBits = 258, kOrientation = 274,
                          kPhotometric = 262, kChannels = 277, kFormat = 339;
  constexpr std::uint32_t kUnsigned = 1;
  TiffFile file(path);
  const auto number = [&](std::uint64_t tag, std::uint32_t otherwise) {
    const auto value = file.tag(tag);
    return value ? static_cast<std::uint32_t>(value->number) : otherwise;
  };
  ImageHeader header{
      length(number(kHeight, 0)), length(number(kWidth, 0)), number(kChannels, 1) < 3 ? 1 : 3,
      number(kFormat, kUnsigned) == kUnsigned && number(kBits, 8) <= 16 ? of_bits(number(kBits, 8))
                                                                        : SampleType::Float32};
  header.is_white_zero = number(kPhotometric, 1) == 0;
  const std::uint32_t orientation = number(kOrientation, 1);
  const bool is_turned = orientation >= 5 && orientation <= 8;  // decoded upright
  if (is_turned) std::swap(header.width, header.height);
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
    header = pnm_header(file, 1, file.begins_with("P2"));
  } else if (file.begins_with("P6") || file.begins_with("P3")) {
    header = pnm_header(file, 3, file.begins_with("P3"));
  } else if (file.begins_with("II") || file.begins_with("MM")) {
    header = tiff_header(path);
  }
  const bool is_whole = header.height > 0 && header.width > 0 && !file.is_short();
  return is_whole ? std::optional(header) : std::nullopt;
}

namespace {

/// One of the values of a tag; 0 for types that are no positive numbers.
double number_of(TiffFile& file, std::uint64_t directory, std::uint64_t tag, std::uint64_t index,
                 double otherwise = 0) {
  constexpr std::uint64_t kShort = 3, kLong = 4, kRatio = 5;
  const auto value = file.tag(directory, tag);
  if (!value) return otherwise;
  if (value->type < kShort || value->type > kRatio) return 0;
  const std::uint64_t bytes = value->type == kShort ? 2 : value->type == kLong ? 4 : 8;
  const std::uint64_t place = value->place + bytes * index;
  if (value->type != kRatio) return static_cast<double>(file.at(place, bytes));
  const std::uint64_t below = file.at(place + 4, 4);
  return below == 0 ? 0 : static_cast<double>(file.at(place, 4)) / static_cast<double>(below);
}

int in_pixels(double value) {
  constexpr double kFarthest = 1 << 24;
  return static_cast<int>(std::lround(std::min(value, kFarthest)));
}

/// Of the position in units of the resolution, and of the part of a raw picture that is shown.
PagePlace place_of_page(TiffFile& file, std::uint64_t directory) {
  constexpr std::uint64_t kXResolution = 282, kYResolution = 283, kX = 286, kY = 287;
  constexpr std::uint64_t kCropOrigin = 50719, kActiveArea = 50829;  // of DNG
  const auto number = [&](std::uint64_t tag, std::uint64_t index, double otherwise = 0) {
    return number_of(file, directory, tag, index, otherwise);
  };
  const double x = number(kX, 0) * number(kXResolution, 0, 1);
  const double y = number(kY, 0) * number(kYResolution, 0, 1);
  return {in_pixels(x + number(kCropOrigin, 0) + number(kActiveArea, 1)),
          in_pixels(y + number(kCropOrigin, 1) + number(kActiveArea, 0))};
}

/// Of a chunk oFFs in pixels, before the samples.
PagePlace png_place(FileBytes& file) {
  constexpr std::uint32_t kOffsets = 0x6f464673, kSamples = 0x49444154;
  constexpr int kMostChunks = 1000;
  std::streamoff at = 8;
  for (int i = 0; i < kMostChunks && !file.is_short(); ++i) {
    const std::uint32_t bytes = file.number(at, 4, false), type = file.number(at + 4, 4, false);
    if (type == kSamples) return {};
    if (type == kOffsets && file.number(at + 16, 1, false) == 0) {
      return {static_cast<int>(file.number(at + 8, 4, false)),
              static_cast<int>(file.number(at + 12, 4, false))};
    }
    at += 12 + static_cast<std::streamoff>(bytes);
  }
  return {};
}

}  // namespace

PagePlace stated_place(const std::filesystem::path& path) {
  FileBytes file(path);
  if (file.begins_with("\x89PNG\r\n\x1a\n")) return png_place(file);
  TiffFile tiff(path);
  const auto directories = tiff.directories(0);
  return directories.empty() ? PagePlace() : place_of_page(tiff, directories.front());
}

std::vector<PagePlace> stated_places(const std::filesystem::path& path) {
  constexpr int kMostPages = 10000;
  TiffFile file(path);
  std::vector<PagePlace> places;
  for (const std::uint64_t directory : file.directories(kMostPages)) {
    places.push_back(place_of_page(file, directory));
  }
  return places;
}

std::optional<ImageSize> image_size(const std::filesystem::path& path) {
  const auto header = stated_image_header(path);
  return header ? std::optional(ImageSize{header->height, header->width}) : std::nullopt;
}

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHeaderBytes = 4096;
constexpr std::uint64_t kFewPixels = 16'000'000;
/// Of a byte: what the forms reach with pixels that are all alike.
constexpr std::uint64_t kMostPixelsPerByte = 1100;

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

std::optional<std::uint64_t> declared_pixels(const fs::path& path) {
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
  if (const auto claimed = declared_pixels(path)) require_plausible_pixels(path, *claimed);
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
  return std::max(kFewPixels, std::min<std::uint64_t>(bytes, dense) * kMostPixelsPerByte);
}

}  // namespace episcope::io
