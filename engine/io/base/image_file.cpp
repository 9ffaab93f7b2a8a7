// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/image_file.h"

#include "engine/core/error.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"
#include "engine/io/base/quiet_decoding.h"
#include "engine/io/base/radiance.h"
#include "engine/io/base/rare_tiff.h"
#include "engine/io/base/tiff_file.h"

#include <fmt/format.h>
#include <png.h>
#include <zlib.h>
#include <opencv2/imgcodecs.hpp>

#include <bit>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <istream>
#include <iterator>
#include <limits>
#include <string_view>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnd = "\xff\xd9";  ///< In samples, a 0 follows each 0xff.
constexpr std::streamoff kTail = 512;

/// Where the samples begin: what lies before may be a small picture with an end of its own. 0 if
/// they do not begin.
std::streamoff samples_of(FileBytes& file) {
  constexpr std::uint32_t kScan = 0xffda;
  constexpr int kMostSegments = 1000;
  std::streamoff at = 2;
  for (int i = 0; i < kMostSegments && !file.is_short(); ++i) {
    const std::uint32_t marker = file.number(at, 2, false);
    if (marker >> 8 != 0xff) return 0;
    if (marker == kScan) return at;
    at += marker == 0xffff ? 1 : 2 + static_cast<std::streamoff>(file.number(at + 2, 2, false));
  }
  return 0;
}

bool has_end_from(std::istream& in) {
  std::array<char, 1 << 16> block{};
  bool is_after_mark = false;  // the last byte of the block before was 0xff
  while (in.read(block.data(), block.size()) || in.gcount() > 0) {
    const std::string_view bytes(block.data(), static_cast<std::size_t>(in.gcount()));
    if (is_after_mark && bytes.front() == kEnd.back()) return true;
    if (bytes.find(kEnd) != std::string_view::npos) return true;
    is_after_mark = bytes.back() == kEnd.front();
  }
  return false;
}

/// Throws IoError for a JPEG file that ends before its picture does, of which libraries make one
/// that is grey from there on. Nothing for other files.
void require_whole_jpeg(const fs::path& path) {
  FileBytes file(path);
  if (!file.begins_with("\xff\xd8")) return;
  const std::streamoff samples = samples_of(file);
  if (samples == 0) return;
  const auto size = static_cast<std::streamoff>(fs::file_size(path));
  if (has_end_from(file.at(std::max(samples, size - kTail)))) return;
  if (has_end_from(file.at(samples))) return;  // other pictures or notes follow the first
  throw IoError(path,
                "the image cannot be decoded: the file ends before the picture does; copy or "
                "export it again");
}

template <class T>
Image<T> copy_rgb(const cv::Mat& decoded) {
  const int stored = decoded.channels();
  const int channels = stored < 3 ? 1 : 3;
  Image<T> image(decoded.rows, decoded.cols, channels);
  for (int y = 0; y < decoded.rows; ++y) {
    const T* in = decoded.ptr<T>(y);
    T* out = image.row(y);
    for (int x = 0; x < decoded.cols; ++x, in += stored, out += channels) {
      for (int c = 0; c < channels; ++c) out[c] = in[channels - 1 - c];  // stored as BGR
    }
  }
  return image;
}

bool is_animated_webp(const fs::path& path) {
  constexpr std::uint32_t kAnimation = 2;
  FileBytes file(path);
  return file.begins_with("RIFF") && file.number(8, 4, false) == 0x57454250 &&  // "WEBP"
         file.number(12, 4, false) == 0x56503858 &&                             // "VP8X"
         (file.number(20, 1, false) & kAnimation) != 0;
}

/// "floats of 16 bits", of a TIFF file whose samples are not decoded; else empty.
std::string unread_tiff_samples(const fs::path& path) {
  constexpr std::uint64_t kBits = 258, kFormat = 339, kFloats = 3;
  TiffFile file(path);
  const auto bits = file.tag(kBits);
  const auto format = file.tag(kFormat);
  const bool is_float = format && format->number == kFloats;
  const bool is_unread = bits && (is_float ? bits->number < 32 : bits->number > 16);
  if (!is_unread) return {};
  return fmt::format("{} of {} bits", is_float ? "floats" : "integers", bits->number);
}

