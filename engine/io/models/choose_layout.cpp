// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/choose_layout.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/text.h"
#include "engine/io/models/order/list_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>

namespace episcope::io {
namespace {

constexpr double kMostPixelsSeen = 16e6;  ///< That are looked at, of all views.
constexpr int kLargestWindow = 256;

ListLayout look_at(const ArrayInput& array, const ArrayLayout& list) {
  const int count = list.grid().count();
  std::vector<ViewIndex> views;
  for (int i = 0; i < count; ++i) views.push_back({0, i});
  const int side = std::min(kLargestWindow, static_cast<int>(std::sqrt(kMostPixelsSeen / count)));
  const std::vector<Image<float>> windows = array_windows(array, list, views, side);
  return find_list_layout(
      count, [&](int i) { return windows[static_cast<std::size_t>(i)]; }, Progress());
}

/// Of several lists of views that an array of three axes can be, the one whose pictures lie on a
/// grid, as views do (find_list_layout) and slices across views do not; or else along a line, of
/// fewer views than they have rows and columns, since slices of any volume are much like a line.
/// Nothing if none of them does, or several. Throws IoError.
std::optional<ArrayLayout> list_by_motion(const ArrayFile& file, const ArrayEntry& entry,
                                          const std::vector<ArrayLayout>& layouts) {
  const bool are_lists =
      std::ranges::all_of(layouts, [](const ArrayLayout& each) { return each.has('n'); });
  if (!are_lists) return std::nullopt;
  const std::unique_ptr<ArrayInput> array = file.open(entry);
  std::vector<ArrayLayout> grids;
  std::vector<ArrayLayout> lines;
  for (const ArrayLayout& layout : layouts) {
    const ListLayout found = look_at(*array, layout);
    if (!found.is_decided) continue;
    if (found.grid.v > 1 && found.grid.u > 1) {
      grids.push_back(layout);
    } else if (layout.grid().count() < std::min(layout.height(), layout.width())) {
      lines.push_back(layout);
    }
  }
  const std::vector<ArrayLayout>& best = grids.empty() ? lines : grids;
  return best.size() == 1 ? std::optional(best.front()) : std::nullopt;
}

std::size_t letter_count(const std::string& axes) {
  return static_cast<std::size_t>(std::ranges::count_if(
      axes, [](char letter) { return std::isalpha(static_cast<unsigned char>(letter)) != 0; }));
}

std::string entry_text(const ArrayEntry& entry) {
  return entry.name + ", " + content_text(entry);
}

/// "rows of views, columns of views, rows, columns, channels".
std::string axes_text(const std::string& letters) {
  static const std::map<char, std::string> texts{{'v', "rows of views"},
                                                 {'u', "columns of views"},
                                                 {'y', "rows of pixels"},
                                                 {'x', "columns of pixels"},
                                                 {'c', "channels"}};
  return joined(letters, ", ", [](char letter) {
    const auto found = texts.find(letter);
    return found == texts.end() ? std::string("a list of views") : found->second;
  });
}

const ArrayEntry& named_entry(const ArrayFile& file, const std::string& name) {
  for (const ArrayEntry& entry : file.entries()) {
    if (entry.name == name && entry.other_kind.empty()) return entry;
  }
  throw InvalidInput(fmt::format(
      "{}: there is no array {} in this file, which holds {}; name one of them with --dataset",
      file.path().string(), name.substr(0, 80),
      file.entries().empty() ? "none" : joined(file.entries(), "; ", entry_text)));
}

/// What the shape of an array, and its parts, allow it to be.
std::vector<ArrayLayout> layouts_of(const ArrayEntry& entry) {
  if (entry.is_of_views()) return {{entry.shape, joined_axes(entry)}};
  std::vector<ArrayLayout> layouts = possible_layouts(entry.shape, entry.order);
  std::erase_if(layouts,
                [&](const ArrayLayout& layout) { return !layout.axes.starts_with(entry.leading); });
  return layouts;
}

/// Of several meanings of a shape the only one in which both axes of the grid show motion: channels
/// differ in color, not in place. Nothing if there is none or several.
std::optional<ArrayLayout> layout_with_motion(const ArrayFile& file, const ArrayEntry& entry,
                                              const std::vector<ArrayLayout>& layouts) {
  const bool are_grids = std::ranges::all_of(layouts, [](const ArrayLayout& layout) {
    return layout.grid().v > 1 && layout.grid().u > 1;
  });
  if (!are_grids) return std::nullopt;
  const std::unique_ptr<ArrayInput> array = file.open(entry);
  std::optional<ArrayLayout> found;
  for (const ArrayLayout& layout : layouts) {
    const ViewAxes axes = measure_parallax(*array, layout);
    const AxisEvidence &u = axes.along_u, &v = axes.along_v;
    const bool moves = (u.is_x() && v.is_y()) || (u.is_y() && v.is_x());
    if (!moves) continue;
    if (found) return std::nullopt;
    found = layout;
  }
  return found;
}

/// Of a grid of grey views and a list of colored ones, whose channels are the rows or columns of
/// that grid: the grid if there is motion along both of its axes, the list if there is motion along
/// the other one alone. Nothing if that does not tell.
std::optional<ArrayLayout> grid_or_list(const ArrayFile& file, const ArrayEntry& entry,
                                        const std::vector<ArrayLayout>& layouts) {
  if (layouts.size() != 2) return std::nullopt;
  const bool is_list_first = layouts[0].has('n');
  const ArrayLayout& list = layouts[is_list_first ? 0 : 1];
  const ArrayLayout& grid = layouts[is_list_first ? 1 : 0];
  const std::size_t channels = list.axes.find('c');
  const bool is_grey = grid.length('c') == 1;
  if (!list.has('n') || grid.has('n') || !is_grey || channels == std::string::npos) {
    return std::nullopt;
  }
  const char letter = grid.axes[channels];
  if (letter != 'v' && letter != 'u') return std::nullopt;
  const ViewAxes axes = measure_parallax(*file.open(entry), grid);
  const AxisEvidence& of_channels = letter == 'v' ? axes.along_v : axes.along_u;
  const AxisEvidence& of_views = letter == 'v' ? axes.along_u : axes.along_v;
  if (!of_views.is_decided()) return std::nullopt;
  if (of_channels.is_decided()) return grid;
  return are_rather_channels(of_channels, of_views) ? std::optional(list) : std::nullopt;
}

}  // namespace

bool can_be_light_field(const ArrayEntry& entry) {
  if (!entry.other_kind.empty()) return false;
  if (!entry.stated_axes.empty() && entry.shape.size() > 3) return true;
  return !layouts_of(entry).empty();
}

bool has_light_field_name(const ArrayEntry& entry) {
  constexpr const char* kNames[] = {"lf",    "lightfield", "light_field", "light-field", "lf_rgb",
                                    "views", "lf_data",    "lfs",         "lightfields"};
  return std::ranges::find(kNames, lower_case(last_name(entry.name))) != std::end(kNames);
}

bool has_other_name(const ArrayEntry& entry) {
  const std::string name = lower_case(telling_name(entry));
  constexpr const char* kWords[] = {"disp", "depth", "label", "mask", "valid", "seg", "gt", "conf"};
  return std::ranges::any_of(
      kWords, [&](const char* word) { return name.find(word) != std::string::npos; });
}

/// Whether the array is named like a map, beside another that is not and holds as many numbers,
/// which is rather the light field.
bool is_beside_more(const ArrayEntry& map, const ArrayFile& file) {
  return has_other_name(map) && std::ranges::any_of(file.entries(), [&](const ArrayEntry& other) {
           return other.other_kind.empty() && !has_other_name(other) && other.shape.size() > 2 &&
                  element_count(other.shape) >= element_count(map.shape);
         });
}

std::vector<const ArrayEntry*> light_fields_of(const ArrayFile& file, const std::string& axes) {
  std::vector<const ArrayEntry*> possible;
  for (const ArrayEntry& entry : file.entries()) {
    const bool has_axes = entry.other_kind.empty() && entry.shape.size() == letter_count(axes);
    if (axes.empty() ? can_be_light_field(entry) : has_axes) possible.push_back(&entry);
  }
  if (axes.empty() && possible.size() == 1 && is_beside_more(*possible.front(), file)) return {};
  if (possible.size() <= 1) return possible;
  using Claim = std::function<bool(const ArrayEntry*)>;
  const Claim has_name = [](const ArrayEntry* entry) { return has_light_field_name(*entry); };
  const Claim has_five = [](const ArrayEntry* entry) { return entry->shape.size() >= 5; };
  const Claim is_no_map = [](const ArrayEntry* entry) { return !has_other_name(*entry); };
  const Claim is_likely = [&](const ArrayEntry* entry) {
    return has_five(entry) && is_no_map(entry);
  };
  std::vector<const ArrayEntry*> several;
  for (const Claim& is_meant : {has_name, is_likely, has_five, is_no_map}) {
    std::vector<const ArrayEntry*> meant;
    std::ranges::copy_if(possible, std::back_inserter(meant), is_meant);
    if (meant.size() == 1) return meant;
    if (several.empty()) several = std::move(meant);
  }
  return several.empty() ? possible : several;
}

const ArrayEntry* find_light_field(const ArrayFile& file, const std::string& dataset,
                                   const std::string& axes) {
  if (!dataset.empty()) return &named_entry(file, dataset);
  const std::vector<const ArrayEntry*> fields = light_fields_of(file, axes);
  if (fields.size() <= 1) return fields.empty() ? nullptr : fields.front();
  std::vector<ReadingChoice> choices;
  for (const ArrayEntry* entry : fields) choices.push_back({entry->name, entry_text(*entry)});
  throw Undecided(file.path(), "several arrays of this file can be the light field", "dataset",
                  std::move(choices));
}

ChosenLayout choose_layout(const ArrayFile& file, const ArrayEntry& entry,
                           const std::string& axes) {
  if (!axes.empty()) {
    return {stated_layout(file.path(), entry.shape, axes, entry.order), "as chosen", {}};
  }
  if (!entry.stated_axes.empty()) {
    return {stated_layout(file.path(), entry.shape, entry.stated_axes, entry.order),
            "as the file states",
            {}};
  }
  const auto layouts = layouts_of(entry);
  if (layouts.size() == 1) return {layouts.front(), "by shape", {}};
  const std::string shape = shape_text(in_index_order(entry.shape, entry.order));
  if (layouts.empty()) {
    throw IoError(file.path(),
                  fmt::format("the array {} has the shape {}, which is not that of a light field; "
                              "if it is one, state its axes, as in --axes vuyxc",
                              entry.name, shape));
  }
  if (auto layout = layout_with_motion(file, entry, layouts)) {
    return {std::move(*layout), "by shape and motion between views", {}};
  }
  if (auto layout = grid_or_list(file, entry, layouts)) {
    return {std::move(*layout), "by shape and motion between views, not between channels", {}};
  }
  if (auto layout = list_by_motion(file, entry, layouts)) {
    return {std::move(*layout), "by shape and the likeness of views", {}};
  }
  std::vector<ReadingChoice> choices;
  for (const ArrayLayout& layout : layouts) {
    const std::string letters = in_index_order(layout.axes, entry.order);
    choices.push_back({letters, axes_text(letters)});
  }
  throw Undecided(file.path(),
                  fmt::format("the array {} has the shape {}, which can mean several things",
                              entry.name, shape),
                  "axes", std::move(choices));
}

void check_layout(const ArrayInput& array, IndexOrder order, ChosenLayout& chosen,
                  const Progress& progress) {
  if (!chosen.reason.starts_with("by shape") || chosen.layout.has('n')) return;
  progress.step("telling rows from columns of views");
  const ViewAxes axes = measure_parallax(array, chosen.layout);
  if (axes.are_straight()) {
    chosen.reason += fmt::format("; parallax agrees ({:.1f} σ)", axes.score());
  } else if (axes.are_crossed()) {
    chosen.layout = chosen.layout.crossed();
    chosen.reason +=
        fmt::format("; rows and columns of views by parallax ({:.1f} σ)", -axes.score());
  } else {
    chosen.reason += "; parallax does not tell rows from columns of views";
    chosen.warning = fmt::format(finding_text("views.axes_unclear"),
                                 in_index_order(chosen.layout.crossed().axes, order));
  }
}

namespace {

constexpr int kParallaxWindow = 256;

double gone(const AxisEvidence& evidence) {
  return std::max(evidence.gone_along_x(), evidence.gone_along_y());
}

}  // namespace

ViewAxes measure_parallax(const ArrayInput& array, const ArrayLayout& layout) {
  const GridShape grid = layout.grid();
  const ViewIndex center = grid.center();
  std::vector<ViewIndex> views{center};
  if (grid.u > 1) views.push_back({center.v, center.u - 1});
  if (grid.v > 1) views.push_back({center.v - 1, center.u});
  const std::vector<Image<float>> windows = array_windows(array, layout, views, kParallaxWindow);
  const MotionPictures middle(windows.front());
  ViewAxes parallax;
  for (std::size_t i = 1; i < views.size(); ++i) {
    AxisEvidence& axis = views[i].u == center.u ? parallax.along_v : parallax.along_u;
    axis.add(MotionPictures(windows[i]), middle);
  }
  return parallax;
}

bool are_rather_channels(const AxisEvidence& of_channels, const AxisEvidence& of_views) {
  constexpr double kClearlyLess = 0.5;
  return of_views.is_decided() && !of_channels.is_decided() &&
         gone(of_channels) < kClearlyLess * gone(of_views);
}

}  // namespace episcope::io
