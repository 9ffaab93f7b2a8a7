// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/exif_orientation.h"

#include "engine/core/text/suffix.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <map>
#include <string_view>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBegin = 65536;  ///< Bytes that hold the first segments of a JPEG file.
constexpr unsigned kOrientationTag = 0x0112;

/// Numbers of a part of a file, in either byte order; 0 behind its end.
class Bytes {
 public:
  Bytes(std::string_view bytes, bool is_little) : bytes_(bytes), is_little_(is_little) {}
  [[nodiscard]] unsigned word(std::size_t at) const { return number(at, 2); }
  [[nodiscard]] unsigned long_word(std::size_t at) const { return number(at, 4); }

 private:
  [[nodiscard]] unsigned number(std::size_t at, std::size_t length) const {
    if (at > bytes_.size() || bytes_.size() - at < length) return 0;
    unsigned value = 0;
    for (std::size_t i = 0; i < length; ++i) {
      const std::size_t place = is_little_ ? at + length - 1 - i : at + i;
      value = value << 8 | static_cast<std::uint8_t>(bytes_[place]);
    }
    return value;
  }

  std::string_view bytes_;
  bool is_little_;
};

/// Of the TIFF structure in an Exif segment; 0 if it states none.
int orientation_in(std::string_view tiff) {
  const Bytes bytes(tiff, tiff.starts_with("II"));
  const std::size_t directory = bytes.long_word(4);
  const std::size_t entries = std::min<std::size_t>(bytes.word(directory), 1000);
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t entry = directory + 2 + 12 * i;
    if (bytes.word(entry) == kOrientationTag) return static_cast<int>(bytes.word(entry + 8));
  }
  return 0;
}

/// Of the first Exif segment of a JPEG file; 0 if there is none.
int orientation_in_jpeg(std::string_view file) {
  constexpr std::string_view kExif("Exif\0\0", 6);
  const Bytes bytes(file, false);
  if (bytes.word(0) != 0xFFD8) return 0;
  std::size_t at = 2;
  while (at + 4 < file.size()) {
    const unsigned marker = bytes.word(at);
    const std::size_t length = bytes.word(at + 2);
    if (marker < 0xFF00 || marker == 0xFFDA || length < 2) return 0;  // samples begin
    const std::string_view segment = file.substr(at + 4, length - 2);
    if (marker == 0xFFE1 && segment.starts_with(kExif)) {
      return orientation_in(segment.substr(kExif.size()));
    }
    at += 2 + length;
  }
  return 0;
}

template <class T>
Image<T> upright_image(const Image<T>& stored, int orientation) {
  const bool is_turned = is_quarter_turn(orientation);
  const int height = is_turned ? stored.width() : stored.height();
  const int width = is_turned ? stored.height() : stored.width();
  // Where the first row, and the first column, of what was stored lie in the picture.
  const bool is_right_to_left =
      orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
  const bool is_upwards =
      orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
  Image<T> image(height, width, stored.channels());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int from_left = is_right_to_left ? width - 1 - x : x;
      const int from_top = is_upwards ? height - 1 - y : y;
      const T* in = is_turned ? &stored.at(from_left, from_top) : &stored.at(from_top, from_left);
      std::copy_n(in, stored.channels(), &image.at(y, x));
    }
  }
  return image;
}

}  // namespace

int exif_orientation(const fs::path& path) {
  const std::string suffix = suffix_of(path);
  if (suffix != ".jpg" && suffix != ".jpeg") return 1;
  std::ifstream in(path, std::ios::binary);
  std::string begin(kBegin, '\0');
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  const int orientation = orientation_in_jpeg(begin);
  return orientation >= 1 && orientation <= 8 ? orientation : 1;
}

AnyImage upright(const AnyImage& stored, int orientation) {
  if (orientation == 1) return stored;
  return std::visit(
      [&](const auto& image) -> AnyImage { return upright_image(image, orientation); }, stored);
}

CommonOrientation common_orientation(const std::vector<fs::path>& files) {
  constexpr const char* kMeanings[] = {"upright",
                                       "mirrored",
                                       "turned by half",
                                       "upside down and mirrored",
                                       "turned and mirrored",
                                       "turned by a quarter to the left",
                                       "turned and mirrored",
                                       "turned by a quarter to the right"};
  std::map<int, int> counts;
  for (const fs::path& file : files) ++counts[exif_orientation(file)];
  const auto most = std::ranges::max_element(counts, {}, &std::pair<const int, int>::second);
  if (counts.size() == 1) {
    const int value = most->first;
    if (value == 1) return {};
    return {value, fmt::format("All views state that they are stored {} (Exif orientation {}): "
                               "they are shown upright, with rows and columns of pixels to match.",
                               kMeanings[value - 1], value)};
  }
  if (counts.empty()) return {};
  return {1, fmt::format("The views state {} different orientations (Exif), {} of {} orientation "
                         "{}: all are taken as they are stored; if the camera was turned, turn "
                         "the pictures before.",
                         counts.size(), most->second, files.size(), most->first)};
}

}  // namespace episcope::io
