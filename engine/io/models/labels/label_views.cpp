// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/labels/label_views.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/text.h"
#include "engine/io/models/labels/label_pictures.h"
#include "engine/io/models/sidecar_maps/map_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

/// The view whose file has the longest name that this one begins with.
std::optional<ViewIndex> view_of_own_name(const std::string& stem, const LabelPlaces& places) {
  std::optional<ViewIndex> found;
  std::size_t longest = 0;
  for (std::size_t i = 0; i < places.names.size(); ++i) {
    const std::string& name = places.names[i];
    const bool has_end =
        stem.size() > name.size() && (is_letter(stem[name.size()]) || is_digit(stem[name.size()]));
    if (name.size() <= longest || !stem.starts_with(name) || has_end) continue;
    longest = name.size();
    found = places.shape.grid.view_at(static_cast<int>(i));
  }
  return found;
}

/// The view that a name states without counting.
std::optional<ViewIndex> stated_view(const fs::path& path, const LabelPlaces& places) {
  if (const auto stated = view_of_scribble_picture(path.filename().string())) return stated;
  return view_of_own_name(path.stem().string(), places);
}

/// Numbers of a name, from the first.
using NameNumbers = std::vector<long>;
/// Which two of them tell row and column.
using ViewNumbers = std::pair<std::size_t, std::size_t>;

std::optional<ViewIndex> view_of_numbers(const NameNumbers& numbers, ViewNumbers pair,
                                         GridShape grid) {
  if (numbers.size() <= pair.second) return std::nullopt;
  const long v = numbers[pair.first], u = numbers[pair.second];
  if (v >= grid.v || u >= grid.u) return std::nullopt;
  return ViewIndex{static_cast<int>(v), static_cast<int>(u)};
}

/// Two numbers, neighbors or the only ones that vary, that are a view in each of the names, which
/// have no other number that varies.
std::vector<ViewNumbers> number_pairs(const std::vector<NameNumbers>& names, GridShape grid) {
  const NameNumbers& first = names.front();
  const auto varies = [&](std::size_t i) {
    return std::ranges::any_of(
        names, [&](const NameNumbers& one) { return i >= one.size() || one[i] != first[i]; });
  };
  std::vector<ViewNumbers> pairs;
  for (std::size_t column = 1; column < first.size(); ++column) {
    for (std::size_t row = 0; row < column; ++row) {
      if (row + 1 < column && !(varies(row) && varies(column))) continue;
      bool fits = std::ranges::all_of(names, [&](const NameNumbers& one) {
        return view_of_numbers(one, {row, column}, grid).has_value();
      });
      for (std::size_t i = 0; i < first.size(); ++i) {
        fits = fits && (i == row || i == column || !varies(i));
      }
      if (fits) pairs.emplace_back(row, column);
    }
  }
  return pairs;
}

}  // namespace

std::vector<NamedFile> named_views(const std::vector<fs::path>& paths, const LabelPlaces& places,
                                   std::vector<std::string>& notes) {
  const GridShape grid = places.shape.grid;
  std::vector<NamedFile> files;
  std::vector<NameNumbers> names;
  std::vector<std::size_t> unstated;
  for (const fs::path& path : paths) {
    files.push_back({path, stated_view(path, places)});
    NameNumbers numbers = numbered_name(path.stem().string()).numbers;
    if (files.back().view || numbers.size() < 2) continue;
    names.push_back(std::move(numbers));
    unstated.push_back(files.size() - 1);
  }
  if (names.empty()) return files;
  const std::vector<ViewNumbers> pairs = number_pairs(names, grid);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const NameNumbers& own = names[i];
    NamedFile& file = files[unstated[i]];
    const ViewNumbers last{own.size() - 2, own.size() - 1};
    file.view = view_of_numbers(own, pairs.empty() ? last : pairs.back(), grid);
    const bool is_doubtful = pairs.empty() ? own.size() > 2 : pairs.size() > 1;
    const auto other =
        view_of_numbers(own, pairs.empty() ? ViewNumbers{0, 1} : pairs.front(), grid);
    if (i > 0 || !is_doubtful || !file.view || !other) continue;
    notes.push_back(fmt::format(finding_text("labels.numbers"), file.path.filename().string(),
                                view_text(*file.view), view_text(*other)));
  }
  return files;
}

std::optional<std::vector<NamedFile>> counted_views(const std::vector<fs::path>& paths,
                                                    GridShape grid) {
  if (static_cast<int>(paths.size()) != grid.count()) return std::nullopt;
  std::map<std::vector<long>, fs::path> by_numbers;
  std::set<std::string> texts;
  std::vector<std::set<long>> values;
  for (const fs::path& path : paths) {
    const NumberedName name = numbered_name(path.stem().string());
    texts.insert(name.text);
    values.resize(std::max(values.size(), name.numbers.size()));
    for (std::size_t i = 0; i < name.numbers.size(); ++i) values[i].insert(name.numbers[i]);
    by_numbers[name.numbers] = path;
  }
  std::vector<int> varying;
  for (const std::set<long>& each : values) {
    if (each.size() > 1) varying.push_back(static_cast<int>(each.size()));
  }
  const bool is_counted = varying.size() == 1 || varying == std::vector<int>{grid.v, grid.u};
  if (texts.size() != 1 || !is_counted || by_numbers.size() != paths.size()) return std::nullopt;
  std::vector<NamedFile> files;
  for (const auto& [numbers, path] : by_numbers) {
    files.push_back({path, grid.view_at(static_cast<int>(files.size()))});
  }
  return files;
}

std::vector<NamedFile> placed_views(const std::vector<fs::path>& paths, const LabelPlaces& places,
                                    std::vector<std::string>& notes) {
  std::vector<NamedFile> files = named_views(paths, places, notes);
  if (files.size() == 1) return files;
  const auto unknown =
      std::ranges::find_if(files, [](const NamedFile& file) { return !file.view; });
  if (unknown == files.end()) return files;
  if (auto all = counted_views(paths, places.shape.grid)) return *all;
  throw IoError(unknown->path,
                "the name tells no view; name files of several views by row and column, as in "
                "03_04.png, or select as many as there are views, with running numbers");
}

}  // namespace episcope::io