[[noreturn]] void refuse_image(const fs::path& path) {
  if (fs::file_size(path) == 0) {
    throw IoError(path, kEmptyFile);
  }
  if (is_animated_webp(path)) {
    throw IoError(path,
                  "animated WebP files are not read; save the pictures as PNG files in a folder, "
                  "or as an animated PNG");
  }
  if (const std::string samples = unread_tiff_samples(path); !samples.empty()) {
    throw IoError(path, "TIFF files of " + samples +
                            " are not read; save it as 32-bit float, or as 8 or 16 bits");
  }
  throw IoError(path,
                "the image cannot be decoded: it is damaged or its format does not match its name; "
                "copy or export it again");
}

/// OpenCV decodes OpenEXR only where the environment says so, which it asks once.
void allow_openexr() {
  static const int is_set = setenv("OPENCV_IO_ENABLE_OPENEXR", "1", 0);
  static_cast<void>(is_set);
}

/// A plain PNM file whose last number nothing follows, which OpenCV takes for cut off.
cv::Mat with_line_end(const fs::path& path) {
  FileBytes file(path);
  if (!file.begins_with("P2") && !file.begins_with("P3")) return {};
  std::string text(std::istreambuf_iterator<char>(file.at(0)), {});
  text += '\n';
  return cv::imdecode(std::vector<char>(text.begin(), text.end()), cv::IMREAD_UNCHANGED);
}

/// A picture as OpenCV decodes it.
struct DecodedMat {
  cv::Mat pixels;
  std::optional<cv::Rect> stored{};  ///< The pixels that the file holds, if not all.
};

/// The stored pixels in their place of the picture; what is not stored is 0, of depth unknown.
DecodedMat in_display(const fs::path& path, const cv::Mat& stored, const ExrPicture& exr,
                      PicturePart part) {
  const auto [left, top, width, height] = exr.display;
  const bool has_windows = width > 0 && height > 0 && stored.cols == exr.data.width;
  if (!has_windows || exr.data == exr.display) return {stored};
  constexpr std::int64_t kMostSide = std::numeric_limits<int>::max() / 2;
  const std::int64_t x = exr.data.left - left, y = exr.data.top - top;
  if (std::max({width, height, std::abs(x), std::abs(y)}) > kMostSide) refuse_image(path);
  require_plausible_pixels(path, static_cast<std::uint64_t>(width * height));
  const bool is_depth = part == PicturePart::Depth && stored.depth() == CV_32F;
  const double unknown = is_depth ? std::numeric_limits<double>::quiet_NaN() : 0;
  cv::Mat picture(static_cast<int>(height), static_cast<int>(width), stored.type(),
                  cv::Scalar::all(unknown));
  const cv::Rect place(static_cast<int>(x), static_cast<int>(y), stored.cols, stored.rows);
  const cv::Rect seen = place & cv::Rect(0, 0, picture.cols, picture.rows);
  if (!seen.empty()) stored(seen - place.tl()).copyTo(picture(seen));
  return {picture, seen};
}

/// Samples as they are read: others than 8 or 16 bits without a sign become floats.
cv::Mat in_read_type(cv::Mat decoded) {
  const int depth = decoded.depth();
  if (depth != CV_8U && depth != CV_16U) decoded.convertTo(decoded, CV_32F);
  return decoded;
}

DecodedMat read_mat(const fs::path& path, PicturePart part) {
  allow_openexr();
  const QuietDecoding quiet;
  const auto exr = read_exr(path, part);
  cv::Mat decoded;
  try {
    decoded = exr && !exr->renamed.empty() ? cv::imdecode(exr->renamed, cv::IMREAD_UNCHANGED)
                                           : cv::imread(path.string(), cv::IMREAD_UNCHANGED);
    if (decoded.empty()) decoded = with_line_end(path);
  } catch (const cv::Exception&) {
    decoded.release();
  }
  if (decoded.empty()) {
    const std::vector<cv::Mat> rare = decode_rare_tiff(path, 1);
    if (rare.empty()) refuse_image(path);
    decoded = rare.front();
  }
  decoded = in_read_type(decoded);
  return exr ? in_display(path, decoded, *exr, part) : DecodedMat{decoded};
}

AnyImage image_of(const cv::Mat& decoded) {
  if (decoded.depth() == CV_8U) return copy_rgb<std::uint8_t>(decoded);
  if (decoded.depth() == CV_16U) return copy_rgb<std::uint16_t>(decoded);
  return copy_rgb<float>(decoded);
}

