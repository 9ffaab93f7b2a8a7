// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/array_file.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/text.h"
#include "engine/io/models/estimated.h"
#include "engine/io/models/names/view_files.h"
#include "engine/io/models/sidecar_maps/map_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <set>
#include <string_view>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFewestJoined = 3;
constexpr std::size_t kFewestViewPixels = 4;

bool is_channels(std::size_t length) {
  return length == 1 || length == 3 || length == 4;
}

bool is_same_kind(const ArrayEntry& a, const ArrayEntry& b) {
  return a.shape == b.shape && a.type == b.type && a.order == b.order;
}

/// [y][x], or with channels: a map or a view.
bool can_be_view(const ArrayEntry& entry) {
  if (!entry.other_kind.empty() || !entry.parts.empty()) return false;
  ArrayShape shape = in_index_order(entry.shape, entry.order);
  if (shape.size() == 3 && is_channels(shape[2])) {
    shape.pop_back();
  } else if (shape.size() == 3 && is_channels(shape[0])) {
    shape.erase(shape.begin());
  }
  return shape.size() == 2 && std::ranges::min(shape) >= kFewestViewPixels;
}

/// What the names of one series have in common, and an array's place in it.
struct NumberedEntry {
  std::size_t at = 0;  ///< In the list of entries.
  std::vector<long> numbers;
};

/// "view_#_#", where the numbers differ.
std::string series_name(const std::string& name, const std::vector<bool>& varies) {
  std::string text;
  std::size_t run = 0;
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  for (std::size_t i = 0; i < name.size();) {
    if (!is_digit(name[i])) {
      text += name[i++];
      continue;
    }
    std::size_t end = i;
    while (end < name.size() && is_digit(name[end])) ++end;
    text += varies[run++] ? "#" : name.substr(i, end - i);
    i = end;
  }
  return text;
}

/// Which numbers differ within a series.
std::vector<bool> varying(const std::vector<NumberedEntry>& series) {
  std::vector<bool> varies(series.front().numbers.size());
  for (std::size_t i = 0; i < varies.size(); ++i) {
    varies[i] = std::ranges::any_of(series, [&](const NumberedEntry& one) {
      return one.numbers[i] != series.front().numbers[i];
    });
  }
  return varies;
}

/// Only the numbers that differ; sorted by them.
void sort_by_place(std::vector<NumberedEntry>& series, const std::vector<bool>& varies) {
  for (NumberedEntry& one : series) {
    std::vector<long> place;
    for (std::size_t i = 0; i < varies.size(); ++i) {
      if (varies[i]) place.push_back(one.numbers[i]);
    }
    one.numbers = std::move(place);
  }
  std::ranges::sort(series, {}, &NumberedEntry::numbers);
}

/// The places of a series with two numbers, where its arrays are by their names; nothing if there
/// are less than half as many arrays.
std::optional<GridWithGaps> grid_of(const std::vector<ArrayEntry>& entries,
                                    const std::vector<NumberedEntry>& series) {
  std::vector<long long> rows;
  std::vector<long long> columns;
  for (const NumberedEntry& one : series) {
    rows.push_back(one.numbers[0]);
    columns.push_back(one.numbers[1]);
  }
  GridWithGaps grid{NumberRun(std::move(rows)).filled(), NumberRun(std::move(columns)).filled()};
  const std::size_t places = grid.rows.size() * grid.columns.size();
  if (2 * series.size() < places) return std::nullopt;
  grid.files.resize(places);
  const auto place_in = [](const std::vector<long long>& numbers, long number) {
    return static_cast<std::size_t>(std::ranges::lower_bound(numbers, number) - numbers.begin());
  };
  for (const NumberedEntry& one : series) {
    const std::size_t row = place_in(grid.rows, one.numbers[0]);
    const std::size_t column = place_in(grid.columns, one.numbers[1]);
    grid.files[row * grid.columns.size() + column] = entries[one.at].name;
  }
  return grid;
}

