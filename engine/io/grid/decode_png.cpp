// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/decode_png.h"

#include "engine/core/error.h"
#include "engine/io/durable/system_error.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <csetjmp>
#include <cstdio>
#include <fstream>
#include <limits>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kSignatureBytes = 8;
/// More than deflate can reach, 1032.
constexpr std::uintmax_t kLargestExpansion = 1100;
constexpr std::size_t kBufferBytes = 1 << 20;

/// An open file and its decoder. Errors of libpng jump: its functions are called only from the two
/// members below that set the place to jump to, which hold nothing to be destroyed.
class PngDecoder {
 public:
  explicit PngDecoder(const fs::path& path) : file_(std::fopen(path.c_str(), "rb")) {
    if (file_ == nullptr) require_readable_file(path);
    const auto on_error = [](png_structp png, png_const_charp) { png_longjmp(png, 1); };
    const auto on_warning = [](png_structp, png_const_charp) {};
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, on_error, on_warning);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
  }
  ~PngDecoder() {
    png_destroy_read_struct(&png_, &info_, nullptr);
    if (file_ != nullptr) std::fclose(file_);
  }
  PngDecoder(const PngDecoder&) = delete;
  PngDecoder& operator=(const PngDecoder&) = delete;

  /// Whether all before the samples could be read; sets the sizes below.
  [[nodiscard]] bool read_header() {
    if (file_ == nullptr || info_ == nullptr) return false;
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    std::setvbuf(file_, nullptr, _IOFBF, kBufferBytes);
    png_init_io(png_, file_);
    png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    png_read_info(png_, info_);
    png_set_expand(png_);
    png_set_strip_alpha(png_);
    if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);
    passes_ = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    width = static_cast<int>(png_get_image_width(png_, info_));
    height = static_cast<int>(png_get_image_height(png_, info_));
    channels = png_get_channels(png_, info_);
    bits = png_get_bit_depth(png_, info_);
    row_bytes = png_get_rowbytes(png_, info_);
    return true;
  }

  [[nodiscard]] bool is_interlaced() const { return passes_ > 1; }

  /// Decodes `count` rows of `row_bytes` that follow each other; false for a damaged file.
  [[nodiscard]] bool read_rows(png_bytep first, int count) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    for (int pass = 0; pass < passes_; ++pass) {
      for (int y = 0; y < count; ++y) png_read_row(png_, first + y * row_bytes, nullptr);
    }
    if (count == height) png_read_end(png_, nullptr);
    return true;
  }

  int width = 0;
  int height = 0;
  int channels = 0;
  int bits = 0;
  std::size_t row_bytes = 0;

 private:
  std::FILE* file_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  int passes_ = 1;
};

[[noreturn]] void refuse(const fs::path& path) {
  throw IoError(path,
                "the image cannot be decoded: it is damaged or its format does not match its name; "
                "copy or export it again");
}

template <class T>
AnyImage read_samples(PngDecoder& png, const fs::path& path, int rows) {
  Image<T> image(rows, png.width, png.channels);
  if (!png.read_rows(reinterpret_cast<png_bytep>(image.data()), rows)) refuse(path);
  return image;
}

}  // namespace

bool has_png_signature(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<png_byte, kSignatureBytes> begin{};
  file.read(reinterpret_cast<char*>(begin.data()), begin.size());
  return file && png_sig_cmp(begin.data(), 0, begin.size()) == 0;
}

AnyImage decode_png(const fs::path& path) {
  return decode_png_top(path, std::numeric_limits<int>::max());
}

AnyImage decode_png_top(const fs::path& path, int rows) {
  PngDecoder png(path);
  if (!png.read_header() || (png.bits != 8 && png.bits != 16)) refuse(path);
  if (png.row_bytes * png.height / kLargestExpansion > fs::file_size(path)) refuse(path);
  const int count = png.is_interlaced() ? png.height : std::min(rows, png.height);
  return png.bits == 8 ? read_samples<std::uint8_t>(png, path, count)
                       : read_samples<std::uint16_t>(png, path, count);
}

}  // namespace episcope::io