/// 1 where the last of 2 or 4 channels is not 0; empty if there is no such channel.
template <class T>
Image<std::uint8_t> opaque_in(const cv::Mat& pixels) {
  const int channels = pixels.channels();
  if (channels % 2 != 0) return {};
  Image<std::uint8_t> seen(pixels.rows, pixels.cols);
  for (int y = 0; y < pixels.rows; ++y) {
    const T* alpha = pixels.ptr<T>(y) + channels - 1;
    for (int x = 0; x < pixels.cols; ++x, alpha += channels) seen.at(y, x) = *alpha != 0 ? 1 : 0;
  }
  return seen;
}

Image<std::uint8_t> opaque_in(const cv::Mat& pixels) {
  if (pixels.depth() == CV_8U) return opaque_in<std::uint8_t>(pixels);
  return pixels.depth() == CV_16U ? opaque_in<std::uint16_t>(pixels) : opaque_in<float>(pixels);
}

/// Empty if all pixels are seen.
Image<std::uint8_t> seen_in(const DecodedMat& decoded) {
  Image<std::uint8_t> seen = opaque_in(decoded.pixels);
  if (decoded.stored) {
    const cv::Mat& pixels = decoded.pixels;
    if (seen.empty()) seen = Image<std::uint8_t>(pixels.rows, pixels.cols, 1, 1);
    for (int y = 0; y < seen.height(); ++y) {
      for (int x = 0; x < seen.width(); ++x) {
        if (!decoded.stored->contains({x, y})) seen.at(y, x) = 0;
      }
    }
  }
  return std::ranges::find(seen, std::uint8_t{0}) == seen.end() ? Image<std::uint8_t>()
                                                                : std::move(seen);
}

}  // namespace

AnyImage decode_image(const fs::path& path, PicturePart part) {
  require_readable_file(path);
  if (has_png_signature(path)) return decode_png(path);
  require_plausible_picture(path);
  if (has_radiance_signature(path)) return decode_radiance(path);
  require_whole_jpeg(path);
  return image_of(read_mat(path, part).pixels);
}

std::vector<SeenImage> decode_pages(const fs::path& path, int count) {
  require_readable_file(path);
  require_plausible_picture(path);
  const QuietDecoding quiet;
  std::vector<cv::Mat> decoded;
  try {
    if (!cv::imreadmulti(path.string(), decoded, 0, count, cv::IMREAD_UNCHANGED)) decoded.clear();
  } catch (const cv::Exception&) {
    decoded.clear();
  }
  if (static_cast<int>(decoded.size()) != count) decoded = decode_rare_tiff(path, count);
  if (static_cast<int>(decoded.size()) != count) refuse_image(path);
  std::vector<SeenImage> pages;
  for (cv::Mat& page : decoded) {
    page = in_read_type(page);
    pages.push_back({image_of(page), seen_in({page})});
    page.release();
  }
  return pages;
}

std::string describe_image(const AnyImage& image) {
  constexpr const char* types[] = {"8 bit", "16 bit", "float"};
  return std::visit(
      [&](const auto& one) {
        return fmt::format("{}×{} px, {}, {}", one.width(), one.height(),
                           one.channels() == 1 ? "grey" : "RGB", types[image.index()]);
      },
      image);
}

