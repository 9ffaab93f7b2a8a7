// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/label_pages.h"

#include "engine/core/error.h"
#include "engine/core/numbers.h"
#include "engine/io/base/array_input.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"
#include "engine/io/base/quiet_decoding.h"
#include "engine/io/base/tiff_file.h"

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

// Tags of TIFF.
constexpr std::uint64_t kBits = 258, kPhotometric = 262, kDescription = 270, kSamples = 277,
                        kColorMap = 320, kSampleFormat = 339;
constexpr std::uint64_t kUnsigned = 1, kSigned = 2, kFloat = 3;  // values of kSampleFormat
constexpr std::uint64_t kBlackIsZero = 1, kPalette = 3;          // values of kPhotometric
constexpr std::uint64_t kLongestText = 64 << 10;
constexpr std::uintmax_t kLargest = std::uintmax_t{1} << 30;  ///< What a cv::Mat of bytes holds.

struct PageForm {
  std::uint64_t bits = 1;
  std::uint64_t format = kUnsigned;
  bool is_gray = true;
  std::vector<std::array<std::uint8_t, 3>> palette{};
};

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw IoError(path, why + "; save the labels as PNG, .npy or TIFF of 8, 16 or 32 bits");
}

/// What OpenCV decodes of a TIFF page. It refuses integers of more than 16 bits that have no sign
/// or 64 bits, and floats of 16 bits, and turns palettes into colors. So it gets a copy of the
/// directory of the page that calls the first floats, the second integers and the third gray, behind
/// the end of the file in memory; bits stay as they are.
class TiffPages {
 public:
  explicit TiffPages(const fs::path& path) : path_(path), file_(path) {
    bytes_ = file_.text(0, fs::file_size(path));
  }

  [[nodiscard]] TiffFile& file() { return file_; }
  [[nodiscard]] PageForm form(std::uint64_t directory);
  [[nodiscard]] cv::Mat decode(std::uint64_t directory, const PageForm& form);

 private:
  [[nodiscard]] std::string packed(std::uint64_t number, std::uint64_t bytes) const {
    std::string text;
    for (std::uint64_t i = 0; i < bytes; ++i) {
      const std::uint64_t place = file_.is_little_endian() ? i : bytes - 1 - i;
      text += static_cast<char>(number >> (8 * place) & 0xFF);
    }
    return text;
  }
  /// An entry of numbers of 16 bits that are all the same, as many as fit into it.
  [[nodiscard]] std::string entry(std::uint64_t tag, std::uint64_t number,
                                  std::uint64_t count = 1) const {
    constexpr std::uint64_t kShort = 3;
    std::string values;
    for (std::uint64_t i = 0; i < count; ++i) values += packed(number, 2);
    values.resize(file_.place_bytes(), '\0');
    return packed(tag, 2) + packed(kShort, 2) + packed(count, file_.place_bytes()) + values;
  }
  /// The entry that calls all samples of a page so; that of the file if its values lie elsewhere,
  /// where they are changed.
  [[nodiscard]] std::map<std::uint64_t, std::string> claim(std::uint64_t directory,
                                                           std::uint64_t format);
  /// Begins the file with a copy of a directory in which these entries are changed or added.
  void begin_with(std::uint64_t directory, std::map<std::uint64_t, std::string> entries);

  const fs::path& path_;
  TiffFile file_;
  std::string bytes_;
};

PageForm TiffPages::form(std::uint64_t directory) {
  const auto number = [&](std::uint64_t tag, std::uint64_t otherwise) {
    const auto value = file_.tag(directory, tag);
    return value ? value->number : otherwise;
  };
  PageForm form{number(kBits, 1), number(kSampleFormat, kUnsigned)};
  const std::uint64_t photometric = number(kPhotometric, kBlackIsZero);
  const auto map = file_.tag(directory, kColorMap);
  const bool has_palette = photometric == kPalette && form.bits == 8 && map;
  form.is_gray = number(kSamples, 1) < 3 && (photometric <= kBlackIsZero || has_palette);
  constexpr std::size_t kColors = 256;
  constexpr std::uint64_t kBytes = 2;  // of a level, all reds first
  if (!has_palette || map->bytes != 3 * kColors * kBytes) return form;
  for (std::size_t i = 0; i < kColors; ++i) {
    std::array<std::uint8_t, 3> color{};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint64_t level = file_.at(map->place + kBytes * (c * kColors + i), kBytes);
      color[c] = static_cast<std::uint8_t>(level >> 8);
    }
    form.palette.push_back(color);
  }
  return form;
}

