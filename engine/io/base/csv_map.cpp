// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/csv_map.h"

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace episcope::io {
namespace {

constexpr std::string_view kBlanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

/// What parts the cells of a line: the rarer character, since spaces may stand beside it.
std::string_view separators_of(std::string_view line) {
  for (const std::string_view one : {";", ",", "\t"}) {
    if (line.find(one) != std::string_view::npos) return one;
  }
  return kBlanks;
}

std::vector<std::string_view> cells_of(std::string_view line) {
  const std::string_view separators = separators_of(line);
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t end = line.find_first_of(separators);
    cells.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return cells;
    // Several spaces are one.
    const std::size_t next = separators == kBlanks ? line.find_first_not_of(kBlanks, end) : end + 1;
    line.remove_prefix(next);
  }
}

/// Empty for a word that is no number.
std::optional<float> value_of(std::string_view cell) {
  const std::string word = lower_case(std::string(cell));
  const std::string size = word.substr(word.find_first_not_of("+-") == 1 ? 1 : 0);
  for (const char* missing : {"", "nan", "na", "null", "inf", "infinity"}) {
    if (size == missing) return std::numeric_limits<float>::quiet_NaN();
  }
  const auto number = parse_number(word);
  return number ? std::optional(static_cast<float>(*number)) : std::nullopt;
}

}  // namespace

Image<float> read_csv_map(const std::filesystem::path& path) {
  require_readable_file(path);
  std::ifstream in(path);
  std::vector<float> values;
  std::size_t width = 0, height = 0, number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    const std::string_view text = trimmed(line);
    if (text.empty() || text.starts_with('#')) continue;
    const std::vector<std::string_view> cells = cells_of(text);
    if (height++ == 0) width = cells.size();
    if (cells.size() != width) {
      throw IoError(path, fmt::format("line {} has {} values, but the first row has {}; a map has "
                                      "as many in every row",
                                      number, cells.size(), width));
    }
    for (const std::string_view cell : cells) {
      const auto value = value_of(cell);
      if (!value) {
        throw IoError(path, fmt::format("line {} holds '{}', which is no number; a map is numbers "
                                        "alone, without names of rows or columns",
                                        number, cell.substr(0, 40)));
      }
      values.push_back(*value);
    }
  }
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<int>::max());
  if (values.empty() || width > most || height > most) {
    throw IoError(path, "holds no rows of numbers; export the map again");
  }
  Image<float> map(static_cast<int>(height), static_cast<int>(width));
  std::ranges::copy(values, map.data());
  return map;
}

void write_csv_map(const std::filesystem::path& path, ImageView<const float> map) {
  std::string text;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (x > 0) text += ',';
      const float value = map.at(y, x);
      if (std::isfinite(value)) {
        fmt::format_to(std::back_inserter(text), "{}", value);
      } else {
        text += "nan";
      }
    }
    text += '\n';
  }
  write_atomically(path, text);
}

}  // namespace episcope::io
