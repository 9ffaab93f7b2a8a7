// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/grid_names.h"

#include "engine/core/error.h"
#include "engine/io/grid/decode_image.h"
#include "engine/io/maps/parse_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <regex>
#include <set>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

/// A file with the numbers found in its name.
struct Numbered {
  fs::path path;
  std::vector<long> numbers;
};

/// Files that share all but the numbers of their names.
struct Group {
  std::string pattern;
  std::vector<Numbered> files;
};

std::vector<fs::path> list_images(const fs::path& folder) {
  std::vector<fs::path> images;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const bool is_hidden = entry.path().filename().string().starts_with('.');
    if (!is_hidden && entry.is_regular_file() && is_image_name(entry.path())) {
      images.push_back(entry.path());
    }
  }
  std::sort(images.begin(), images.end());
  return images;
}

std::vector<std::string> tokens_of(const std::string& stem) {
  std::vector<std::string> tokens;
  std::size_t begin = 0;
  while (begin <= stem.size()) {
    const std::size_t end = std::min(stem.find('_', begin), stem.size());
    if (end > begin) tokens.push_back(stem.substr(begin, end - begin));
    begin = end + 1;
  }
  return tokens;
}

bool is_count(const std::string& text) {
  return !text.empty() && text.size() < 10 &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// out_<row>_<col>_<Y>_<X>, also with empty tokens between.
std::optional<Numbered> stanford_name(const fs::path& path) {
  const std::vector<std::string> tokens = tokens_of(path.stem().string());
  if (tokens.size() != 5 || tokens[0] != "out" || !is_count(tokens[1]) || !is_count(tokens[2]) ||
      !parse_number(tokens[3]) || !parse_number(tokens[4])) {
    return std::nullopt;
  }
  return Numbered{path, {std::stol(tokens[1]), std::stol(tokens[2])}};
}

Group stanford_group(const std::vector<fs::path>& images) {
  Group group{"out_{row}_{col}_{Y}_{X}", {}};
  for (const fs::path& path : images) {
    if (auto file = stanford_name(path)) group.files.push_back(std::move(*file));
  }
  return group;
}

/// Splits a name into its digits and what is around them, written with `#` for each number.
std::pair<std::string, std::vector<long>> skeleton(const std::string& name) {
  std::string text;
  std::vector<long> numbers;
  for (std::size_t i = 0; i < name.size();) {
    std::size_t end = i;
    while (end < name.size() && std::isdigit(static_cast<unsigned char>(name[end]))) ++end;
    if (end == i) {
      text += name[i++];
    } else {
      // Longer runs of digits are dates or serial numbers, and only the tail of those varies.
      const std::size_t begin = end - i > 9 ? end - 9 : i;
      text += name.substr(i, begin - i) + '#';
      numbers.push_back(std::stol(name.substr(begin, end - begin)));
      i = end;
    }
  }
  return {text, numbers};
}

/// The largest set of files whose names differ in numbers only, with the numbers that vary.
Group largest_group(const std::vector<fs::path>& images) {
  std::map<std::string, std::vector<Numbered>> groups;
  for (const fs::path& path : images) {
    auto [text, numbers] = skeleton(path.filename().string());
    if (!numbers.empty()) groups[text].push_back({path, numbers});
  }
  const auto largest = std::max_element(
      groups.begin(), groups.end(),
      [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
  if (largest == groups.end()) return {};
  Group group{{}, std::move(largest->second)};
  const std::vector<long> first = group.files.front().numbers;
  std::vector<std::size_t> varying;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const bool varies =
        std::any_of(group.files.begin(), group.files.end(),
                    [&](const Numbered& file) { return file.numbers[i] != first[i]; });
    if (varies && varying.size() < 2) varying.push_back(i);
  }
  for (Numbered& file : group.files) {
    std::vector<long> kept;
    for (const std::size_t i : varying) kept.push_back(file.numbers[i]);
    file.numbers = std::move(kept);
  }
  std::size_t field = 0;
  for (const char c : largest->first) {
    if (c != '#') {
      group.pattern += c;
      continue;
    }
    const auto place = std::find(varying.begin(), varying.end(), field);
    if (place == varying.end()) {
      group.pattern += field < first.size() ? std::to_string(first[field]) : "";
    } else if (varying.size() == 1) {
      group.pattern += "{index}";
    } else {
      group.pattern += place == varying.begin() ? "{row}" : "{col}";
    }
    ++field;
  }
  return group;
}

/// Turns a pattern of the user's into a regular expression.
struct Pattern {
  std::regex expression;
  bool is_column_first = false;

  explicit Pattern(const std::string& text) {
    std::string pattern;
    for (std::size_t i = 0; i < text.size();) {
      const std::string rest = text.substr(i);
      const auto field = [&](const char* name) {
        const bool is_here = rest.starts_with(name);
        if (is_here) {
          pattern += "0*([0-9]{1,9})";
          i += std::string(name).size();
        }
        return is_here;
      };
      if (field("{row}") || field("{col}") || field("{index}")) continue;
      const char c = text[i++];
      if (c == '*') {
        pattern += ".*";
      } else {
        if (std::string("\\^$.|?+()[]{}").find(c) != std::string::npos) pattern += '\\';
        pattern += c;
      }
    }
    expression = std::regex(pattern);
    is_column_first = text.find("{col}") < text.find("{row}");
  }
};

Group group_by_pattern(const std::vector<fs::path>& images, const std::string& text) {
  const bool has_both =
      text.find("{row}") != std::string::npos && text.find("{col}") != std::string::npos;
  const bool has_index = text.find("{index}") != std::string::npos;
  if (has_both == has_index) {
    throw InvalidInput("the pattern '" + text +
                       "' must contain {row} and {col}, or {index}, as in view_{row}_{col}.png");
  }
  const Pattern pattern(text);
  Group group{text, {}};
  for (const fs::path& path : images) {
    std::smatch match;
    const std::string name = path.filename().string();
    if (!std::regex_match(name, match, pattern.expression)) continue;
    Numbered file{path, {}};
    for (std::size_t i = 1; i < match.size(); ++i) file.numbers.push_back(std::stol(match[i]));
    if (pattern.is_column_first && has_both) std::swap(file.numbers[0], file.numbers[1]);
    group.files.push_back(std::move(file));
  }
  return group;
}

std::string tried(const Group& group, std::size_t images) {
  return fmt::format("pattern {} matches {} of {} images", group.pattern, group.files.size(),
                     images);
}

ViewFiles two_number_grid(const fs::path& folder, const Group& group, std::size_t images) {
  std::set<long> rows;
  std::set<long> columns;
  std::map<std::pair<long, long>, fs::path> files;
  for (const Numbered& file : group.files) {
    rows.insert(file.numbers[0]);
    columns.insert(file.numbers[1]);
    const auto [place, is_new] = files.try_emplace({file.numbers[0], file.numbers[1]}, file.path);
    if (!is_new) {
      throw IoError(file.path, "this view has the same row and column as " +
                                   place->second.filename().string() + "; remove one of the two");
    }
  }
  ViewFiles views{{static_cast<int>(rows.size()), static_cast<int>(columns.size())}, {}};
  for (const long row : rows) {
    for (const long column : columns) {
      const auto found = files.find({row, column});
      if (found == files.end()) {
        throw IoError(folder,
                      fmt::format("the view of row {}, column {} is missing ({}, a grid of {}×{}); "
                                  "add it or name a pattern",
                                  row, column, tried(group, images), rows.size(), columns.size()));
      }
      views.files.push_back(found->second);
    }
  }
  return views;
}

ViewFiles index_grid(const fs::path& folder, Group group, std::size_t images) {
  std::sort(group.files.begin(), group.files.end(),
            [](const Numbered& a, const Numbered& b) { return a.numbers < b.numbers; });
  const std::size_t count = group.files.size();
  const auto side = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(count))));
  if (count >= 4 && side * side == count) {
    ViewFiles views{{static_cast<int>(side), static_cast<int>(side)}, {}};
    for (Numbered& file : group.files) views.files.push_back(std::move(file.path));
    return views;
  }
  std::string gap;
  for (std::size_t i = 1; i < count && gap.empty(); ++i) {
    const long expected = group.files[i - 1].numbers[0] + 1;
    if (group.files[i].numbers[0] > expected) {
      gap = fmt::format("; the number {} is missing", expected);
    }
  }
  throw IoError(folder, "the images do not form a square grid (" + tried(group, images) + gap +
                            "); add the missing views or name a pattern with {row} and {col}");
}