ImageHeader read_image_header(const fs::path& path) {
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

Image<std::int32_t> decode_numbers(const fs::path& path) {
  const AnyImage decoded = decode_image(path);
  if (std::holds_alternative<Image<float>>(decoded)) {
    throw IoError(path, "this image must hold integers, but it holds float samples");
  }
  return std::visit(
      [](const auto& image) {
        Image<std::int32_t> numbers(image.height(), image.width());
        for (int y = 0; y < image.height(); ++y) {
          for (int x = 0; x < image.width(); ++x) {
            numbers.at(y, x) = static_cast<std::int32_t>(image.at(y, x));
          }
        }
        return numbers;
      },
      decoded);
}

namespace {

constexpr std::size_t kSignatureBytes = 8;
/// More than deflate can reach, 1032.
constexpr std::uintmax_t kLargestExpansion = 1100;
constexpr std::size_t kBufferBytes = 1 << 20;

/// What becomes of stored pixels: samples of 8 or 16 bits without alpha or with it, or labels as
/// they are.
enum class PngPixels { Samples, SamplesAndAlpha, Labels };

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
  [[nodiscard]] bool read_header(PngPixels pixels = PngPixels::Samples) {
    if (file_ == nullptr || info_ == nullptr) return false;
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    std::setvbuf(file_, nullptr, _IOFBF, kBufferBytes);
    png_init_io(png_, file_);
    png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    png_read_info(png_, info_);
    has_palette = png_get_color_type(png_, info_) == PNG_COLOR_TYPE_PALETTE;
    if (pixels == PngPixels::Labels) {
      keep_labels();
    } else {
      png_set_expand(png_);
      if (pixels == PngPixels::Samples) png_set_strip_alpha(png_);
    }
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

  /// Colors and opacities of the palette, which has no opacity where all is opaque.
  void read_palette(std::vector<std::array<std::uint8_t, 3>>& colors,
                    std::vector<std::uint8_t>& alpha) const {
    png_colorp entries = nullptr;
    png_bytep opacities = nullptr;
    int count = 0;
    int opacity_count = 0;
    png_get_PLTE(png_, info_, &entries, &count);
    png_get_tRNS(png_, info_, &opacities, &opacity_count, nullptr);
    for (int i = 0; i < count; ++i) {
      colors.push_back({entries[i].red, entries[i].green, entries[i].blue});
    }
    if (opacities != nullptr) alpha.assign(opacities, opacities + opacity_count);
  }

  int width = 0;
  int height = 0;
  int channels = 0;
  int bits = 0;
  std::size_t row_bytes = 0;
  bool has_palette = false;  ///< As stored.

 private:
  void keep_labels() {
    const int depth = png_get_bit_depth(png_, info_);
    if (has_palette || depth < 8) {
      png_set_packing(png_);
      return;
    }
    if (png_get_valid(png_, info_, PNG_INFO_tRNS) != 0) png_set_tRNS_to_alpha(png_);
    if ((png_get_color_type(png_, info_) & PNG_COLOR_MASK_COLOR) != 0) png_set_strip_16(png_);
  }

  std::FILE* file_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  int passes_ = 1;
};

template <class T>
AnyImage read_samples(PngDecoder& png, const fs::path& path, int rows) {
  Image<T> image(rows, png.width, png.channels);
  if (!png.read_rows(reinterpret_cast<png_bytep>(image.data()), rows)) refuse_image(path);
  return image;
}

AnyImage read_top(PngDecoder& png, const fs::path& path, int rows) {
  if (png.bits != 8 && png.bits != 16) refuse_image(path);
  if (png.row_bytes * png.height / kLargestExpansion > fs::file_size(path)) refuse_image(path);
  return png.bits == 8 ? read_samples<std::uint8_t>(png, path, rows)
                       : read_samples<std::uint16_t>(png, path, rows);
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
  if (!png.read_header()) refuse_image(path);
  return read_top(png, path, png.is_interlaced() ? png.height : std::min(rows, png.height));
}

namespace {

template <class T>
SeenImage without_alpha(const Image<T>& all) {
  const int channels = all.channels() - 1;
  Image<T> image(all.height(), all.width(), channels);
  Image<std::uint8_t> seen(all.height(), all.width());
  bool is_whole = true;
  for (int y = 0; y < all.height(); ++y) {
    const T* in = all.row(y);
    T* out = image.row(y);
    for (int x = 0; x < all.width(); ++x, in += channels + 1, out += channels) {
      std::copy_n(in, channels, out);
      seen.at(y, x) = in[channels] != 0 ? 1 : 0;
      is_whole = is_whole && in[channels] != 0;
    }
  }
  return {std::move(image), is_whole ? Image<std::uint8_t>() : std::move(seen)};
}

SeenImage decode_png_seen(const fs::path& path) {
  PngDecoder png(path);
  if (!png.read_header(PngPixels::SamplesAndAlpha)) refuse_image(path);
  AnyImage all = read_top(png, path, png.height);
  if (png.channels % 2 != 0) return {std::move(all)};
  return png.bits == 8 ? without_alpha(std::get<Image<std::uint8_t>>(all))
                       : without_alpha(std::get<Image<std::uint16_t>>(all));
}

/// Splits decoded pixels: 1 or 2 channels are numbers, 3 or 4 colors; the last of 2 or 4 is alpha.
template <class T>
LabelPicture split(const Image<T>& pixels) {
  const int stored = pixels.channels();
  const bool is_color = stored >= 3;
  const int height = pixels.height();
  const int width = pixels.width();
  const auto byte = [](T sample) {
    return static_cast<std::uint8_t>(sizeof(T) == 1 ? sample : sample >> 8);
  };
  LabelPicture picture;
  if (is_color) picture.colors = Image<std::uint8_t>(height, width, 3);
  if (!is_color) picture.numbers = Image<std::int32_t>(height, width);
  if (stored % 2 == 0) picture.alpha = Image<std::uint8_t>(height, width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const T* pixel = &pixels.at(y, x);
      if (!is_color) picture.numbers.at(y, x) = static_cast<std::int32_t>(pixel[0]);
      for (int c = 0; is_color && c < 3; ++c) picture.colors.at(y, x, c) = byte(pixel[c]);
      if (stored % 2 == 0) picture.alpha.at(y, x) = byte(pixel[stored - 1]);
    }
  }
  return picture;
}

template <class T>
LabelPicture read_labels(PngDecoder& png, const fs::path& path) {
  Image<T> image(png.height, png.width, png.channels);
  if (!png.read_rows(reinterpret_cast<png_bytep>(image.data()), png.height)) refuse_image(path);
  return split(image);
}

LabelPicture decode_png_labels(const fs::path& path) {
  PngDecoder png(path);
  if (!png.read_header(PngPixels::Labels)) refuse_image(path);
  const bool is_byte = png.bits <= 8;
  if (png.row_bytes * png.height / kLargestExpansion > fs::file_size(path)) refuse_image(path);
  LabelPicture picture =
      is_byte ? read_labels<std::uint8_t>(png, path) : read_labels<std::uint16_t>(png, path);
  if (!png.has_palette) return picture;
  std::vector<std::uint8_t> opacities;
  png.read_palette(picture.palette, opacities);
  if (opacities.empty()) return picture;
  picture.alpha = Image<std::uint8_t>(png.height, png.width);
  std::ranges::transform(picture.numbers, picture.alpha.begin(), [&](std::int32_t index) {
    const auto place = static_cast<std::size_t>(index);
    return place < opacities.size() ? opacities[place] : std::uint8_t{255};
  });
  return picture;
}

/// Pixels of OpenCV, whose colors are BGR or BGRA.
template <class T>
LabelPicture split_mat(const cv::Mat& decoded) {
  const int channels = decoded.channels();
  Image<T> image(decoded.rows, decoded.cols, channels);
  for (int y = 0; y < decoded.rows; ++y) {
    const T* in = decoded.ptr<T>(y);
    T* out = image.row(y);
    for (int x = 0; x < decoded.cols; ++x, in += channels, out += channels) {
      std::copy_n(in, channels, out);
      if (channels >= 3) std::swap(out[0], out[2]);
    }
  }
  return split(image);
}

}  // namespace

namespace {

/// Levels of a picture so that black is 0 and white the largest of the type. What libraries decode
/// leaves white of PNM as it is stated, and 16 bits of a TIFF file whose 0 is white.
void settle_levels(const fs::path& path, AnyImage& image) {
  FileBytes file(path);
  const bool may_be_told =
      file.begins_with("P") || file.begins_with("II") || file.begins_with("MM");
  const auto header = may_be_told ? stated_image_header(path) : std::nullopt;
  if (!header || (header->white == 0 && !header->is_white_zero)) return;
  std::visit(
      [&]<class T>(Image<T>& samples) {
        if constexpr (std::is_integral_v<T>) {
          const std::uint32_t full = std::numeric_limits<T>::max(), white = header->white;
          const bool is_inverted = header->is_white_zero && sizeof(T) > 1;
          for (T& sample : samples) {
            if (white > 0)
              sample = static_cast<T>(std::min(full, (sample * full + white / 2) / white));
            if (is_inverted) sample = static_cast<T>(full - sample);
          }
        }
      },
      image);
}

}  // namespace

SeenImage decode_seen(const fs::path& path) {
  require_readable_file(path);
  if (has_png_signature(path)) return decode_png_seen(path);
  require_plausible_picture(path);
  if (has_radiance_signature(path)) return {decode_radiance(path)};
  require_whole_jpeg(path);
  const DecodedMat decoded = read_mat(path, PicturePart::Colors);
  SeenImage read{image_of(decoded.pixels), seen_in(decoded)};
  settle_levels(path, read.image);
  return read;
}

LabelPicture decode_label_picture(const fs::path& path) {
  require_readable_file(path);
  if (has_png_signature(path)) return decode_png_labels(path);
  require_plausible_picture(path);
  const cv::Mat decoded = read_mat(path, PicturePart::Colors).pixels;
  if (decoded.depth() == CV_8U) return split_mat<std::uint8_t>(decoded);
  if (decoded.depth() == CV_16U) return split_mat<std::uint16_t>(decoded);
  throw IoError(path, "a picture of labels must hold integers of 8 or 16 bits; export it again");
}

namespace {

template <class T>
cv::Mat to_mat(ImageView<const T> image) {
  const int channels = image.channels;
  cv::Mat mat(image.height, image.width, CV_MAKETYPE(cv::DataType<T>::depth, channels));
  for (int y = 0; y < image.height; ++y) {
    const T* in = image.row(y);
    T* out = mat.template ptr<T>(y);
    for (int x = 0; x < image.width; ++x, in += channels, out += channels) {
      for (int c = 0; c < channels; ++c) out[c < 3 && channels > 1 ? 2 - c : c] = in[c];
    }
  }
  return mat;
}

std::vector<std::uint8_t> encoded(const fs::path& path, const char* suffix, const cv::Mat& image,
                                  const std::vector<int>& options) {
  std::vector<std::uint8_t> bytes;
  bool is_encoded = false;
  try {
    is_encoded = cv::imencode(suffix, image, bytes, options);
  } catch (const cv::Exception&) {
    is_encoded = false;
  }
  if (!is_encoded) throw IoError(path, "the picture could not be encoded; choose another format");
  return bytes;
}

void encode(const fs::path& path, const char* suffix, const cv::Mat& image,
            const std::vector<int>& options) {
  write_atomically(path, encoded(path, suffix, image, options));
}

template <class T>
void require_channels(ImageView<const T> image, bool is_allowed, const char* expected) {
  if (image.empty() || !is_allowed) {
    throw InvalidInput(
        fmt::format("the picture has {} channels, but {} are expected", image.channels, expected));
  }
}

std::vector<std::uint8_t> png_of(const fs::path& path, ImageView<const std::uint8_t> image) {
  require_channels(image, image.channels == 1 || image.channels == 3 || image.channels == 4,
                   "1, 3 or 4");
  return encoded(path, ".png", to_mat(image), {cv::IMWRITE_PNG_COMPRESSION, 3});
}

constexpr std::size_t kAfterHeader = 33;  ///< Bytes of the signature and of the chunk IHDR.

/// A chunk tEXt: its length, type, keyword and text, checksum.
std::string own_chunk() {
  const std::string content = std::string("tEXtSoftware") + '\0' + "Episcope";
  const auto word = [](std::uint32_t number) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift);
    return bytes;
  };
  const auto sum =
      crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size()));
  return word(static_cast<std::uint32_t>(content.size() - 4)) + content +
         word(static_cast<std::uint32_t>(sum));
}

}  // namespace

