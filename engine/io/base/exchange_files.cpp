// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/exchange_files.h"

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace episcope::io {
namespace {

constexpr int kLargestPfmSide = 1 << 16;

struct Header {
  int channels = 1;
  int width = 0;
  int height = 0;
  double scale = 0;
};

/// The next word of the header; `#` starts a comment that ends with the line. One white-space
/// character after the word is consumed, so that samples begin right after the last word.
std::string next_word(std::istream& in) {
  std::string word;
  for (int c = in.get(); c != EOF; c = in.get()) {
    if (c == '#') {
      while (c != '\n' && c != EOF) c = in.get();
      if (!word.empty()) return word;
    } else if (!std::isspace(c)) {
      word += static_cast<char>(c);
      if (word.size() > 64) return {};
    } else if (!word.empty()) {
      return word;
    }
  }
  return word;
}

Header read_header(const std::filesystem::path& path, std::istream& in) {
  const std::string magic = next_word(in);
  if (magic != "Pf" && magic != "PF") {
    throw IoError(path, "this is not a PFM file, which begins with Pf or PF; choose another file");
  }
  Header header;
  header.channels = magic == "PF" ? 3 : 1;
  try {
    header.width = std::stoi(next_word(in));
    header.height = std::stoi(next_word(in));
    header.scale = std::stod(next_word(in));
  } catch (const std::logic_error&) {
    throw IoError(path, "the header of the PFM file lacks width, height or scale; write it again");
  }
  const bool has_size = header.width > 0 && header.height > 0 && header.width <= kLargestPfmSide &&
                        header.height <= kLargestPfmSide;
  if (!has_size || header.scale == 0 || !std::isfinite(header.scale)) {
    throw IoError(path, fmt::format("the header of the PFM file says {}×{} px and scale {:f}, "
                                    "which is not valid; write it again",
                                    header.width, header.height, header.scale));
  }
  return header;
}

/// Where samples begin after the header: after the line feed of a file whose lines end as in
/// Windows, which leaves one byte too many. −1 where the header is all there is.
std::streamoff begin_of_samples(std::istream& in, std::uintmax_t bytes, std::uintmax_t needed) {
  const std::streamoff begin = in.tellg();
  if (begin < 1 || bytes - static_cast<std::uintmax_t>(begin) <= needed) return begin;
  in.seekg(begin - 1);
  const bool is_windows_line = in.get() == '\r' && in.peek() == '\n';
  if (is_windows_line) in.get();
  return in.tellg();
}

void swap_bytes(float* row, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto bits = std::bit_cast<std::uint32_t>(row[i]);
    row[i] = std::bit_cast<float>(__builtin_bswap32(bits));
  }
}

}  // namespace

Image<float> read_pfm_map(const std::filesystem::path& path) {
  Image<float> map = read_pfm(path);
  if (map.channels() == 1) return map;
  Image<float> first(map.height(), map.width());
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const float value = map.at(y, x, 0);
      const bool is_gray =
          std::isnan(value) || (map.at(y, x, 1) == value && map.at(y, x, 2) == value);
      if (!is_gray) {
        throw IoError(path,
                      "this map has 3 channels that differ, but 1 is expected; remove or replace "
                      "it");
      }
      first.at(y, x) = value;
    }
  }
  return first;
}

Image<float> read_pfm(const std::filesystem::path& path) {
  require_readable_file(path);
  std::ifstream in(path, std::ios::binary);
  const Header header = read_header(path, in);
  const std::size_t count = static_cast<std::size_t>(header.width) * header.channels;
  const std::uintmax_t bytes = std::filesystem::file_size(path);
  const std::streamoff begin = begin_of_samples(in, bytes, 4 * count * header.height);
  const std::uintmax_t present =
      begin < 0 ? 0 : (bytes - static_cast<std::uintmax_t>(begin)) / (4 * count);
  if (present < static_cast<std::uintmax_t>(header.height)) {
    throw IoError(
        path,
        fmt::format("the PFM file is truncated: {} of {} rows are present; copy or write it again",
                    present, header.height));
  }
  Image<float> image(header.height, header.width, header.channels);
  const bool is_little = header.scale < 0;
  const auto scale = static_cast<float>(std::abs(header.scale));
  for (int y = header.height - 1; y >= 0; --y) {
    float* row = image.row(y);
    if (!in.read(reinterpret_cast<char*>(row), static_cast<std::streamsize>(count * 4))) {
      throw IoError(path, "the PFM file cannot be read to its end; copy it again");
    }
    if (is_little != (std::endian::native == std::endian::little)) swap_bytes(row, count);
    if (scale != 1) {
      for (std::size_t i = 0; i < count; ++i) row[i] *= scale;
    }
  }
  return image;
}

