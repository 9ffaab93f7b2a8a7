// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/sidecar_maps/map_sets.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/parallel.h"
#include "engine/core/text.h"
#include "engine/io/base/exchange_files.h"
#include "engine/io/base/files.h"
#include "engine/io/models/external_result.h"
#include "engine/io/models/map_padding.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <tuple>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

/// Sets are not mixed with regard to suffixes: these are part of their pattern.
fs::path first_file(const MapSet& set) {
  if (!set.entries.empty()) return set.entries.front().file;
  return set.strays.empty() ? set.of_left_out.front() : set.strays.front();
}

}  // namespace

int SidecarViews::height() const {
  return std::visit([](const auto& stack) { return stack.height(); }, samples);
}

int SidecarViews::width() const {
  return std::visit([](const auto& stack) { return stack.width(); }, samples);
}

void SetOutcome::tell(const std::string& kind, const SidecarNotes& notes) const {
  notes.account.use(read, kind);
  if (!note.empty() && !read.empty()) notes.report.warnings.push_back(note);
  if (failed.empty()) return;
  notes.account.leave_out(failed, kind + " that are damaged or do not fit");
  notes.report.warnings.push_back(fmt::format(finding_text("map.damaged"), failed.size(),
                                              read.size() + failed.size(), kind, first_error));
}

namespace {

bool is_on_its_side(int height, int width, const SidecarViews& views) {
  return height != width && height == views.width() && width == views.height();
}

}  // namespace

void require_view_size(const fs::path& path, int height, int width, const SidecarViews& views) {
  if (height == views.height() && width == views.width()) return;
  const char* remedy = "";
  if (is_on_its_side(height, width, views)) {
    remedy = "rows and columns are exchanged: transpose, ";
  } else if (height >= views.height() && width >= views.width()) {
    remedy =
        "if it is padded, cut it by episcope-cli convert --map-crop corner --truth LIGHT_FIELD, "
        "else ";
  }
  throw IoError(path, fmt::format("this map has {}×{} px, but the views have {}×{} px; {}remove or "
                                  "replace it",
                                  width, height, views.width(), views.height(), remedy));
}

std::vector<MapSet::Entry> entries_to_read(const MapSet& set, const SidecarViews& views) {
  if (views.map_views == MapViews::All || set.entries.size() < 2) return set.entries;
  const auto center = std::ranges::find(set.entries, views.center(), &MapSet::Entry::view);
  return {center == set.entries.end() ? set.entries.front() : *center};
}

RankedSets rank_sets(const std::vector<MapSet>& sets, MapKind kind,
                     bool (*can_hold)(const fs::path&)) {
  RankedSets ranked;
  for (const MapSet& set : sets) {
    if (set.kind != kind) continue;
    const bool is_fit = !set.entries.empty() && can_hold(first_file(set));
    (is_fit ? ranked.fit : ranked.unfit).push_back(&set);
  }
  std::ranges::stable_sort(ranked.fit, [](const MapSet* a, const MapSet* b) {
    const auto rank = [](const MapSet* set) {
      const fs::path file = first_file(*set);
      return std::tuple(set->claim, -static_cast<int>(set->entries.size()), is_image_name(file),
                        has_text_suffix(file));
    };
    return rank(a) < rank(b);
  });
  return ranked;
}

void tell_equal_names(const MapSet& used, const MapSet& other, ConventionReport& report) {
  const auto stem = [](const MapSet& set) { return fs::path(set.pattern).stem(); };
  if (used.claim != other.claim || stem(used) == stem(other)) return;  // or in another form
  report.warnings.push_back(
      fmt::format(finding_text("map.equal_names"), used.pattern, other.pattern));
}

