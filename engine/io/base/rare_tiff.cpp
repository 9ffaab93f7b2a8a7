// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/rare_tiff.h"

#include "engine/io/base/quiet_decoding.h"

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <utility>

namespace episcope::io {
namespace {

// Tags of TIFF.
constexpr std::uint64_t kBits = 258, kPhotometric = 262, kSamples = 277, kColorMap = 320,
                        kSampleFormat = 339;
constexpr std::uint64_t kUnsigned = 1, kSigned = 2, kFloat = 3;  // values of kSampleFormat
constexpr std::uint64_t kBlackIsZero = 1, kPalette = 3;          // values of kPhotometric

/// By format and bits; samples of fewer than 8 bits become bytes.
const std::map<std::pair<std::uint64_t, std::uint64_t>, NumberType> kTypes{
    {{kUnsigned, 8}, NumberType::UInt8},   {{kUnsigned, 16}, NumberType::UInt16},
    {{kUnsigned, 32}, NumberType::UInt32}, {{kUnsigned, 64}, NumberType::UInt64},
    {{kSigned, 8}, NumberType::Int8},      {{kSigned, 16}, NumberType::Int16},
    {{kSigned, 32}, NumberType::Int32},    {{kSigned, 64}, NumberType::Int64},
    {{kFloat, 16}, NumberType::Float16},   {{kFloat, 32}, NumberType::Float32},
    {{kFloat, 64}, NumberType::Float64}};

}  // namespace

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

std::optional<NumberType> type_of(const PageForm& form) {
  const std::uint64_t format =
      form.format == kSigned || form.format == kFloat ? form.format : kUnsigned;
  const auto found = kTypes.find({format, std::max<std::uint64_t>(form.bits, 8)});
  return found == kTypes.end() ? std::nullopt : std::optional(found->second);
}

std::vector<cv::Mat> decode_rare_tiff(const std::filesystem::path& path, int count) {
  std::vector<cv::Mat> decoded;
  if (!TiffFile(path).is_tiff() || std::filesystem::file_size(path) > kLargestTiff) return decoded;
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

}  // namespace episcope::io
