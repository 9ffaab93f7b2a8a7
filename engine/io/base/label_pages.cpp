// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/label_pages.h"

#include "engine/core/error.h"
#include "engine/core/numbers.h"
#include "engine/io/base/array_input.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"
#include "engine/io/base/quiet_decoding.h"
#include "engine/io/base/rare_tiff.h"

#include <fmt/format.h>
#include <png.h>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <csetjmp>
#include <cstdint>
#include <iterator>
#include <map>
#include <string>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kDescription = 270;  ///< A tag of TIFF.
constexpr std::uint64_t kLongestText = 64 << 10;

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw IoError(path, why + "; save the labels as PNG, .npy or TIFF of 8, 16 or 32 bits");
}

template <class T>
void require_whole(const fs::path& path, const std::uint8_t* row, int width) {
  const T* values = reinterpret_cast<const T*>(row);
  for (int x = 0; x < width; ++x) {
    if (!whole_int(values[x]))
      refuse(path, "labels are whole numbers, but this TIFF file has others");
  }
}

LabelPicture numbers_of(const fs::path& path, const cv::Mat& decoded, const PageForm& form) {
  const auto known = type_of(form);
  if (!known) {
    refuse(path, fmt::format("this TIFF file has {} of {} bits, which are not read",
                             form.format == kTiffFloat ? "floats" : "samples", form.bits));
  }
  const NumberType type = *known;
  if (decoded.channels() != 1 || decoded.elemSize1() != byte_size(type)) {
    refuse(path, "a page of this TIFF file cannot be decoded");
  }
  LabelPicture picture{Image<std::int32_t>(decoded.rows, decoded.cols), form.palette, {}, {}};
  for (int y = 0; y < decoded.rows; ++y) {
    const std::uint8_t* row = decoded.ptr(y);
    if (type == NumberType::Float32) require_whole<float>(path, row, decoded.cols);
    if (type == NumberType::Float64) require_whole<double>(path, row, decoded.cols);
    if (type == NumberType::Float16) {
      std::vector<float> values(static_cast<std::size_t>(decoded.cols));
      convert_numbers(type, row, values.size(), values.data());
      require_whole<float>(path, reinterpret_cast<const std::uint8_t*>(values.data()),
                           decoded.cols);
    }
    convert_numbers(type, row, static_cast<std::size_t>(decoded.cols), picture.numbers.row(y));
  }
  if (form.bits >= 8) return picture;
  const int most = (1 << form.bits) - 1;  // decoded as levels up to 255
  for (std::int32_t& number : picture.numbers) number = number * most / 255;
  return picture;
}

LabelPicture colors_of(const fs::path& path, const cv::Mat& decoded) {
  const int channels = decoded.channels();
  const bool is_word = decoded.depth() == CV_16U;
  if (channels < 3 || (!is_word && decoded.depth() != CV_8U)) {
    refuse(path, "a page of this TIFF file holds neither numbers nor colors");
  }
  LabelPicture picture;
  picture.colors = Image<std::uint8_t>(decoded.rows, decoded.cols, 3);
  if (channels == 4) picture.alpha = Image<std::uint8_t>(decoded.rows, decoded.cols);
  const auto sample = [&](int y, int x, int c) {
    const auto place = x * channels + c;
    return is_word ? static_cast<std::uint8_t>(decoded.ptr<std::uint16_t>(y)[place] >> 8)
                   : decoded.ptr<std::uint8_t>(y)[place];
  };
  for (int y = 0; y < decoded.rows; ++y) {
    for (int x = 0; x < decoded.cols; ++x) {
      for (int c = 0; c < 3; ++c) picture.colors.at(y, x, c) = sample(y, x, 2 - c);
      if (channels == 4) picture.alpha.at(y, x) = sample(y, x, 3);
    }
  }
  return picture;
}

/// ImageJ stores the pages of large files one behind the other, with one directory for all.
void require_directories(const fs::path& path, TiffFile& file) {
  const auto value = file.tag(kDescription);
  const std::string text =
      value ? file.text(value->place, std::min(value->bytes, kLongestText)) : "";
  const std::string stack = "\nimages=";
  const auto place = text.find(stack);
  if (!text.starts_with("ImageJ=") || place == std::string::npos) return;
  if (text.substr(place + stack.size()).starts_with("1\n")) return;
  refuse(path,
         "this file of ImageJ has its pages without directories, which are not read as labels");
}

}  // namespace

