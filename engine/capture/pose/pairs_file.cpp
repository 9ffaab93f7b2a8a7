// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/pose/pairs_file.h"

#include "engine/core/error.h"
#include "engine/io/durable/atomic_file.h"
#include "engine/io/maps/parse_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

namespace episcope::capture {
namespace {

constexpr const char* kHeader = "name,x_px,y_px,X,Y,Z";
constexpr const char* kLocked = ",locked";

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\"");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\"") + 1 - first);
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = line.find(',', begin);
    fields.push_back(trimmed(line.substr(begin, end - begin)));
    if (end == std::string::npos) return fields;
    begin = end + 1;
  }
}

PointPair pair_of(const std::filesystem::path& path, int line,
                  const std::vector<std::string>& fields) {
  const auto fail = [&](const std::string& what) -> IoError {
    return {path, fmt::format("line {} {}; a line is {}", line, what, kHeader)};
  };
  if (fields.size() != 6 && fields.size() != 7) {
    throw fail(fmt::format("has {} fields instead of 6", fields.size()));
  }
  double numbers[5];
  for (int i = 0; i < 5; ++i) {
    const auto number = io::parse_number(fields[i + 1]);
    if (!number) throw fail("has '" + fields[i + 1] + "' where a number belongs");
    numbers[i] = *number;
  }
  const std::string lock = fields.size() == 7 ? fields[6] : "0";
  if (lock != "0" && lock != "1") throw fail("has '" + lock + "' where 1 (locked) or 0 belongs");
  return {fields[0], numbers[0], numbers[1], {numbers[2], numbers[3], numbers[4]}, lock == "1"};
}

}  // namespace

std::vector<PointPair> read_pairs(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw IoError(path, "this file cannot be read; name the pairs, as CSV");
  std::vector<PointPair> pairs;
  std::string text;
  for (int line = 1; std::getline(file, text); ++line) {
    if (line == 1 && text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
    const std::string content = trimmed(text);
    if (content.empty() || content.starts_with('#')) continue;
    const std::vector<std::string> fields = fields_of(content);
    if (pairs.empty() && fields.size() > 1 && fields[1] == "x_px") continue;
    pairs.push_back(pair_of(path, line, fields));
  }
  if (pairs.empty()) {
    throw IoError(path, std::string("there are no pairs in this file; a line is ") + kHeader);
  }
  return pairs;
}

void write_pairs(const std::filesystem::path& path, std::span<const PointPair> pairs) {
  const bool has_locks = std::ranges::any_of(pairs, &PointPair::is_locked);
  std::string text = std::string(kHeader) + (has_locks ? kLocked : "") + "\n";
  for (const PointPair& pair : pairs) {
    if (pair.name.find_first_of(",\n\r") != std::string::npos) {
      throw IoError(path,
                    "the name '" + pair.name + "' has a comma or a line end; rename the pair");
    }
    text += fmt::format("{},{},{},{},{},{}", pair.name, pair.x_px, pair.y_px, pair.point.x,
                        pair.point.y, pair.point.z);
    if (has_locks) text += pair.is_locked ? ",1" : ",0";
    text += '\n';
  }
  io::write_atomically(path, text);
}

}  // namespace episcope::capture
