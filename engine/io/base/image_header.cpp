// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/image_header.h"

#include "engine/core/error.h"

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

namespace {

/// The directories of a TIFF file.
class TiffDirectories {
 public:
  TiffDirectories(FileBytes& file, bool is_little_endian)
      : file_(file), is_little_endian_(is_little_endian), at_(number(4, 4)) {}

  [[nodiscard]] bool is_at_end() const { return at_ == 0 || file_.is_short(); }

  void step() { at_ = number(at_ + 2 + 12 * static_cast<std::streamoff>(number(at_, 2)), 4); }

  /// Of the position in units of the resolution, and of the part of a raw picture that is shown.
  [[nodiscard]] PagePlace place() {
    double x_pixels = 1, y_pixels = 1, x = 0, y = 0;  // pixels of a unit, units
    double left = 0, top = 0;                         // in pixels
    const std::uint32_t entries = number(at_, 2);
    for (std::uint32_t i = 0; i < entries && !file_.is_short(); ++i) {
      const std::streamoff entry = at_ + 2 + 12 * static_cast<std::streamoff>(i);
      switch (number(entry, 2)) {
        case 282:
          x_pixels = value(entry, 0);
          break;
        case 283:
          y_pixels = value(entry, 0);
          break;
        case 286:
          x = value(entry, 0);
          break;
        case 287:
          y = value(entry, 0);
          break;
        case kCropOrigin:
          left += value(entry, 0);
          top += value(entry, 1);
          break;
        case kActiveArea:
          top += value(entry, 0);
          left += value(entry, 1);
          break;
        default:
          break;
      }
    }
    return {in_pixels(x * x_pixels + left), in_pixels(y * y_pixels + top)};
  }

 private:
  static constexpr std::uint32_t kCropOrigin = 50719, kActiveArea = 50829;  // of DNG

  static int in_pixels(double value) {
    constexpr double kFarthest = 1 << 24;
    return static_cast<int>(std::lround(std::min(value, kFarthest)));
  }

  std::uint32_t number(std::streamoff at, int count) {
    return file_.number(at, count, is_little_endian_);
  }

  /// One of the values of an entry; 0 for types that are no positive numbers.
  double value(std::streamoff entry, int index) {
    constexpr std::uint32_t kShort = 3, kLong = 4, kRatio = 5;
    const std::uint32_t type = number(entry + 2, 2);
    const int bytes = type == kShort ? 2 : type == kLong ? 4 : 8;
    if (type < kShort || type > kRatio) return 0;
    const bool is_here = static_cast<std::uint64_t>(bytes) * number(entry + 4, 4) <= 4;
    const std::streamoff first = is_here ? entry + 8 : std::streamoff{number(entry + 8, 4)};
    const std::streamoff at = first + std::streamoff{bytes} * index;
    if (type != kRatio) return number(at, bytes);
    const std::uint32_t below = number(at + 4, 4);
    return below == 0 ? 0 : static_cast<double>(number(at, 4)) / below;
  }

  FileBytes& file_;
  bool is_little_endian_;
  std::streamoff at_;
};

std::optional<TiffDirectories> tiff_directories(FileBytes& file) {
  if (file.begins_with(std::string_view("II*\0", 4))) return TiffDirectories(file, true);
  if (file.begins_with(std::string_view("MM\0*", 4))) return TiffDirectories(file, false);
  return std::nullopt;
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
  auto directories = tiff_directories(file);
  return directories ? directories->place() : PagePlace();
}

std::vector<PagePlace> stated_places(const std::filesystem::path& path) {
  constexpr std::size_t kMostPages = 10000;
  FileBytes file(path);
  std::vector<PagePlace> places;
  auto directories = tiff_directories(file);
  for (; directories && !directories->is_at_end() && places.size() < kMostPages;
       directories->step()) {
    places.push_back(directories->place());
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
