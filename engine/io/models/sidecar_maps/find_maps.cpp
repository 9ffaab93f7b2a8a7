// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/sidecar_maps/find_maps.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/parallel.h"
#include "engine/core/text.h"
#include "engine/io/base/exchange_files.h"
#include "engine/io/base/files.h"
#include "engine/io/models/external_result.h"
#include "engine/io/models/map_padding.h"
#include "engine/io/models/names/view_folders.h"
#include "engine/io/models/order/order_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 200'000;
constexpr int kLeftOut = -1;  ///< Instead of the number of a view that is not opened.

/// One or two numbers that vary among names: a count, or a row and a column.
using Key = std::vector<long>;

bool has_map_suffix(const fs::path& path) {
  constexpr std::array<std::string_view, 15> suffixes{".npy",  ".npz", ".pfm", ".png",  ".tif",
                                                      ".tiff", ".exr", ".bmp", ".pgm",  ".jpg",
                                                      ".jpeg", ".mat", ".h5",  ".hdf5", ".gif"};
  return std::ranges::find(suffixes, suffix_of(path)) != suffixes.end();
}

std::vector<fs::path> list_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const bool is_hidden = it->path().filename().string().starts_with('.');
    std::error_code ignored;
    const bool may_be_map = has_map_suffix(it->path()) || has_text_suffix(it->path());
    if (is_hidden || !it->is_regular_file(ignored) || !may_be_map) continue;
    files.push_back(it->path());
    if (files.size() == kMostFiles) break;
  }
  std::ranges::sort(files);
  return files;
}

std::vector<fs::path> map_folders_in(const fs::path& folder) {
  std::vector<fs::path> folders;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code ignored;
    // Links are not followed: they may lead around in circles.
    if (it->is_symlink(ignored) || !it->is_directory(ignored)) continue;
    if (is_map_folder(it->path().filename().string())) folders.push_back(it->path());
  }
  std::ranges::sort(folders);
  return folders;
}

/// Whether the folder holds only the pictures of a scene, whose other files lie beside it.
bool is_inner_folder(const fs::path& folder) {
  constexpr std::array<std::string_view, 12> names{"lf",    "views", "images", "rectified",
                                                   "image", "rgb",   "color",  "input",
                                                   "sai",   "sais",  "png",    "subaperture"};
  const std::string name = numbered_name(folder.filename().string()).text;
  return std::ranges::find(names, name) != names.end() ||
         only_grid_inside(folder.parent_path()) == folder;
}

/// Places of the first two numbers that vary.
std::vector<std::size_t> varying_places(const std::vector<NumberedName>& names) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < names.front().numbers.size() && places.size() < 2; ++i) {
    const bool varies = std::ranges::any_of(names, [&](const NumberedName& name) {
      return name.numbers[i] != names.front().numbers[i];
    });
    if (varies) places.push_back(i);
  }
  return places;
}

Key key_of(const NumberedName& name, const std::vector<std::size_t>& places) {
  Key key;
  for (const std::size_t place : places) key.push_back(name.numbers[place]);
  return key;
}

/// The numbers by which names of views tell them apart.
struct ViewKeys {
  std::map<Key, int> view_of;
  std::map<std::string, int> view_by_stem;
  std::size_t length = 0;  ///< 1 or 2; 0 if names do not tell.
  GridShape grid;
  std::optional<PartOfGrid> part;

  /// The number of a view that is counted in the whole grid; `kLeftOut` for one left out.
  [[nodiscard]] int number_of(ViewIndex view) const {
    const auto at = part ? part->in_part(view) : std::optional(view);
    return at ? at->v * grid.u + at->u : kLeftOut;
  }
};

ViewKeys keys_of_views(const ViewFiles& views) {
  ViewKeys keys;
  keys.grid = views.grid;
  keys.part = views.part;
  std::vector<NumberedName> names;
  std::vector<int> numbers;
  const auto add = [&](const fs::path& file, int number) {
    keys.view_by_stem[file.stem().string()] = number;
    names.push_back(numbered_name(file.filename().string()));
    numbers.push_back(number);
  };
  for (const fs::path& file : views.files) add(file, static_cast<int>(names.size()));
  for (const fs::path& file : views.left_out) add(file, kLeftOut);
  if (names.empty()) return keys;
  const bool is_alike = std::ranges::all_of(names, [&](const NumberedName& name) {
    return name.numbers.size() == names.front().numbers.size();
  });
  if (!is_alike) return keys;
  const std::vector<std::size_t> places = varying_places(names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    keys.view_of[key_of(names[i], places)] = numbers[i];
  }
  keys.length = keys.view_of.size() == names.size() ? places.size() : 0;
  return keys;
}

