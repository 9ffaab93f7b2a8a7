// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>

namespace episcope::io {

/// Bytes of a file; what lies behind its end reads as 0 and is remembered.
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

/// What `decode_image` would make of a file.
struct ImageHeader {
  int height = 0;
  int width = 0;
  int channels = 0;
  SampleType sample_type = SampleType::UInt8;
};

/// What the header of a PNG, JPEG, TIFF, BMP or PNM says; `channels` is 0 if a palette decides.
/// Nothing for other and for damaged files.
[[nodiscard]] std::optional<ImageHeader> stated_image_header(const std::filesystem::path& path);

struct ImageSize {
  int height = 0;
  int width = 0;
  friend bool operator==(const ImageSize&, const ImageSize&) = default;
  [[nodiscard]] long long area() const { return static_cast<long long>(height) * width; }
};

/// The size of an image as its header says, of PNG, JPEG, BMP and TIFF files; nothing is decoded.
/// Nothing for other and for damaged files.
[[nodiscard]] std::optional<ImageSize> image_size(const std::filesystem::path& path);

/// Pixels that the header of a picture claims, before any of them is decoded: JPEG, BMP, PNM, TIFF,
/// WebP, JPEG 2000, OpenEXR, Radiance. Nothing for other forms.
[[nodiscard]] std::optional<std::uint64_t> claimed_pixels(const std::filesystem::path& path);

/// Throws IoError if a picture claims more pixels than its file can hold, compressed as densely as
/// can be, unless they are few (16 million).
void require_plausible_picture(const std::filesystem::path& path);

/// The same for so many pixels that are claimed.
void require_plausible_pixels(const std::filesystem::path& path, std::uint64_t claimed);

/// Pixels that a picture of a file of so many bytes may claim.
[[nodiscard]] std::uint64_t most_plausible_pixels(std::uintmax_t bytes);

}  // namespace episcope::io
