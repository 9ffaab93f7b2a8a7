// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/image_orientation.h"

#include "engine/core/text.h"
#include "engine/io/base/image_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kOrientationTag = 0x0112;
constexpr int kMostEntries = 1000;  ///< Of segments, and of tags.

/// Of the TIFF structure in an Exif segment; 0 if it states none.
int orientation_in(FileBytes& file, std::streamoff tiff) {
  const bool is_little = file.number(tiff, 2, true) == 0x4949;  // "II"
  const auto number = [&](std::streamoff at, int count) {
    return static_cast<int>(file.number(at, count, is_little));
  };
  const std::streamoff directory = tiff + file.number(tiff + 4, 4, is_little);
  const int entries = std::min(number(directory, 2), kMostEntries);
  for (int i = 0; i < entries && !file.is_short(); ++i) {
    const std::streamoff entry = directory + 2 + 12 * i;
    if (number(entry, 2) == kOrientationTag) return number(entry + 8, 2);
  }
  return 0;
}

/// Of the first Exif segment of a JPEG file; 0 if there is none.
int orientation_in_jpeg(FileBytes& file) {
  constexpr std::uint32_t kExif = 0x45786966;
  std::streamoff at = 2;
  for (int i = 0; i < kMostEntries && !file.is_short(); ++i) {
    const std::uint32_t marker = file.number(at, 2, false), length = file.number(at + 2, 2, false);
    if (marker < 0xFF00 || marker == 0xFFDA || length < 2) return 0;  // samples begin
    const bool is_exif =
        file.number(at + 4, 4, false) == kExif && file.number(at + 8, 2, false) == 0;
    if (marker == 0xFFE1 && is_exif) return orientation_in(file, at + 10);
    at += 2 + static_cast<std::streamoff>(length);
  }
  return 0;
}

/// Of the eXIf chunk of a PNG file, before its samples; 0 if there is none.
int orientation_in_png(FileBytes& file) {
  constexpr std::uint32_t kExif = 0x65584966, kSamples = 0x49444154;
  std::streamoff at = 8;
  for (int i = 0; i < kMostEntries && !file.is_short(); ++i) {
    const std::uint32_t length = file.number(at, 4, false), type = file.number(at + 4, 4, false);
    if (type == kExif) return orientation_in(file, at + 8);
    if (type == kSamples) return 0;
    at += 12 + static_cast<std::streamoff>(length);
  }
  return 0;
}

/// Of the EXIF chunk of a WebP file, which may begin as the segment of a JPEG file does; 0 if there
/// is none.
int orientation_in_webp(FileBytes& file) {
  constexpr std::uint32_t kExif = 0x45584946, kSegment = 0x45786966;
  if (file.number(8, 4, false) != 0x57454250) return 0;  // "WEBP"
  std::streamoff at = 12;
  for (int i = 0; i < kMostEntries && !file.is_short(); ++i) {
    const std::uint32_t type = file.number(at, 4, false), length = file.number(at + 4, 4, true);
    const bool is_segment = type == kExif && file.number(at + 8, 4, false) == kSegment;
    if (type == kExif) return orientation_in(file, at + 8 + (is_segment ? 6 : 0));
    at += 8 + static_cast<std::streamoff>(length) + length % 2;
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
  const bool can_state =
      suffix == ".jpg" || suffix == ".jpeg" || suffix == ".png" || suffix == ".webp";
  if (!can_state) return 1;
  FileBytes file(path);
  const int orientation = file.begins_with("\xff\xd8")            ? orientation_in_jpeg(file)
                          : file.begins_with("\x89PNG\r\n\x1a\n") ? orientation_in_png(file)
                          : file.begins_with("RIFF")              ? orientation_in_webp(file)
                                                                  : 0;
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
