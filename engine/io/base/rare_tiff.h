// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/base/array_input.h"
#include "engine/io/base/tiff_file.h"

#include <opencv2/core/mat.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Of files that are decoded here: what a cv::Mat of bytes holds.
inline constexpr std::uintmax_t kLargestTiff = std::uintmax_t{1} << 30;

/// A value of SampleFormat.
inline constexpr std::uint64_t kTiffFloat = 3;

/// How a page of a TIFF file stores samples.
struct PageForm {
  std::uint64_t bits = 1;
  std::uint64_t format = 1;  ///< As SampleFormat states them: without sign.
  bool is_gray = true;
  std::vector<std::array<std::uint8_t, 3>> palette{};
};

/// What OpenCV decodes of a TIFF page. It refuses integers of more than 16 bits that have no sign
/// or 64 bits, and floats of 16 bits, and turns palettes into colors. So it gets a copy of the
/// directory of the page that calls the first floats, the second integers and the third gray,
/// behind the end of the file in memory; bits stay as they are.
class TiffPages {
 public:
  explicit TiffPages(const std::filesystem::path& path)
      : file_(path), bytes_(file_.text(0, std::filesystem::file_size(path))) {}

  [[nodiscard]] TiffFile& file() { return file_; }
  [[nodiscard]] PageForm form(std::uint64_t directory);
  /// Empty if that fails.
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

  TiffFile file_;
  std::string bytes_;
};

/// Of the samples of a page as they are decoded; nothing for other forms.
[[nodiscard]] std::optional<NumberType> type_of(const PageForm& form);

/// Decodes the first `count` pages of a TIFF file with samples that OpenCV refuses, integers of
/// more than 16 bits and floats of 16, as floats, colors in its order. Fewer if one cannot be
/// decoded.
[[nodiscard]] std::vector<cv::Mat> decode_rare_tiff(const std::filesystem::path& path, int count);

}  // namespace episcope::io
