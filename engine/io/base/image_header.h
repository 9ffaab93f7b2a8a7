// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"

#include <array>
#include <compare>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <vector>

namespace episcope::io {

/// Reader of single bytes of a file. Bytes behind its end read as 0, and `is_short` remembers it.
class FileBytes {
 public:
  explicit FileBytes(const std::filesystem::path& path) : in_(path, std::ios::binary) {}

  [[nodiscard]] std::uint32_t number(std::streamoff at, int count, bool is_little_endian) {
    std::array<unsigned char, 4> bytes{};
    in_.clear();
    in_.seekg(at);
    in_.read(reinterpret_cast<char*>(bytes.data()), count);
    if (!in_) is_short_ = true;
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i) {
      const int place = is_little_endian ? count - 1 - i : i;
      value = value << 8 | bytes[static_cast<std::size_t>(place)];
    }
    return value;
  }
  [[nodiscard]] bool begins_with(std::string_view signature) {
    for (std::size_t i = 0; i < signature.size(); ++i) {
      const auto expected = static_cast<unsigned char>(signature[i]);
      if (number(static_cast<std::streamoff>(i), 1, true) != expected) return false;
    }
    return true;
  }
  [[nodiscard]] std::istream& at(std::streamoff place) {
    in_.clear();
    in_.seekg(place);
    return in_;
  }
  [[nodiscard]] bool is_short() const { return is_short_; }

 private:
  std::ifstream in_;
  bool is_short_ = false;
};

/// Shape and sample type of the image that `decode_image` returns.
struct ImageHeader {
  int height = 0;
  int width = 0;
  int channels = 0;
  SampleType sample_type = SampleType::UInt8;
  std::uint32_t white = 0;     ///< Value of white that a PNM states; 0 = the largest of the type.
  bool is_white_zero = false;  ///< Of a TIFF whose 0 is white.
};

/// Reads the header of a PNG, JPEG, TIFF, BMP or PNM. `channels` is 0 if a palette decides. Returns
/// nothing for other and for damaged files.
[[nodiscard]] std::optional<ImageHeader> stated_image_header(const std::filesystem::path& path);

/// Where a picture lies in its page, in px to the right and down.
struct PagePlace {
  int x = 0;
  int y = 0;
  friend auto operator<=>(const PagePlace&, const PagePlace&) = default;
};

/// Reads the place that a TIFF (XPosition, YPosition, and the crop of a DNG) or PNG file (oFFs)
/// states; {0, 0} if there is none.
[[nodiscard]] PagePlace stated_place(const std::filesystem::path& path);

/// Reads the places that the pages of a TIFF file state, up to 10,000. Empty for other files.
[[nodiscard]] std::vector<PagePlace> stated_places(const std::filesystem::path& path);

struct ImageSize {
  int height = 0;
  int width = 0;
  friend bool operator==(const ImageSize&, const ImageSize&) = default;
  [[nodiscard]] long long area() const { return static_cast<long long>(height) * width; }
};

/// Reads the size of a PNG, JPEG, BMP or TIFF image from its header. Returns nothing for other and
/// for damaged files.
[[nodiscard]] std::optional<ImageSize> image_size(const std::filesystem::path& path);

/// Number of pixels that the header declares, before any is decoded: JPEG, BMP, PNM, TIFF, WebP,
/// JPEG 2000, OpenEXR, Radiance. Nothing for other formats.
[[nodiscard]] std::optional<std::uint64_t> declared_pixels(const std::filesystem::path& path);

/// Throws IoError if a picture declares more pixels than its file can hold at the densest
/// compression. 16 million pixels are always allowed.
void require_plausible_picture(const std::filesystem::path& path);

/// Throws IoError if a file of this size cannot hold `claimed` pixels.
void require_plausible_pixels(const std::filesystem::path& path, std::uint64_t claimed);

/// Largest number of pixels that a file of so many bytes may declare.
[[nodiscard]] std::uint64_t most_plausible_pixels(std::uintmax_t bytes);

}  // namespace episcope::io