/// The smallest number of each place.
template <class Range, class Projection>
Key smallest(const Range& range, Projection key) {
  Key least;
  for (const auto& one : range) {
    const Key& k = key(one);
    if (least.empty()) least = k;
    for (std::size_t i = 0; i < k.size(); ++i) least[i] = std::min(least[i], k[i]);
  }
  return least;
}

struct KeyedFile {
  Key key;
  fs::path file;
};

/// Matches numbers with the numbers of the views, or from another first number on.
std::vector<MapSet::Entry> match_numbers(const std::vector<KeyedFile>& files,
                                         const ViewKeys& views) {
  const auto match = [&](const Key& shift) {
    std::vector<MapSet::Entry> entries;
    for (const KeyedFile& one : files) {
      Key key = one.key;
      for (std::size_t i = 0; i < key.size(); ++i) key[i] += shift[i];
      const auto found = views.view_of.find(key);
      if (found != views.view_of.end()) entries.push_back({found->second, one.file});
    }
    return entries;
  };
  std::vector<MapSet::Entry> entries = match(Key(views.length, 0));
  if (entries.size() == files.size()) return entries;
  Key shift = smallest(views.view_of, [](const auto& one) -> const Key& { return one.first; });
  const Key least = smallest(files, [](const KeyedFile& one) -> const Key& { return one.key; });
  for (std::size_t i = 0; i < shift.size(); ++i) shift[i] -= least[i];
  std::vector<MapSet::Entry> shifted = match(shift);
  const bool are_all = files.size() == views.view_of.size() || views.part;
  return are_all && shifted.size() > entries.size() ? shifted : entries;
}

/// Where views are counted and maps have rows and columns, or the other way round: all or none.
std::vector<MapSet::Entry> match_order(std::vector<KeyedFile> files, const ViewKeys& views) {
  const GridShape grid = views.part ? views.part->whole : views.grid;
  if (static_cast<int>(files.size()) != grid.count()) return {};
  std::ranges::sort(files, {}, &KeyedFile::key);
  std::set<long> rows;
  std::set<long> columns;
  for (const KeyedFile& one : files) {
    rows.insert(one.key.front());
    columns.insert(one.key.back());
  }
  const bool is_grid =
      static_cast<int>(rows.size()) == grid.v && static_cast<int>(columns.size()) == grid.u;
  if (files.front().key.size() == 2 && !is_grid) return {};
  std::vector<MapSet::Entry> entries;
  for (std::size_t i = 0; i < files.size(); ++i) {
    entries.push_back({views.number_of(grid.view_at(static_cast<int>(i))), files[i].file});
  }
  return entries;
}

/// "Cam005" of "input_Cam005"; the whole name where its last word is not one of letters and digits.
std::string telling_part(const std::string& name) {
  const auto is_other = [](char c) { return !is_letter(c) && !is_digit(c); };
  const auto begin = std::find_if(name.rbegin(), name.rend(), is_other).base();
  const bool tells = std::any_of(begin, name.end(), is_letter) && is_digit(name.back());
  return tells ? std::string(begin, name.end()) : name;
}

/// The view whose name, or whose telling part, the name of the map holds: 5_5 in "5_5_depth" and
/// "depth_5_5".
std::optional<int> view_in_name(const std::string& stem, const ViewKeys& views) {
  std::optional<int> found;
  for (const auto& [whole, view] : views.view_by_stem) {
    const std::string name = telling_part(whole);
    for (std::size_t at = stem.find(name); at != std::string::npos; at = stem.find(name, at + 1)) {
      const auto is_inside = [&](std::size_t i) { return i < stem.size() && is_digit(stem[i]); };
      if (is_inside(at + name.size()) || (at > 0 && is_inside(at - 1))) continue;
      if (found && *found != view) return std::nullopt;
      found = view;
    }
  }
  return found;
}

/// Of the whole grid.
int center_of(const ViewKeys& views) {
  return views.number_of(views.part ? views.part->whole.center() : views.grid.center());
}

void match_single(const fs::path& file, const ViewKeys& views, MapSet& set) {
  std::optional<int> view = view_in_name(file.stem().string(), views);
  const NumberedName name = numbered_name(file.stem().string());
  if (!view && views.length > 0 && name.numbers.size() == views.length) {
    const auto found = views.view_of.find(name.numbers);
    if (views.length == 2 && found != views.view_of.end()) view = found->second;
  }
  set.entries.push_back({view.value_or(center_of(views)), file});
}