void add_axes(ArrayEntry& whole, GridShape grid) {
  whole.shape.insert(whole.shape.begin(),
                     {static_cast<std::size_t>(grid.v), static_cast<std::size_t>(grid.u)});
}

/// Joins a series with sorted places; nothing if these are no places of views.
std::optional<ArrayEntry> whole_of(const std::vector<ArrayEntry>& entries,
                                   const std::vector<NumberedEntry>& series, std::string name) {
  ArrayEntry whole = entries[series.front().at];
  whole.name = std::move(name);
  whole.stated_axes.clear();
  for (const NumberedEntry& one : series) whole.parts.push_back(entries[one.at].name);
  if (series.front().numbers.size() == 1) {
    whole.leading = 'n';
    whole.shape.insert(whole.shape.begin(), series.size());
    return whole;
  }
  whole.leading = "vu";
  const auto grid = grid_of(entries, series);
  if (!grid) return std::nullopt;
  const auto part = grid->missing() > 0 ? part_to_open(*grid) : std::nullopt;
  whole.parts.clear();
  if (part) {
    for (const auto& one : files_of_part(*grid, *part).files) whole.parts.push_back(one.string());
    whole.warning = part_text(*grid, *part);
    add_axes(whole, part->grid);
  } else if (grid->missing() > 0) {
    whole.other_kind = fmt::format("{} views on a grid of {}×{}, {}", series.size(),
                                   grid->rows.size(), grid->columns.size(), missing_text(*grid));
  } else {
    for (const auto& one : grid->files) whole.parts.push_back(one.string());
    add_axes(whole, grid->shape());
  }
  return whole;
}

/// Replaces the arrays at `places` by `whole`, at the place of the first one.
void replace(std::vector<ArrayEntry>& entries, std::vector<std::size_t> places, ArrayEntry whole) {
  std::ranges::sort(places);
  entries[places.front()] = std::move(whole);
  for (std::size_t i = places.size(); i-- > 1;) {
    entries.erase(entries.begin() + static_cast<std::ptrdiff_t>(places[i]));
  }
}

void join_views(std::vector<ArrayEntry>& entries) {
  std::map<std::string, std::vector<NumberedEntry>> all;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (!can_be_view(entries[i])) continue;
    NumberedName name = numbered_name(entries[i].name);
    if (!name.numbers.empty()) all[name.text].push_back({i, std::move(name.numbers)});
  }
  std::vector<std::pair<std::vector<std::size_t>, ArrayEntry>> wholes;
  for (auto& [text, series] : all) {
    const ArrayEntry& first = entries[series.front().at];
    const bool is_even = std::ranges::all_of(
        series, [&](const NumberedEntry& one) { return is_same_kind(entries[one.at], first); });
    const std::vector<bool> varies = varying(series);
    const auto count = std::ranges::count(varies, true);
    if (series.size() < kFewestJoined || !is_even || count < 1 || count > 2) continue;
    const std::string name = series_name(first.name, varies);
    sort_by_place(series, varies);
    const bool has_twins =
        std::ranges::adjacent_find(series, {}, &NumberedEntry::numbers) != series.end();
    if (has_twins) continue;
    auto whole = whole_of(entries, series, name);
    if (!whole) continue;
    std::vector<std::size_t> places;
    for (const NumberedEntry& one : series) places.push_back(one.at);
    wholes.emplace_back(std::move(places), std::move(*whole));
  }
  std::set<std::size_t, std::greater<>> gone;
  for (auto& [places, whole] : wholes) {
    gone.insert(places.begin(), places.end());
    entries.push_back(std::move(whole));
  }
  for (const std::size_t at : gone)
    entries.erase(entries.begin() + static_cast<std::ptrdiff_t>(at));
}

/// What stands before the name of a channel, with what parts them: "LF/" of "LF/r", "lf" of "lfr".
/// Nothing if the name does not end so.
std::optional<std::string> before_channel(const std::string& name, std::string_view channel) {
  if (!lower_case(name).ends_with(channel)) return std::nullopt;
  return name.substr(0, name.size() - channel.size());
}

