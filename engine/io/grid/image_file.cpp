// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/image_file.h"

#include "engine/core/error.h"
#include "engine/io/durable/atomic_file.h"

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

#include <string>
#include <vector>

namespace episcope::io {
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

void encode(const std::filesystem::path& path, const char* suffix, const cv::Mat& image,
            const std::vector<int>& options) {
  std::vector<std::uint8_t> bytes;
  bool is_encoded = false;
  try {
    is_encoded = cv::imencode(suffix, image, bytes, options);
  } catch (const cv::Exception&) {
    is_encoded = false;
  }
  if (!is_encoded) throw IoError(path, "the picture could not be encoded; choose another format");
  write_atomically(path, bytes);
}

template <class T>
void require_channels(ImageView<const T> image, bool is_allowed, const char* expected) {
  if (image.empty() || !is_allowed) {
    throw InvalidInput(
        fmt::format("the picture has {} channels, but {} are expected", image.channels, expected));
  }
}

}  // namespace

void write_png(const std::filesystem::path& path, ImageView<const std::uint8_t> image) {
  require_channels(image, image.channels == 1 || image.channels == 3 || image.channels == 4,
                   "1, 3 or 4");
  encode(path, ".png", to_mat(image), {cv::IMWRITE_PNG_COMPRESSION, 3});
}

void write_png(const std::filesystem::path& path, ImageView<const std::uint16_t> image) {
  require_channels(image, image.channels == 1 || image.channels == 3, "1 or 3");
  encode(path, ".png", to_mat(image), {cv::IMWRITE_PNG_COMPRESSION, 3});
}

void write_tiff(const std::filesystem::path& path, ImageView<const float> image) {
  require_channels(image, image.channels == 1 || image.channels == 3, "1 or 3");
  constexpr int kNoCompression = 1;  // COMPRESSION_NONE of libtiff
  encode(path, ".tiff", to_mat(image), {cv::IMWRITE_TIFF_COMPRESSION, kNoCompression});
}

}  // namespace episcope::io
