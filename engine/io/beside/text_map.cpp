// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/beside/text_map.h"

#include "engine/core/error.h"
#include "engine/core/text/suffix.h"
#include "engine/io/durable/system_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFewestNumbers = 8;       ///< In a row of a map.
constexpr std::size_t kLongestLine = 1 << 20;   ///< In bytes.
constexpr std::uintmax_t kLargest = 400000000;  ///< In bytes.

bool is_between(char c) {
  return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\r';
}

/// The numbers of a line; nothing if there is anything else in it.
std::optional<std::vector<float>> numbers_in(const std::string& line) {
  std::vector<float> numbers;
  const char* at = line.data();
  const char* const line_end = at + line.size();
  while (true) {
    while (at != line_end && is_between(*at)) ++at;
    if (at == line_end) return numbers;
    float number = 0;
    const char* begin = *at == '+' ? at + 1 : at;
    const auto [end, error] = std::from_chars(begin, line_end, number);
    if (error != std::errc() || (end != line_end && !is_between(*end))) return std::nullopt;
    numbers.push_back(number);
    at = end;
  }
}

bool is_comment(const std::string& line) {
  const auto first = line.find_first_not_of(" \t\r");
  return first == std::string::npos || line[first] == '#' || line[first] == '%';
}

/// False at the end. Throws IoError for a line that is too long.
bool next_line(const fs::path& path, std::ifstream& in, std::string& line) {
  while (std::getline(in, line)) {
    if (line.size() > kLongestLine) {
      throw IoError(path,
                    "a line of this text is longer than a row of numbers can be; choose "
                    "another file");
    }
    if (!is_comment(line)) return true;
  }
  return false;
}

}  // namespace

bool has_text_suffix(const fs::path& path) {
  const std::string suffix = suffix_of(path);
  return suffix == ".txt" || suffix == ".csv" || suffix == ".dat";
}

bool is_text_map(const fs::path& path) {
  if (!has_text_suffix(path)) return false;
  std::ifstream in(path);
  std::string begin(kLongestLine, '\0');
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(in.gcount()));
  for (std::size_t at = 0; at < begin.size();) {
    const std::size_t end = std::min(begin.find('\n', at), begin.size());
    const std::string line = begin.substr(at, end - at);
    at = end + 1;
    if (is_comment(line)) continue;
    const auto numbers = numbers_in(line);
    return numbers && numbers->size() >= kFewestNumbers;
  }
  return false;
}

Image<float> read_text_map(const fs::path& path) {
  require_readable_file(path);
  if (fs::file_size(path) > kLargest) {
    throw IoError(path, "this text is larger than 400 MB; save the map as .npy");
  }
  std::ifstream in(path);
  std::vector<float> values;
  std::string line;
  int height = 0;
  std::size_t width = 0;
  while (next_line(path, in, line)) {
    const auto numbers = numbers_in(line);
    if (!numbers) {
      throw IoError(path, fmt::format("row {} of this matrix holds something else than numbers; "
                                      "export it again",
                                      height + 1));
    }
    if (height > 0 && numbers->size() != width) {
      throw IoError(path, fmt::format("row {} of this matrix has {} numbers, but the first has {}; "
                                      "export it again",
                                      height + 1, numbers->size(), width));
    }
    width = numbers->size();
    values.insert(values.end(), numbers->begin(), numbers->end());
    ++height;
  }
  if (height == 0) throw IoError(path, "this text holds no numbers; choose another file");
  Image<float> map(height, static_cast<int>(width));
  std::copy(values.begin(), values.end(), map.begin());
  return map;
}

}  // namespace episcope::io