void join_channels(std::vector<ArrayEntry>& entries) {
  constexpr std::array<std::array<std::string_view, 3>, 2> kNames{
      {{"r", "g", "b"}, {"red", "green", "blue"}}};
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const ArrayEntry first = entries[i];
    const auto names = std::ranges::find_if(
        kNames, [&](const auto& all) { return before_channel(first.name, all[0]).has_value(); });
    if (names == kNames.end() || !first.other_kind.empty()) continue;
    const std::string before = *before_channel(first.name, names->front());
    std::vector<std::size_t> places;
    for (const std::string_view channel : *names) {
      const auto found = std::ranges::find_if(entries, [&](const ArrayEntry& entry) {
        return before_channel(entry.name, channel) == before && is_same_kind(entry, first);
      });
      if (found != entries.end()) {
        places.push_back(static_cast<std::size_t>(found - entries.begin()));
      }
    }
    if (places.size() != names->size()) continue;
    ArrayEntry whole = first;
    whole.name = before.substr(0, before.find_last_not_of("/_.- ") + 1);
    if (whole.name.empty()) whole.name = "rgb";
    whole.stated_axes.clear();
    whole.leading = 'c';
    whole.shape.insert(whole.shape.begin(), places.size());
    for (const std::size_t place : places) whole.parts.push_back(entries[place].name);
    replace(entries, places, std::move(whole));
  }
}

/// Arrays of equal shape as one: places along its first axes, and what they have in common.
class StackedArray : public ArrayInput {
 public:
  StackedArray(const std::filesystem::path& path, const ArrayEntry& entry,
               std::vector<std::unique_ptr<ArrayInput>> parts)
      : ArrayInput(path, entry.shape, entry.type),
        first_axes_(entry.shape.size() - parts.front()->shape().size()),
        parts_(std::move(parts)) {}
  [[nodiscard]] ArrayShape unit() const override {
    ArrayShape unit = parts_.front()->unit();
    unit.insert(unit.begin(), first_axes_, 1);
    return unit;
  }
  [[nodiscard]] bool is_sequential() const override { return parts_.front()->is_sequential(); }

 private:
  void read_block(const ArrayShape& start, const ArrayShape& count,
                  std::uint8_t* out) const override {
    const auto split = static_cast<std::ptrdiff_t>(first_axes_);
    const ArrayShape part_start(start.begin() + split, start.end());
    const ArrayShape part_count(count.begin() + split, count.end());
    const std::size_t bytes = element_count(part_count) * byte_size(type());
    const bool is_grid = first_axes_ == 2;
    for (std::size_t i = start[0]; i < start[0] + count[0]; ++i) {
      for (std::size_t k = 0; k < (is_grid ? count[1] : 1); ++k, out += bytes) {
        const std::size_t part = is_grid ? i * shape()[1] + start[1] + k : i;
        parts_[part]->read_raw(part_start, part_count, out);
      }
    }
  }

  std::size_t first_axes_;
  std::vector<std::unique_ptr<ArrayInput>> parts_;
};

void join_arrays(std::vector<ArrayEntry>& entries) {
  join_channels(entries);
  join_views(entries);
}

}  // namespace

std::optional<ArrayEntry> joined_cells(const std::string& name,
                                       const std::vector<ArrayEntry>& cells,
                                       const ArrayShape& grid) {
  if (cells.size() < kFewestJoined || cells.size() != element_count(grid)) return std::nullopt;
  const bool are_views = std::ranges::all_of(cells, [&](const ArrayEntry& cell) {
    return can_be_view(cell) && is_same_kind(cell, cells.front());
  });
  if (!are_views) return std::nullopt;
  ArrayEntry whole = cells.front();
  whole.name = name;
  whole.stated_axes.clear();
  for (const ArrayEntry& cell : cells) whole.parts.push_back(cell.name);
  const bool is_list = grid[0] == 1 || grid[1] == 1;
  whole.leading = is_list ? "n" : "uv";
  if (is_list) {
    whole.shape.insert(whole.shape.begin(), cells.size());
  } else {
    whole.shape.insert(whole.shape.begin(), grid.begin(), grid.end());
  }
  return whole;
}

