// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/radiance.h"

#include "engine/core/error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr int kRadiancePlanes = 4;  // red, green, blue, exponent
constexpr int kShortestRuns = 8, kLongestRuns = 0x7fff;
constexpr int kLongestLiteral = 128;
constexpr std::uint64_t kMostPixelsOfByte = 16;  ///< A run of 127 takes 2 bytes a plane.
constexpr int kExponentOffset = 128 + 8;

/// What is left of a file.
class RadianceBytes {
 public:
  explicit RadianceBytes(const fs::path& path) : path_(path) {
    std::ifstream in(path, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(in), {});
  }

  [[noreturn]] void refuse(const char* why) const {
    throw IoError(path_, std::string("the image cannot be decoded: ") + why);
  }
  [[noreturn]] void refuse_damaged() const { refuse("it is damaged; copy or export it again"); }

  [[nodiscard]] std::size_t size() const { return bytes_.size(); }

  /// Without its end of line.
  std::string_view line() {
    const auto end = bytes_.find('\n', at_);
    if (end == std::string::npos) refuse_damaged();
    const std::string_view found = std::string_view(bytes_).substr(at_, end - at_);
    at_ = end + 1;
    return found;
  }
  int next() {
    if (at_ == bytes_.size()) refuse_damaged();
    return static_cast<unsigned char>(bytes_[at_++]);
  }
  /// Whether the next row is stored in runs; passes by what says so.
  bool pass_mark_of_runs(int width) {
    if (width < kShortestRuns || width > kLongestRuns || bytes_.size() - at_ < 4) return false;
    const auto byte = [this](std::size_t i) { return static_cast<unsigned char>(bytes_[at_ + i]); };
    if (byte(0) != 2 || byte(1) != 2 || byte(2) >= 128) return false;
    if (byte(2) * 256 + byte(3) != width) refuse_damaged();
    at_ += 4;
    return true;
  }

 private:
  const fs::path& path_;
  std::string bytes_;
  std::size_t at_ = 0;
};

struct RadianceSize {
  int height = 0, width = 0;
};

RadianceSize read_radiance_header(RadianceBytes& bytes) {
  bytes.line();
  for (std::string_view line = bytes.line(); !line.empty(); line = bytes.line()) {
    if (line.starts_with("FORMAT=") && !line.starts_with("FORMAT=32-bit_rle_rgbe")) {
      bytes.refuse("its pixels are not RGB with a common exponent; export it again");
    }
  }
  const std::string_view text = bytes.line();
  RadianceSize size;
  const auto number = [&](std::string_view axis, int& length) {
    const auto at = text.find(axis);
    if (at == std::string_view::npos) {
      bytes.refuse("its rows do not run from top to bottom; export it again");
    }
    std::from_chars(text.data() + at + axis.size(), text.data() + text.size(), length);
  };
  number("-Y ", size.height);
  number("+X ", size.width);
  if (size.height < 1 || size.width < 1) bytes.refuse_damaged();
  const auto pixels =
      static_cast<std::uint64_t>(size.height) * static_cast<std::uint64_t>(size.width);
  if (pixels > kMostPixelsOfByte * bytes.size()) bytes.refuse_damaged();
  return size;
}

void read_runs(RadianceBytes& bytes, int width, std::uint8_t* plane) {
  for (int x = 0; x < width;) {
    int count = bytes.next();
    const bool is_run = count > kLongestLiteral;
    if (is_run) count -= kLongestLiteral;
    if (count == 0 || count > width - x) bytes.refuse_damaged();
    if (is_run) {
      std::fill_n(plane + x, count, static_cast<std::uint8_t>(bytes.next()));
    } else {
      for (int i = 0; i < count; ++i) plane[x + i] = static_cast<std::uint8_t>(bytes.next());
    }
    x += count;
  }
}

void read_row(RadianceBytes& bytes, int width,
              const std::array<std::uint8_t*, kRadiancePlanes>& planes) {
  if (bytes.pass_mark_of_runs(width)) {
    for (std::uint8_t* const plane : planes) read_runs(bytes, width, plane);
    return;
  }
  for (int x = 0; x < width; ++x) {
    for (std::uint8_t* const plane : planes) plane[x] = static_cast<std::uint8_t>(bytes.next());
  }
}

}  // namespace

bool has_radiance_signature(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string begin(10, '\0');
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return begin.starts_with("#?RADIANCE") || begin.starts_with("#?RGBE");
}

Image<float> decode_radiance(const fs::path& path) {
  RadianceBytes bytes(path);
  const auto [height, width] = read_radiance_header(bytes);
  std::vector<std::uint8_t> row(static_cast<std::size_t>(width) * kRadiancePlanes);
  std::array<std::uint8_t*, kRadiancePlanes> planes{};
  for (int i = 0; i < kRadiancePlanes; ++i)
    planes[i] = row.data() + static_cast<std::ptrdiff_t>(i) * width;
  Image<float> image(height, width, 3);
  for (int y = 0; y < height; ++y) {
    read_row(bytes, width, planes);
    for (int x = 0; x < width; ++x) {
      const int exponent = planes[3][x];
      const float unit = exponent == 0 ? 0 : std::ldexp(1.0F, exponent - kExponentOffset);
      for (int c = 0; c < 3; ++c) image.at(y, x, c) = unit * static_cast<float>(planes[c][x]);
    }
  }
  return image;
}

}  // namespace episcope::io