namespace {

/// Where the maps of a set go: views of the whole grid, or the only one.
struct SetPlace {
  GridShape grid;
  ViewIndex first;
};

SetPlace place_of(const std::vector<MapSet::Entry>& entries, GridShape grid) {
  if (entries.size() != 1) return {grid, {}};
  return {{1, 1}, grid.view_at(entries.front().view)};
}

/// Runs `read(entry)` for all, and notes which of them threw an IoError.
template <class Read>
SetOutcome try_all(const std::vector<MapSet::Entry>& entries, const Progress& progress,
                   const Read& read) {
  std::vector<std::string> errors(entries.size());
  parallel_for(static_cast<int>(entries.size()), progress, [&](int i) {
    const auto place = static_cast<std::size_t>(i);
    try {
      read(entries[place]);
    } catch (const IoError& error) {
      errors[place] = error.what();
    }
  });
  SetOutcome outcome;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    (errors[i].empty() ? outcome.read : outcome.failed).push_back(entries[i].file);
    if (outcome.first_error.empty()) outcome.first_error = errors[i];
  }
  return outcome;
}

/// Files that are not read because the center view suffices count as read.
void add_unread(const MapSet& set, std::size_t tried, SetOutcome& outcome) {
  if (tried == set.entries.size() || outcome.read.empty()) return;
  outcome.read = set.files();
}

template <class T>
void require_one_map(const std::filesystem::path& file, const ViewStack<T>& stack,
                     const SidecarViews& views) {
  require_view_size(file, stack.height(), stack.width(), views);
  if (stack.grid() == GridShape{1, 1}) return;
  throw IoError(file, "this file holds maps of several views, but its name is that of one view");
}

/// Brings maps of several times, or a part of, the size of the views to that size; else exchanges
/// rows and columns, cuts off a padding, or puts maps that lack a border into the middle, where
/// that is evident.
ResampledMaps fit_into_views(DisparityField& maps, const SidecarViews& views) {
  if (is_on_its_side(maps.disparity.height(), maps.disparity.width(), views)) {
    maps = turned_back(maps, {.is_transposed = true});
    return {1, fmt::format(finding_text("map.exchanged"), "The maps", views.height(), views.width(),
                           views.width(), views.height())};
  }
  ResampledMaps resampled = resample_to(maps, views.height(), views.width());
  if (resampled.scale != 1) return resampled;
  const ViewStack<float>& map = maps.disparity;
  if (map.height() < views.height() && map.width() < views.width()) {
    return {1, find_bare_border(maps, views.height(), views.width()).note};
  }
  return {1, remove_padding(maps, views.height(), views.width())};
}

bool holds_all_views(GridShape stored, const SidecarViews& views) {
  return stored == views.files.whole_grid() && stored.count() > 1;
}

/// The maps of the views that are opened, where others are missing.
template <class T>
ViewStack<T> opened_part(ViewStack<T> all, const SidecarViews& views) {
  if (!views.files.part) return all;
  ViewStack<T> part(views.grid(), all.height(), all.width(), 1);
  for (int i = 0; i < views.grid().count(); ++i) {
    const ViewIndex view = views.grid().view_at(i);
    std::copy_n(all.view(views.files.in_whole(view)).data, all.view_size(), part.view(view).data);
  }
  return part;
}

/// Takes the wanted maps of the whole grid; only the map of the center view if no others are
/// wanted.
template <class T>
ViewStack<T> wanted_part(ViewStack<T> whole, const SidecarViews& views) {
  ViewStack<T> all = opened_part(std::move(whole), views);
  if (views.map_views == MapViews::All) return all;
  const ViewIndex center = views.grid().center();
  ViewStack<T> one({1, 1}, all.height(), all.width(), 1, center);
  std::copy_n(all.view(center).data, all.view_size(), one.data());
  return one;
}

/// A file that holds maps of all views; empty if it holds another number.
std::optional<DisparityField> read_whole(const MapSet& set, const SidecarViews& views,
                                         ResampledMaps& fitted) {
  DisparityField all = read_values(set.entries.front().file, views.files.whole_grid());
  fitted = fit_into_views(all, views);
  require_view_size(set.entries.front().file, all.disparity.height(), all.disparity.width(), views);
  if (!holds_all_views(all.disparity.grid(), views)) return std::nullopt;
  DisparityField field{wanted_part(std::move(all.disparity), views), {}};
  if (!all.valid.empty()) field.valid = wanted_part(std::move(all.valid), views);
  return field;
}

}  // namespace

void tidy_valid(DisparityField& field) {
  mark_invalid(field);
  const ViewStack<std::uint8_t>& valid = field.valid;
  if (valid.empty()) return;
  const bool is_whole = std::all_of(valid.data(), valid.data() + valid.size(),
                                    [](std::uint8_t value) { return value != 0; });
  if (is_whole) field.valid = {};
}