std::unique_ptr<ArrayInput> stacked(const std::filesystem::path& path, const ArrayEntry& entry,
                                    std::vector<std::unique_ptr<ArrayInput>> parts) {
  return std::make_unique<StackedArray>(path, entry, std::move(parts));
}

std::string joined_axes(const ArrayEntry& entry) {
  ArrayShape part(entry.shape.begin() + static_cast<std::ptrdiff_t>(entry.leading.size()),
                  entry.shape.end());
  part = in_index_order(part, entry.order);
  const std::string axes = part.size() == 2 ? "yx" : is_channels(part.back()) ? "yxc" : "cyx";
  return entry.leading + in_index_order(axes, entry.order);
}

namespace {

/// What deflate reaches at most.
constexpr std::size_t kDensestDeflated = 1032;
/// Light fields and maps are far from it, but for small or empty ones.
constexpr std::size_t kDense = 200;
constexpr std::size_t kSmallArray = std::size_t{64} << 20;

}  // namespace

std::string last_name(const std::string& name) {
  return name.substr(name.rfind('/') + 1);
}

std::string telling_name(const ArrayEntry& entry) {
  if (!entry.told.empty()) return entry.told;
  return entry.is_of_views() ? entry.name : last_name(entry.name);
}

std::string content_text(const ArrayEntry& entry) {
  if (!entry.other_kind.empty()) return entry.other_kind;
  return shape_text(in_index_order(entry.shape, entry.order));
}

void ArrayFile::join_parts() {
  join_arrays(entries_);
}

std::unique_ptr<ArrayInput> ArrayFile::open(const ArrayEntry& entry) const {
  if (entry.parts.empty()) return open_stored(entry);
  ArrayEntry part = entry;
  part.parts.clear();
  part.shape.erase(part.shape.begin(),
                   part.shape.begin() + static_cast<std::ptrdiff_t>(entry.leading.size()));
  std::vector<std::unique_ptr<ArrayInput>> parts;
  for (const std::string& name : entry.parts) {
    part.name = name;
    parts.push_back(open_stored(part));
  }
  return stacked(path_, entry, std::move(parts));
}

void require_plausible_size(const std::filesystem::path& path, const ArrayShape& shape,
                            NumberType type, std::uint64_t bytes) {
  const std::size_t count = element_count(shape);
  const std::size_t width = byte_size(type);
  const std::size_t allowed =
      bytes * (count / kSmallArray * width > 0 ? kDense : kDensestDeflated) / width;
  if (count <= allowed) return;
  throw IoError(path, fmt::format("an array of {} {} samples is claimed by {} bytes, which cannot "
                                  "hold it; the file is damaged or made to harm: choose another",
                                  shape_text(shape), number_name(type), bytes));
}