void write_pfm(const std::filesystem::path& path, ImageView<const float> image) {
  if (image.empty() || (image.channels != 1 && image.channels != 3)) {
    throw InvalidInput(
        fmt::format("a PFM file holds 1 or 3 channels, but the map has {}", image.channels));
  }
  const std::string header = fmt::format("{}\n{} {}\n-1.0\n", image.channels == 3 ? "PF" : "Pf",
                                         image.width, image.height);
  const std::size_t count = static_cast<std::size_t>(image.width) * image.channels;
  std::vector<std::uint8_t> bytes(header.size() + count * 4 * image.height);
  std::memcpy(bytes.data(), header.data(), header.size());
  std::uint8_t* out = bytes.data() + header.size();
  std::vector<float> row(count);
  for (int y = image.height - 1; y >= 0; --y, out += count * 4) {
    std::memcpy(row.data(), image.row(y), count * 4);
    if constexpr (std::endian::native == std::endian::big) swap_bytes(row.data(), count);
    std::memcpy(out, row.data(), count * 4);
  }
  write_atomically(path, bytes);
}

namespace {

constexpr std::string_view kBlanks = " \t\r";
constexpr std::size_t kFewestNumbers = 8;              ///< In a row of a map.
constexpr std::size_t kLongestLine = 1 << 20;          ///< In bytes.
constexpr std::uintmax_t kLargestTextMap = 400000000;  ///< In bytes.

/// What parts the cells of a line: the rarer character, since spaces may stand beside it.
std::string_view separators_of(std::string_view line) {
  for (const std::string_view one : {";", "\t", ","}) {
    if (line.find(one) != std::string_view::npos) return one;
  }
  return kBlanks;
}

std::string_view unquoted(std::string_view cell) {
  const bool is_quoted = cell.size() > 1 && cell.front() == '"' && cell.back() == '"';
  return is_quoted ? cell.substr(1, cell.size() - 2) : cell;
}

std::vector<std::string_view> cells_of(std::string_view line, std::string_view separators) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t end = line.find_first_of(separators);
    cells.push_back(unquoted(trimmed(line.substr(0, end))));
    if (end == std::string_view::npos) return cells;
    // Several spaces are one.
    const std::size_t next = separators == kBlanks ? line.find_first_not_of(kBlanks, end) : end + 1;
    line.remove_prefix(next);
  }
}

/// Empty for a word that is no number. Decimal commas are known by other separators.
std::optional<float> value_of(std::string_view cell) {
  std::string word = lower_case(std::string(cell));
  const std::string size = word.substr(word.find_first_not_of("+-") == 1 ? 1 : 0);
  for (const char* missing : {"", "nan", "na", "null", "inf", "infinity"}) {
    if (size == missing) return std::numeric_limits<float>::quiet_NaN();
  }
  std::ranges::replace(word, ',', '.');
  const auto number = parse_number(word);
  return number ? std::optional(static_cast<float>(*number)) : std::nullopt;
}

/// Whether cells behind the first are 0, 1, 2, … or 1, 2, 3, ….
bool count_up(const std::vector<std::string_view>& cells) {
  const auto first = value_of(cells[1]);
  for (std::size_t i = 1; i < cells.size(); ++i) {
    if (value_of(cells[i]) != *first + static_cast<float>(i - 1)) return false;
  }
  return *first == 0 || *first == 1;
}

/// What a first line of a table says of its columns. Numbers alone are a row of the map.
struct ColumnNames {
  bool are_there = false;  ///< It is a line of names, or numbers columns behind the first.
  bool has_index = false;  ///< The first column numbers or names the rows.
};

ColumnNames column_names(const std::vector<std::string_view>& cells) {
  const bool begins_unlike = cells.front().empty() || !value_of(cells.front());
  if (cells.size() < kFewestNumbers || !begins_unlike) return {};
  const bool are_words = std::none_of(cells.begin() + 1, cells.end(),
                                      [](auto cell) { return value_of(cell).has_value(); });
  const bool are_numbered = !are_words && value_of(cells[1]) && count_up(cells);
  return {are_words || are_numbered, are_numbered || (are_words && cells.front().empty())};
}

/// Whether the first column of a table numbers its rows from 0 or 1.
bool begins_with_index(const std::vector<float>& values, std::size_t width, std::size_t height) {
  bool counts = width > 1 && (values.front() == 0 || values.front() == 1);
  for (std::size_t y = 0; counts && y < height; ++y) {
    counts = values[y * width] == values.front() + static_cast<float>(y);
  }
  return counts;
}

bool is_left_out(std::string_view line) {
  return line.empty() || line.front() == '#' || line.front() == '%';
}

/// Appends the numbers of line `number` and returns how many. Throws IoError.
std::size_t append_row(const std::filesystem::path& path, std::string_view line, std::size_t number,
                       std::vector<float>& values) {
  const std::vector<std::string_view> cells = cells_of(line, separators_of(line));
  for (const std::string_view cell : cells) {
    const auto value = value_of(cell);
    if (!value) {
      throw IoError(path, fmt::format("line {} holds '{}', which is no number; a map is numbers "
                                      "alone, or a table whose first line names the columns",
                                      number, cell.substr(0, 40)));
    }
    values.push_back(*value);
  }
  return cells.size();
}

}  // namespace

bool has_text_suffix(const std::filesystem::path& path) {
  const std::string suffix = suffix_of(path);
  return suffix == ".txt" || suffix == ".csv" || suffix == ".dat";
}