void write_png(const fs::path& path, ImageView<const std::uint8_t> image) {
  write_atomically(path, png_of(path, image));
}

void write_picture(const fs::path& path, ImageView<const std::uint8_t> image) {
  std::vector<std::uint8_t> bytes = png_of(path, image);
  const std::string chunk = own_chunk();
  bytes.insert(bytes.begin() + kAfterHeader, chunk.begin(), chunk.end());
  write_atomically(path, bytes);
}

bool is_own_picture(const fs::path& path) {
  if (!has_png_signature(path)) return false;
  const std::string chunk = own_chunk();
  std::string found(chunk.size(), '\0');
  std::ifstream file(path, std::ios::binary);
  file.seekg(kAfterHeader);
  file.read(found.data(), static_cast<std::streamsize>(found.size()));
  return file && found == chunk;
}

void write_png(const fs::path& path, ImageView<const std::uint16_t> image) {
  require_channels(image, image.channels == 1 || image.channels == 3, "1 or 3");
  encode(path, ".png", to_mat(image), {cv::IMWRITE_PNG_COMPRESSION, 3});
}

void write_tiff(const fs::path& path, ImageView<const float> image) {
  require_channels(image, image.channels == 1 || image.channels == 3, "1 or 3");
  constexpr int kNoCompression = 1;  // COMPRESSION_NONE of libtiff
  encode(path, ".tiff", to_mat(image), {cv::IMWRITE_TIFF_COMPRESSION, kNoCompression});
}

}  // namespace episcope::io