namespace {

NumberType number_type(Hdf5Type type) {
  switch (type) {
    case Hdf5Type::UInt8:
      return NumberType::UInt8;
    case Hdf5Type::UInt16:
      return NumberType::UInt16;
    case Hdf5Type::Integer:
      return NumberType::Int32;
    default:
      return NumberType::Float32;
  }
}

ArrayEntry describe(const Hdf5Input& file, const Hdf5Dataset& dataset, bool is_matlab) {
  ArrayEntry entry;
  entry.name = dataset.name;
  entry.order = is_matlab ? IndexOrder::Fortran : IndexOrder::C;
  const auto matlab_class = file.text(dataset.name, "MATLAB_class");
  if (dataset.type == Hdf5Type::Other || matlab_class == "char" || matlab_class == "cell") {
    entry.other_kind = matlab_class == "char"   ? "text"
                       : matlab_class == "cell" ? "cell array"
                                                : "dataset that " + file.fault_of(dataset.name);
    return entry;
  }
  if (!file.fault_of(dataset.name).empty()) {
    entry.other_kind = finding_text("dataset.null");
    return entry;
  }
  entry.shape = dataset.shape;
  entry.type = number_type(dataset.type);
  // The attribute names axes in the order of HDF5.
  entry.stated_axes = in_index_order(file.text(dataset.name, "axes").value_or(""), entry.order);
  return entry;
}

/// One dataset, read by blocks.
class Hdf5Array : public ArrayInput {
 public:
  Hdf5Array(std::shared_ptr<const Hdf5Input> file, const ArrayEntry& entry)
      : ArrayInput(file->path(), entry.shape, entry.type),
        file_(std::move(file)),
        name_(entry.name),
        chunk_(file_->dataset(name_).chunk) {}
  [[nodiscard]] ArrayShape unit() const override {
    return chunk_.empty() ? ArrayInput::unit() : chunk_;
  }

 private:
  void read_block(const ArrayShape& start, const ArrayShape& count,
                  std::uint8_t* out) const override {
    const Hdf5Block block{start, count};
    switch (type()) {
      case NumberType::UInt8:
        return file_->read(name_, block, out);
      case NumberType::UInt16:
        return file_->read(name_, block, reinterpret_cast<std::uint16_t*>(out));
      case NumberType::Int32:
        return file_->read(name_, block, reinterpret_cast<std::int32_t*>(out));
      default:
        return file_->read(name_, block, reinterpret_cast<float*>(out));
    }
  }

  std::shared_ptr<const Hdf5Input> file_;
  std::string name_;
  ArrayShape chunk_;
};

}  // namespace

bool is_matlab_hdf5(const Hdf5Input& file) {
  std::ifstream in(file.path(), std::ios::binary);
  std::string begin(10, '\0');
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  if (begin == "MATLAB 7.3") return true;
  return std::ranges::any_of(file.datasets(), [&](const Hdf5Dataset& dataset) {
    return file.has_attribute(dataset.name, "MATLAB_class");
  });
}

Hdf5Arrays::Hdf5Arrays(std::shared_ptr<const Hdf5Input> file)
    : ArrayFile(file->path(), is_matlab_hdf5(*file) ? "MATLAB 7.3 file" : kPlainForm),
      file_(std::move(file)) {
  const std::vector<Hdf5Dataset> datasets = file_->datasets();
  for (const Hdf5Dataset& dataset : datasets) {
    // The contents of MATLAB's cells and tables lie in groups of this name.
    if (dataset.name.starts_with('#') || add_cells(dataset, datasets)) continue;
    add(describe(*file_, dataset, is_matlab()));
  }
  join_parts();
}

bool Hdf5Arrays::add_cells(const Hdf5Dataset& dataset, const std::vector<Hdf5Dataset>& datasets) {
  if (dataset.shape.size() != 2) return false;
  std::vector<ArrayEntry> cells;
  for (const std::string& name : file_->referenced(dataset.name)) {
    const auto cell = std::ranges::find(datasets, name, &Hdf5Dataset::name);
    if (cell == datasets.end()) return false;
    cells.push_back(describe(*file_, *cell, is_matlab()));
  }
  auto whole = joined_cells(dataset.name, cells, dataset.shape);
  if (whole) add(std::move(*whole));
  return whole.has_value();
}

std::optional<Provenance> Hdf5Arrays::estimated(const std::string& map) const {
  return estimated_in(*file_, map);
}

std::unique_ptr<ArrayInput> Hdf5Arrays::open_stored(const ArrayEntry& entry) const {
  require_plausible_size(path(), entry.shape, entry.type, fs::file_size(path()));
  return std::make_unique<Hdf5Array>(file_, entry);
}

}  // namespace episcope::io
