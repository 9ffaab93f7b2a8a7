// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/labels/color_table.h"

#include "engine/core/error.h"
#include "engine/core/numbers.h"
#include "engine/core/text.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <utility>

namespace episcope::io {

namespace fs = std::filesystem;

std::string color_text(const Rgb& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

namespace {

/// Begins of a line that are separated as a table is; the last holds the rest.
std::vector<std::string> cells_of(std::string_view line, std::size_t most) {
  const std::string_view marks = line.find(',') != line.npos   ? ","
                                 : line.find(';') != line.npos ? ";"
                                                               : " \t";
  std::vector<std::string> cells;
  std::string_view rest = trimmed(line);
  while (!rest.empty() && cells.size() + 1 < most) {
    const std::size_t end = std::min(rest.find_first_of(marks), rest.size());
    cells.emplace_back(trimmed(rest.substr(0, end), kQuotesAndBlanks));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    rest = trimmed(rest);
  }
  const bool is_quoted = rest.size() > 1 && rest.front() == '"' && rest.back() == '"';
  if (is_quoted) rest = trimmed(rest, kQuotesAndBlanks);
  if (!rest.empty()) cells.emplace_back(rest);
  return cells;
}

std::optional<int> whole_number(const std::string& text, int most) {
  const auto number = parse_number(text);
  const auto whole = number ? whole_int(*number) : std::nullopt;
  return whole && *whole >= 0 && *whole <= most ? whole : std::nullopt;
}

constexpr int kMostId = 65535;

/// Empty if the line is no row of a table.
std::optional<LabelInfo> row_of(const std::string& line) {
  constexpr std::size_t kCells = 5;
  const std::vector<std::string> cells = cells_of(line, kCells);
  if (cells.size() + 1 < kCells) return std::nullopt;
  LabelInfo row;
  for (std::size_t c = 0; c < row.color.size(); ++c) {
    const auto level = whole_number(cells[c], 255);
    if (!level) return std::nullopt;
    row.color[c] = static_cast<std::uint8_t>(*level);
  }
  const auto id = whole_number(cells[3], kMostId);
  if (!id) return std::nullopt;
  row.id = *id;
  row.name = cells.size() == kCells ? cells.back() : color_text(row.color);
  return row;
}

constexpr const char* kBackground = "background";

/// A line `name:r,g,b:parts:actions`, whose id is not yet known; empty for another one.
std::optional<LabelInfo> label_map_row(const std::string& line) {
  const std::size_t end = line.find(':');
  if (end == std::string::npos || end == 0) return std::nullopt;
  const auto row =
      row_of(line.substr(end + 1, line.find(':', end + 1) - end - 1) + ",0," + line.substr(0, end));
  return row;
}

std::vector<LabelInfo> voc_colors() {
  constexpr int kCount = 256;
  constexpr int kVoid = 255;
  std::vector<LabelInfo> labels;
  for (int id = 0; id < kCount; ++id) {
    LabelInfo label{id == kVoid ? 0 : id, "label " + std::to_string(id), {}};
    // Bits 0, 3, 6 of the place are the highest ones of red, 1, 4, 7 of green, 2, 5 of blue.
    for (int bit = 0; bit < 8; ++bit) {
      if ((id >> bit & 1) == 0) continue;
      label.color[static_cast<std::size_t>(bit % 3)] |= static_cast<std::uint8_t>(128 >> bit / 3);
    }
    labels.push_back(std::move(label));
  }
  return labels;
}

std::vector<LabelInfo> cityscapes_colors() {
  return {{0, "unlabeled", {0, 0, 0}},
          {5, "dynamic", {111, 74, 0}},
          {6, "ground", {81, 0, 81}},
          {7, "road", {128, 64, 128}},
          {8, "sidewalk", {244, 35, 232}},
          {9, "parking", {250, 170, 160}},
          {10, "rail track", {230, 150, 140}},
          {11, "building", {70, 70, 70}},
          {12, "wall", {102, 102, 156}},
          {13, "fence", {190, 153, 153}},
          {14, "guard rail", {180, 165, 180}},
          {15, "bridge", {150, 100, 100}},
          {16, "tunnel", {150, 120, 90}},
          {17, "pole", {153, 153, 153}},
          {19, "traffic light", {250, 170, 30}},
          {20, "traffic sign", {220, 220, 0}},
          {21, "vegetation", {107, 142, 35}},
          {22, "terrain", {152, 251, 152}},
          {23, "sky", {70, 130, 180}},
          {24, "person", {220, 20, 60}},
          {25, "rider", {255, 0, 0}},
          {26, "car", {0, 0, 142}},
          {27, "truck", {0, 0, 70}},
          {28, "bus", {0, 60, 100}},
          {29, "caravan", {0, 0, 90}},
          {30, "trailer", {0, 0, 110}},
          {31, "train", {0, 80, 100}},
          {32, "motorcycle", {0, 0, 230}},
          {33, "bicycle", {119, 11, 32}}};
}

}  // namespace

const std::vector<SharedColors>& shared_colors() {
  static const std::vector<SharedColors> tables{
      {"voc", "the colors of PASCAL VOC", voc_colors()},
      {"cityscapes", "the colors of Cityscapes", cityscapes_colors()}};
  return tables;
}

fs::path label_map_beside(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::path& place : {folder, folder.parent_path()}) {
    if (fs::is_regular_file(place / kLabelMap, ignored)) return place / kLabelMap;
  }
  return {};
}

void write_label_map_text(const fs::path& path, const std::vector<LabelInfo>& labels) {
  std::string text = "# label:color_rgb:parts:actions\n";
  text += std::string(kBackground) + ":0,0,0::\n";
  for (const LabelInfo& label : labels) {
    std::string name = label.name;
    std::ranges::replace(name, ':', ' ');
    if (name == kBackground) name += fmt::format("_{}", label.id);  // a name of its own
    text += fmt::format("{}:{},{},{}::\n", name, label.color[0], label.color[1], label.color[2]);
  }
  write_atomically(path, text);
}

std::vector<LabelInfo> read_color_table(const fs::path& path) {
  require_readable_file(path);
  std::ifstream in(path);
  std::vector<LabelInfo> table;
  int number = 0;
  int next = 1;  // id of a line of labelmap.txt
  bool may_be_heading = true;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string::npos || line.starts_with('#')) continue;
    auto row = row_of(line);
    if (!row && (row = label_map_row(line)) && row->name != kBackground) row->id = next++;
    if (!row && !std::exchange(may_be_heading, false)) {
      throw IoError(path, fmt::format("line {} is '{}', but must be r,g,b,id,name with levels from "
                                      "0 to 255 and an id from 0 to {}",
                                      number, line, kMostId));
    }
    may_be_heading = false;
    if (!row) continue;
    if (std::ranges::find(table, row->color, &LabelInfo::color) != table.end()) {
      throw IoError(path, fmt::format("line {} repeats the color {}; give each color one label",
                                      number, color_text(row->color)));
    }
    table.push_back(*row);
  }
  if (table.empty()) throw IoError(path, "has no line r,g,b,id,name; write one for each color");
  return table;
}

}  // namespace episcope::io
