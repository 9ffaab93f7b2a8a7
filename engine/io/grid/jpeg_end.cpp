// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/jpeg_end.h"

#include "engine/core/error.h"
#include "engine/io/grid/file_bytes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <istream>
#include <string>
#include <string_view>

namespace episcope::io {
namespace {

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

}  // namespace

void require_whole_jpeg(const std::filesystem::path& path) {
  FileBytes file(path);
  if (!file.begins_with("\xff\xd8")) return;
  const std::streamoff samples = samples_of(file);
  if (samples == 0) return;
  const auto size = static_cast<std::streamoff>(std::filesystem::file_size(path));
  if (has_end_from(file.at(std::max(samples, size - kTail)))) return;
  if (has_end_from(file.at(samples))) return;  // other pictures or notes follow the first
  throw IoError(path,
                "the image cannot be decoded: the file ends before the picture does; copy or "
                "export it again");
}

}  // namespace episcope::io