void drop_left_out(MapSet& set) {
  for (MapSet::Entry& entry : set.entries) {
    if (entry.view == kLeftOut) set.of_left_out.push_back(entry.file);
  }
  std::erase_if(set.entries, [](const MapSet::Entry& entry) { return entry.view == kLeftOut; });
}

/// Two files of one view leave open which of them counts.
void drop_doubles(MapSet& set) {
  std::ranges::stable_sort(set.entries, {}, &MapSet::Entry::view);
  std::set<int> seen;
  std::vector<MapSet::Entry> kept;
  for (MapSet::Entry& entry : set.entries) {
    if (seen.insert(entry.view).second) {
      kept.push_back(std::move(entry));
    } else {
      set.strays.push_back(std::move(entry.file));
    }
  }
  set.entries = std::move(kept);
}

void match(const std::vector<fs::path>& files, const ViewKeys& views, MapSet& set) {
  if (files.size() == 1) {
    match_single(files.front(), views, set);
    return drop_left_out(set);
  }
  std::vector<NumberedName> names;
  for (const fs::path& file : files) names.push_back(numbered_name(file.filename().string()));
  const std::vector<std::size_t> places = varying_places(names);
  std::vector<KeyedFile> keyed;
  for (std::size_t i = 0; i < files.size(); ++i) {
    keyed.push_back({key_of(names[i], places), files[i]});
  }
  if (!places.empty() && places.size() == views.length) set.entries = match_numbers(keyed, views);
  if (set.entries.empty() && !places.empty()) set.entries = match_order(keyed, views);
  std::set<fs::path> matched;
  for (const MapSet::Entry& entry : set.entries) matched.insert(entry.file);
  for (const fs::path& file : files) {
    if (!matched.contains(file)) set.strays.push_back(file);
  }
  drop_left_out(set);
  drop_doubles(set);
}

/// A folder to look at, and what its own name says about its files.
struct MapPlace {
  fs::path folder;
  std::optional<MapKind> kind;
  std::string prefix = {};  ///< Of patterns: "disparity/".
};

std::vector<MapPlace> map_places(const fs::path& folder) {
  std::vector<MapPlace> places{{folder, std::nullopt}};
  const auto add_inside = [&](const fs::path& outer) {
    for (const fs::path& inner : map_folders_in(outer)) {
      if (fs::equivalent(inner, folder)) continue;
      const auto kind = map_kind(inner.filename().string());
      const std::string prefix = inner.filename().string() + "/";
      places.push_back({inner, kind, prefix});
      for (const fs::path& deep : map_folders_in(inner)) {
        const auto own = map_kind(deep.filename().string());
        places.push_back({deep, own ? own : kind, prefix + deep.filename().string() + "/"});
      }
    }
  };
  add_inside(folder);
  std::error_code error;
  const fs::path whole = fs::absolute(folder).lexically_normal();
  const fs::path clean = whole.has_filename() ? whole : whole.parent_path();
  if (is_inner_folder(clean)) {
    places.push_back({clean.parent_path(), std::nullopt});
    add_inside(clean.parent_path());
  } else if (fs::exists(folder / kBaselineFile, error)) {
    places.push_back({clean.parent_path(), std::nullopt});
  }
  return places;
}

/// By its own name, else by the name of its folder.
std::optional<MapKind> kind_of(const fs::path& file, std::optional<MapKind> of_folder) {
  constexpr std::array<std::string_view, 3> kTruth{"gt", "ground_truth", "groundtruth"};
  const std::string stem = file.stem().string();
  std::optional<MapKind> kind = map_kind(stem);
  if (!kind) kind = of_folder;
  const bool is_truth = std::ranges::find(kTruth, lower_case(stem)) != kTruth.end();
  if (!kind && is_truth && can_hold_values(file)) kind = MapKind::Disparity;
  if (!kind || !has_text_suffix(file)) return kind;
  const bool may_be_text = kind == MapKind::Disparity || kind == MapKind::Depth;
  return may_be_text && is_text_map(file) ? kind : std::nullopt;
}