void TiffPages::begin_with(std::uint64_t directory, std::map<std::uint64_t, std::string> entries) {
  const std::uint64_t count_bytes = file_.place_bytes() == 8 ? 8 : 2;
  const std::uint64_t count = file_.at(directory, count_bytes);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t place = directory + count_bytes + i * file_.entry_bytes();
    std::string stored = file_.text(place, file_.entry_bytes());
    if (stored.size() < file_.entry_bytes()) break;
    entries.emplace(file_.at(place, 2), std::move(stored));
  }
  if (bytes_.size() % 2 != 0) bytes_ += '\0';
  const std::uint64_t begin = bytes_.size();
  bytes_ += packed(entries.size(), count_bytes);
  for (const auto& [tag, stored] : entries) bytes_ += stored;
  bytes_ += packed(0, file_.place_bytes());
  bytes_.replace(file_.place_of_start(), file_.place_bytes(), packed(begin, file_.place_bytes()));
}

std::map<std::uint64_t, std::string> TiffPages::claim(std::uint64_t directory,
                                                      std::uint64_t format) {
  constexpr std::uint64_t kBytes = 2, kLong = 4;  // of a value; and a type of 4 bytes
  const auto stored = file_.tag(directory, kSampleFormat);
  const std::uint64_t bytes = stored ? stored->bytes : kBytes;
  if (bytes <= file_.place_bytes()) {
    const bool is_long = stored && stored->type == kLong;
    return {{kSampleFormat, entry(kSampleFormat, format, bytes / (is_long ? kLong : kBytes))}};
  }
  for (std::uint64_t at = stored->place; at + kBytes <= bytes_.size() && at < stored->place + bytes;
       at += kBytes) {
    bytes_.replace(at, kBytes, packed(format, kBytes));
  }
  return {};
}

/// Empty if that fails.
cv::Mat TiffPages::decode(std::uint64_t directory, const PageForm& form) {
  std::map<std::uint64_t, std::string> changed;
  if (form.bits > 16) changed = claim(directory, kFloat);
  if (form.bits == 16 && form.format == kFloat) changed = claim(directory, kUnsigned);
  if (!form.palette.empty()) changed[kPhotometric] = entry(kPhotometric, kBlackIsZero);
  begin_with(directory, std::move(changed));
  const QuietDecoding quiet;
  cv::Mat decoded;
  try {
    const cv::Mat whole(1, static_cast<int>(bytes_.size()), CV_8U, bytes_.data());
    decoded = cv::imdecode(whole, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    decoded.release();
  }
  return decoded;
}

/// By format and bits; samples of fewer than 8 bits become bytes.
const std::map<std::pair<std::uint64_t, std::uint64_t>, NumberType> kTypes{
    {{kUnsigned, 8}, NumberType::UInt8},   {{kUnsigned, 16}, NumberType::UInt16},
    {{kUnsigned, 32}, NumberType::UInt32}, {{kUnsigned, 64}, NumberType::UInt64},
    {{kSigned, 8}, NumberType::Int8},      {{kSigned, 16}, NumberType::Int16},
    {{kSigned, 32}, NumberType::Int32},    {{kSigned, 64}, NumberType::Int64},
    {{kFloat, 16}, NumberType::Float16},   {{kFloat, 32}, NumberType::Float32},
    {{kFloat, 64}, NumberType::Float64}};

std::optional<NumberType> type_of(const PageForm& form) {
  const std::uint64_t format =
      form.format == kSigned || form.format == kFloat ? form.format : kUnsigned;
  const auto found = kTypes.find({format, std::max<std::uint64_t>(form.bits, 8)});
  return found == kTypes.end() ? std::nullopt : std::optional(found->second);
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
                             form.format == kFloat ? "floats" : "samples", form.bits));
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

std::vector<cv::Mat> decode_rare_tiff(const fs::path& path, int count) {
  std::vector<cv::Mat> decoded;
  if (!TiffFile(path).is_tiff() || fs::file_size(path) > kLargest) return decoded;
  TiffPages pages(path);
  for (const std::uint64_t directory : pages.file().directories(count)) {
    const PageForm form = pages.form(directory);
    const cv::Mat page = pages.decode(directory, form);
    const auto type = type_of(form);
    if (page.empty() || !type || page.elemSize1() != byte_size(*type)) break;
    cv::Mat floats(page.rows, page.cols, CV_32FC(page.channels()));
    const auto samples = static_cast<std::size_t>(page.cols * page.channels());
    for (int y = 0; y < page.rows; ++y) {
      convert_numbers(*type, page.ptr(y), samples, floats.ptr<float>(y));
    }
    decoded.push_back(floats);
    if (static_cast<int>(decoded.size()) == count) break;
  }
  return decoded;
}

std::vector<LabelPicture> decode_label_pages(const fs::path& path) {
  require_readable_file(path);
  require_plausible_picture(path);
  constexpr int kMostPages = 1 << 14;
  std::vector<LabelPicture> pictures;
  if (!TiffFile(path).is_tiff()) {
    pictures.push_back(decode_label_picture(path));
    return pictures;
  }
  if (fs::file_size(path) > kLargest) refuse(path, "this TIFF file has more than 1 GiB");
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
