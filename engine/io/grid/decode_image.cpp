// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/decode_image.h"

#include "engine/core/error.h"
#include "engine/core/text/suffix.h"
#include "engine/io/durable/system_error.h"
#include "engine/io/grid/claimed_pixels.h"
#include "engine/io/grid/decode_png.h"
#include "engine/io/grid/decode_radiance.h"
#include "engine/io/grid/exr_channels.h"
#include "engine/io/grid/file_bytes.h"
#include "engine/io/grid/jpeg_end.h"

#include <fmt/format.h>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>

namespace episcope::io {
namespace {

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

bool is_animated_webp(const std::filesystem::path& path) {
  constexpr std::uint32_t kAnimation = 2;
  FileBytes file(path);
  return file.begins_with("RIFF") && file.number(8, 4, false) == 0x57454250 &&  // "WEBP"
         file.number(12, 4, false) == 0x56503858 &&                             // "VP8X"
         (file.number(20, 1, false) & kAnimation) != 0;
}

[[noreturn]] void refuse(const std::filesystem::path& path) {
  if (is_animated_webp(path)) {
    throw IoError(path,
                  "animated WebP files are not read; save the pictures as PNG files in a folder, "
                  "or as an animated PNG");
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

cv::Mat read_mat(const std::filesystem::path& path, PicturePart part) {
  allow_openexr();
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  cv::Mat decoded;
  try {
    const auto renamed = exr_with_known_channels(path, part);
    decoded = renamed ? cv::imdecode(*renamed, cv::IMREAD_UNCHANGED)
                      : cv::imread(path.string(), cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    decoded.release();
  }
  if (decoded.empty()) refuse(path);
  return decoded;
}

AnyImage image_of(const std::filesystem::path& path, const cv::Mat& decoded) {
  if (decoded.depth() == CV_8U) return copy_rgb<std::uint8_t>(decoded);
  if (decoded.depth() == CV_16U) return copy_rgb<std::uint16_t>(decoded);
  if (decoded.depth() == CV_32F) return copy_rgb<float>(decoded);
  throw IoError(path,
                "the image has neither 8-bit, 16-bit nor 32-bit float samples; export it again in "
                "one of these formats");
}

}  // namespace

AnyImage decode_image(const std::filesystem::path& path, PicturePart part) {
  require_readable_file(path);
  if (has_png_signature(path)) return decode_png(path);
  require_plausible_picture(path);
  if (has_radiance_signature(path)) return decode_radiance(path);
  require_whole_jpeg(path);
  return image_of(path, read_mat(path, part));
}

std::vector<AnyImage> decode_pages(const std::filesystem::path& path, int count) {
  require_readable_file(path);
  require_plausible_picture(path);
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  std::vector<cv::Mat> decoded;
  try {
    if (!cv::imreadmulti(path.string(), decoded, 0, count, cv::IMREAD_UNCHANGED)) decoded.clear();
  } catch (const cv::Exception&) {
    decoded.clear();
  }
  if (static_cast<int>(decoded.size()) != count) refuse(path);
  std::vector<AnyImage> pages;
  for (cv::Mat& page : decoded) {
    pages.push_back(image_of(path, page));
    page.release();
  }
  return pages;
}

bool is_image_name(const std::filesystem::path& path) {
  constexpr std::array suffixes{".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp", ".ppm",
                                ".pgm", ".pnm", ".webp", ".jp2", ".exr",  ".hdr"};
  return std::ranges::find(suffixes, suffix_of(path)) != suffixes.end();
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

Image<std::int32_t> decode_numbers(const std::filesystem::path& path) {
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

}  // namespace episcope::io