/// What the name of a map adds to that of its view: "*_depth.npy" beside "03.png", the whole name
/// where the view has a folder of its own. Empty if the name is of another view.
std::string role_of(const fs::path& file, const fs::path& view, bool is_alone) {
  std::string name = file.filename().string();
  if (is_alone) return name;
  const std::string stem = view.stem().string();
  const std::size_t at = name.find(stem);
  const auto is_inside = [&](std::size_t i) { return i < name.size() && is_digit(name[i]); };
  const bool is_other =
      at == std::string::npos || is_inside(at + stem.size()) || (at > 0 && is_inside(at - 1));
  return is_other ? std::string() : name.replace(at, stem.size(), "*");
}

/// Maps of views that lie in folders inside `folder`, as rows or one folder a view: with their
/// views, or in folders of the same names inside a folder of maps.
class MapsOfFolders {
 public:
  MapsOfFolders(const ViewFiles& views, const fs::path& folder, FoundMapSets& found)
      : folder_(folder), found_(found) {
    taken_.insert(views.files.begin(), views.files.end());
    taken_.insert(views.left_out.begin(), views.left_out.end());
    for (std::size_t i = 0; i < views.files.size(); ++i) add(views.files[i], static_cast<int>(i));
    for (const fs::path& view : views.left_out) add(view, kLeftOut);
  }

  void find() {
    if (views_.contains(folder_)) return;
    for (const MapPlace& place : map_places(folder_)) {
      for (const auto& [inside, views] : views_) {
        look_into(place, inside.lexically_relative(folder_), views);
      }
    }
    for (auto& [key, set] : sets_) {
      drop_left_out(set);
      found_.sets.push_back(std::move(set));
    }
  }

 private:
  struct View {
    fs::path file;
    int number = 0;
  };

  void add(const fs::path& view, int number) {
    views_[view.parent_path()].push_back({view, number});
  }

  void look_into(const MapPlace& place, const fs::path& inside, const std::vector<View>& views) {
    const std::vector<fs::path> files = list_files(place.folder / inside);
    if (!files.empty()) found_.folders.push_back(place.folder / inside);
    for (const fs::path& file : files) {
      const auto kind = taken_.contains(file) ? std::nullopt : kind_of(file, place.kind);
      if (!kind) continue;
      for (const View& view : views) {
        const std::string role = role_of(file, view.file, views.size() == 1);
        if (role.empty()) continue;
        MapSet& set = sets_[{*kind, place.prefix + "*/" + role}];
        set.kind = *kind;
        set.pattern = place.prefix + "*/" + role;
        set.entries.push_back({view.number, file});
      }
    }
  }

  const fs::path& folder_;
  FoundMapSets& found_;
  std::set<fs::path> taken_;
  std::map<fs::path, std::vector<View>> views_;  ///< Of each folder.
  std::map<std::pair<MapKind, std::string>, MapSet> sets_;
};

}  // namespace

std::vector<fs::path> MapSet::files() const {
  std::vector<fs::path> files;
  for (const Entry& entry : entries) files.push_back(entry.file);
  return files;
}

fs::path MapSet::file_of(int view) const {
  const auto found = std::ranges::find(entries, view, &Entry::view);
  return found == entries.end() ? fs::path() : found->file;
}

FoundMapSets find_maps(const ViewFiles& views, const fs::path& folder, const IsOwnFile& is_own) {
  std::set<fs::path> taken(views.files.begin(), views.files.end());
  taken.insert(views.left_out.begin(), views.left_out.end());
  const ViewKeys keys = keys_of_views(views);
  FoundMapSets found;
  MapsOfFolders(views, folder, found).find();
  for (const MapPlace& place : map_places(folder)) {
    std::map<std::pair<MapKind, std::string>, std::vector<fs::path>> groups;
    for (const fs::path& file : list_files(place.folder)) {
      if (taken.contains(file) || (is_own && !is_own(file))) continue;
      const auto kind = kind_of(file, place.kind);
      if (!kind) continue;
      const std::string pattern =
          place.prefix + numbered_name(file.stem().string()).text + suffix_of(file);
      groups[{*kind, pattern}].push_back(file);
    }
    for (const auto& [key, files] : groups) {
      MapSet set{.kind = key.first, .pattern = key.second, .entries = {}, .strays = {}};
      match(files, keys, set);
      found.sets.push_back(std::move(set));
    }
    const bool is_other = place.folder != folder;
    if (is_other && !groups.empty()) found.folders.push_back(place.folder);
  }
  return found;
}

namespace {

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
      return std::tuple(-static_cast<int>(set->entries.size()), is_image_name(file),
                        has_text_suffix(file));
    };
    return rank(a) < rank(b);
  });
  return ranked;
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