void reverse_second_rows(ViewFiles& views) {
  for (int v = 1; v < views.grid.v; v += 2) {
    const auto row = views.files.begin() + static_cast<std::ptrdiff_t>(v) * views.grid.u;
    std::reverse(row, row + views.grid.u);
  }
}

}  // namespace

int count_images(const fs::path& folder) {
  return static_cast<int>(list_images(folder).size());
}

NamedGrid name_grid(const fs::path& folder, const std::string& pattern, bool snake) {
  const std::vector<fs::path> images = list_images(folder);
  Group group;
  if (!pattern.empty()) {
    group = group_by_pattern(images, pattern);
  } else {
    group = stanford_group(images);
    if (group.files.empty()) group = largest_group(images);
  }
  if (group.files.size() < 2 || group.files.front().numbers.empty()) {
    throw IoError(
        folder,
        "the images do not form a grid of views: " +
            (pattern.empty()
                 ? fmt::format("{} images were found, and their names give no row and column",
                               images.size())
                 : tried(group, images.size())) +
            "; name a pattern such as view_{row}_{col}.png");
  }
  NamedGrid grid;
  grid.pattern = group.pattern;
  grid.left_out = static_cast<int>(images.size() - group.files.size());
  grid.views = group.files.front().numbers.size() == 2
                   ? two_number_grid(folder, group, images.size())
                   : index_grid(folder, std::move(group), images.size());
  if (snake) reverse_second_rows(grid.views);
  return grid;
}

}  // namespace episcope::io