std::vector<LabelPicture> decode_label_pages(const fs::path& path) {
  require_readable_file(path);
  require_plausible_picture(path);
  constexpr int kMostPages = 1 << 14;
  std::vector<LabelPicture> pictures;
  if (!TiffFile(path).is_tiff()) {
    pictures.push_back(decode_label_picture(path));
    return pictures;
  }
  if (fs::file_size(path) > kLargestTiff) refuse(path, "this TIFF file has more than 1 GiB");
  TiffPages pages(path);
  const std::vector<std::uint64_t> directories = pages.file().directories(kMostPages);
  if (directories.empty()) refuse(path, "this TIFF file is damaged");
  if (directories.size() == 1) require_directories(path, pages.file());
  for (const std::uint64_t directory : directories) {
    const PageForm form = pages.form(directory);
    const cv::Mat decoded = pages.decode(directory, form);
    if (decoded.empty()) refuse(path, "a page of this TIFF file cannot be decoded");
    pictures.push_back(form.is_gray ? numbers_of(path, decoded, form) : colors_of(path, decoded));
  }
  return pictures;
}

Image<std::uint8_t> decode_mask(const fs::path& path, const std::string& png) {
  const QuietDecoding quiet;
  cv::Mat decoded;
  try {
    const std::vector<char> bytes(png.begin(), png.end());
    if (!bytes.empty()) decoded = cv::imdecode(bytes, cv::IMREAD_GRAYSCALE);
  } catch (const cv::Exception&) {
    decoded.release();
  }
  if (decoded.empty()) throw IoError(path, "a mask in this file is no PNG; export it again");
  Image<std::uint8_t> mask(decoded.rows, decoded.cols);
  for (int y = 0; y < decoded.rows; ++y) std::copy_n(decoded.ptr(y), decoded.cols, mask.row(y));
  return mask;
}

std::vector<std::uint8_t> encode_mask(ImageView<const std::uint8_t> mask) {
  cv::Mat image(mask.height, mask.width, CV_8U);
  for (int y = 0; y < mask.height; ++y) std::copy_n(mask.row(y), mask.width, image.ptr(y));
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", image, bytes, {cv::IMWRITE_PNG_BILEVEL, 1});
  return bytes;
}

namespace {

/// A PNG that is encoded in memory. Errors of libpng jump to `write`, which holds nothing to be
/// destroyed.
class IndexedPng {
 public:
  IndexedPng() {
    png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
  }
  ~IndexedPng() { png_destroy_write_struct(&png_, &info_); }
  IndexedPng(const IndexedPng&) = delete;
  IndexedPng& operator=(const IndexedPng&) = delete;

  [[nodiscard]] bool write(ImageView<const std::uint8_t> ids,
                           const std::vector<png_color>& palette) {
    if (info_ == nullptr || setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_write_fn(png_, &bytes_, append, nullptr);
    png_set_IHDR(png_, info_, static_cast<png_uint_32>(ids.width),
                 static_cast<png_uint_32>(ids.height), 8, PNG_COLOR_TYPE_PALETTE,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_PLTE(png_, info_, palette.data(), static_cast<int>(palette.size()));
    png_write_info(png_, info_);
    for (int y = 0; y < ids.height; ++y) png_write_row(png_, ids.row(y));
    png_write_end(png_, info_);
    return true;
  }
  [[nodiscard]] const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  static void append(png_structp png, png_bytep data, std::size_t count) {
    auto& bytes = *static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(png));
    bytes.insert(bytes.end(), data, data + count);
  }

  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace

void write_indexed_png(const fs::path& path, ImageView<const std::uint8_t> ids,
                       const std::vector<std::array<std::uint8_t, 3>>& palette) {
  std::vector<png_color> colors;
  for (const auto& color : palette) colors.push_back({color[0], color[1], color[2]});
  IndexedPng png;
  if (!png.write(ids, colors)) {
    throw IoError(path, "the picture could not be encoded; choose another form");
  }
  write_atomically(path, png.bytes());
}

}  // namespace episcope::io