bool is_text_map(const std::filesystem::path& path) {
  if (!has_text_suffix(path)) return false;
  std::ifstream in(path);
  std::string begin(kLongestLine, '\0');
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(in.gcount()));
  for (std::size_t at = 0, lines = 0; at < begin.size();) {
    const std::size_t end = std::min(begin.find('\n', at), begin.size());
    const std::string_view line = trimmed(std::string_view(begin).substr(at, end - at));
    at = end + 1;
    if (is_left_out(line)) continue;
    const auto cells = cells_of(line, separators_of(line));
    if (lines++ == 0 && column_names(cells).are_there) continue;
    return cells.size() >= kFewestNumbers && std::ranges::all_of(cells, [](std::string_view cell) {
             return value_of(cell).has_value();
           });
  }
  return false;
}

Image<float> read_text_map(const std::filesystem::path& path) {
  require_readable_file(path);
  if (std::filesystem::file_size(path) > kLargestTextMap) {
    throw IoError(path, "this text is larger than 400 MB; save the map as .npy");
  }
  std::ifstream in(path);
  std::vector<float> values;
  std::size_t width = 0, height = 0, number = 0, number_of_first = 0;
  ColumnNames names;
  for (std::string line; std::getline(in, line);) {
    ++number;
    const std::string_view text = trimmed(line);
    if (is_left_out(text)) continue;
    if (text.size() > kLongestLine) {
      throw IoError(path, fmt::format("line {} is longer than a row of numbers can be; choose "
                                      "another file",
                                      number));
    }
    if (number_of_first == 0) {
      number_of_first = number;
      names = column_names(cells_of(text, separators_of(text)));
      if (names.are_there) continue;
    }
    const std::size_t count = append_row(path, text, number, values);
    if (height++ == 0) width = count;
    if (count != width) {
      throw IoError(path, fmt::format("line {} has {} values, but the first row has {}; a map has "
                                      "as many in every row",
                                      number, count, width));
    }
  }
  if (values.empty()) throw IoError(path, "holds no rows of numbers; export the map again");
  const bool has_index =
      names.are_there && (names.has_index || begins_with_index(values, width, height));
  const std::size_t left = has_index && width > 1 ? 1 : 0;
  Image<float> map(static_cast<int>(height), static_cast<int>(width - left));
  for (std::size_t y = 0; y < height; ++y) {
    std::copy_n(values.data() + y * width + left, width - left, map.row(static_cast<int>(y)));
  }
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

namespace {

using Position = std::array<float, 3>;
using Color = std::array<std::uint8_t, 3>;
using Triangle = std::array<std::uint32_t, 3>;

constexpr std::uint8_t kCorners = 3;

std::string header(const PointCloud& cloud, PlyForm form) {
  const char* binary =
      std::endian::native == std::endian::little ? "binary_little_endian" : "binary_big_endian";
  std::string text =
      "ply\nformat " + std::string(form == PlyForm::Binary ? binary : "ascii") +
      " 1.0\ncomment Episcope, x to the right, y upwards, the viewer looks along -z\n"
      "element vertex " +
      std::to_string(cloud.positions.size()) +
      "\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (!cloud.triangles.empty()) {
    text += "element face " + std::to_string(cloud.triangles.size()) +
            "\nproperty list uchar int vertex_indices\n";
  }
  return text + "end_header\n";
}

template <class T>
void append_bytes(std::string& out, const T& value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void append(std::string& out, const Position& place, const Color& color, PlyForm form) {
  if (form == PlyForm::Binary) {
    append_bytes(out, place);
    append_bytes(out, color);
    return;
  }
  char line[128];
  const int length = std::snprintf(line, sizeof line, "%.9g %.9g %.9g %d %d %d\n", place[0],
                                   place[1], place[2], color[0], color[1], color[2]);
  out.append(line, static_cast<std::size_t>(length));
}

void append(std::string& out, const Triangle& triangle, PlyForm form) {
  if (form == PlyForm::Binary) {
    append_bytes(out, kCorners);
    append_bytes(out, triangle);
    return;
  }
  char line[64];
  const int length =
      std::snprintf(line, sizeof line, "3 %u %u %u\n", triangle[0], triangle[1], triangle[2]);
  out.append(line, static_cast<std::size_t>(length));
}

}  // namespace

void write_ply(const std::filesystem::path& path, const PointCloud& cloud, PlyForm form) {
  if (cloud.positions.empty()) {
    throw InvalidInput("no pixel of the disparity is valid, so there is no point to write");
  }
  std::string text = header(cloud, form);
  const bool is_binary = form == PlyForm::Binary;
  text.reserve(text.size() + cloud.positions.size() * (is_binary ? 15 : 48) +
               cloud.triangles.size() * (is_binary ? 13 : 24));
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    append(text, cloud.positions[i], cloud.colors[i], form);
  }
  for (const Triangle& triangle : cloud.triangles) append(text, triangle, form);
  write_atomically(path, text);
}

}  // namespace episcope::io