DisparityField read_value_set(const MapSet& set, const SidecarViews& views, SetOutcome& outcome,
                              const Progress& progress) {
  const std::vector<MapSet::Entry> entries = entries_to_read(set, views);
  DisparityField field;
  if (set.entries.size() == 1) {
    ResampledMaps fitted;
    outcome = try_all(entries, Progress(1), [&](const MapSet::Entry&) {
      if (auto all = read_whole(set, views, fitted)) field = std::move(*all);
    });
    outcome.take(fitted);
    if (!field.empty() || outcome.read.empty()) {
      tidy_valid(field);
      return field;
    }
  }
  const SetPlace place = place_of(entries, views.grid());
  field = DisparityField::unknown(place.grid, views.height(), views.width(), place.first);
  std::vector<ResampledMaps> fitted(entries.size());
  outcome = try_all(entries, progress, [&](const MapSet::Entry& entry) {
    DisparityField one = read_values(entry.file, views.grid());
    fitted[static_cast<std::size_t>(&entry - entries.data())] = fit_into_views(one, views);
    require_one_map(entry.file, one.disparity, views);
    const ViewIndex view = views.grid().view_at(entry.view);
    std::copy_n(one.disparity.data(), one.disparity.size(), field.disparity.view(view).data);
    std::uint8_t* valid = field.valid.view(view).data;
    if (one.valid.empty()) {
      std::fill_n(valid, field.valid.view_size(), std::uint8_t{1});
    } else {
      std::copy_n(one.valid.data(), one.valid.size(), valid);
    }
  });
  outcome.take(fitted.front());
  add_unread(set, entries.size(), outcome);
  if (outcome.read.empty()) return {};
  tidy_valid(field);
  return field;
}

LabelMaps read_label_set(const MapSet& set, const SidecarViews& views, SetOutcome& outcome,
                         const Progress& progress) {
  const std::vector<MapSet::Entry> entries = entries_to_read(set, views);
  LabelMaps maps;
  if (set.entries.size() == 1) {
    outcome = try_all(entries, Progress(1), [&](const MapSet::Entry& entry) {
      StoredLabels all = read_stored_labels(entry.file, views.files.whole_grid());
      require_view_size(entry.file, all.numbers.height(), all.numbers.width(), views);
      if (!holds_all_views(all.numbers.grid(), views)) return;
      maps = {wanted_part(std::move(all.numbers), views), all.are_colors};
    });
    if (!maps.numbers.empty() || outcome.read.empty()) return maps;
  }
  const SetPlace place = place_of(entries, views.grid());
  maps.numbers = ViewStack<std::int32_t>(place.grid, views.height(), views.width(), 1, place.first);
  std::fill_n(maps.numbers.data(), maps.numbers.size(), kNoMap);
  std::atomic<bool> has_colors = false;
  std::vector<std::uint8_t> are_levels(static_cast<std::size_t>(views.grid().count()), 0);
  outcome = try_all(entries, progress, [&](const MapSet::Entry& entry) {
    const StoredLabels one = read_stored_labels(entry.file, views.grid());
    require_one_map(entry.file, one.numbers, views);
    std::copy_n(one.numbers.data(), one.numbers.size(),
                maps.numbers.view(views.grid().view_at(entry.view)).data);
    if (one.are_colors) has_colors = true;
    if (!one.are_colors) are_levels[static_cast<std::size_t>(entry.view)] = 1;
  });
  add_unread(set, entries.size(), outcome);
  if (outcome.read.empty()) return {};
  maps.are_colors = has_colors;
  // Among pictures in colors, one that happens to be grey has levels of grey for colors.
  for (const MapSet::Entry& entry : entries) {
    if (!maps.are_colors || are_levels[static_cast<std::size_t>(entry.view)] == 0) continue;
    std::int32_t* numbers = maps.numbers.view(views.grid().view_at(entry.view)).data;
    std::for_each(numbers, numbers + maps.numbers.view_size(),
                  [](std::int32_t& number) { number *= 0x010101; });
  }
  return maps;
}

}  // namespace episcope::io
