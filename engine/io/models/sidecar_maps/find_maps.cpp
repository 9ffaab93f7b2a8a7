// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/sidecar_maps/find_maps.h"

#include "engine/core/text.h"
#include "engine/io/base/exchange_files.h"
#include "engine/io/base/files.h"
#include "engine/io/models/names/index_fields.h"
#include "engine/io/models/sidecar_maps/map_file.h"
#include "engine/io/models/sidecar_maps/map_places.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string_view>
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

/// Where a name holds a part with no digits beside it; npos if it does not.
std::size_t place_of(const std::string& part, const std::string& name) {
  const auto is_inside = [&](std::size_t i) { return i < name.size() && is_digit(name[i]); };
  for (std::size_t at = name.find(part); at != std::string::npos; at = name.find(part, at + 1)) {
    if (!is_inside(at + part.size()) && (at == 0 || !is_inside(at - 1))) return at;
  }
  return std::string::npos;
}

/// The view whose name, or whose telling part, the name of the map holds: 5_5 in "5_5_depth" and
/// "depth_5_5".
std::optional<int> view_in_name(const std::string& stem, const ViewKeys& views) {
  std::optional<int> found;
  for (const auto& [whole, view] : views.view_by_stem) {
    if (place_of(telling_part(whole), stem) == std::string::npos) continue;
    if (found && *found != view) return std::nullopt;
    found = view;
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

/// What the name of a file says beside those of its view and scene.
std::string said_by(const fs::path& file, const MapPlace& place) {
  return name_beside(file.stem().string(), place.owners);
}

/// By its own name, else by the name of its folder.
std::optional<MapKind> named_kind(const fs::path& file, const MapPlace& place) {
  const std::string said = said_by(file, place);
  const bool says_more = std::ranges::any_of(said, is_letter);
  const auto kind = map_kind(says_more ? said : file.stem().string());
  return kind ? kind : place.kind;
}

/// By its own name, else by the name of its folder. `is_of_scene`: the file is called after the
/// views.
std::optional<MapKind> kind_of(const fs::path& file, const MapPlace& place, bool is_of_scene) {
  const std::string stem = file.stem().string();
  std::optional<MapKind> kind = named_kind(file, place);
  const bool is_of_truth = place.claim == MapClaim::True && is_of_scene;
  const bool is_truth = is_bare_truth_name(stem) || is_of_truth;
  if (!kind && is_truth && can_hold_values(file)) kind = MapKind::Disparity;
  if (!kind || !has_text_suffix(file)) return kind;
  const bool may_be_text = kind == MapKind::Disparity || kind == MapKind::Depth;
  return may_be_text && is_text_map(file) ? kind : std::nullopt;
}

/// By its own name, else by the name of its folder. Masks are not asked for the methods they name.
MapClaim claim_of(const fs::path& file, MapKind kind, const MapPlace& place) {
  const MapClaim own = is_mask(kind) ? MapClaim::None : map_claim(said_by(file, place));
  return own == MapClaim::None ? place.claim : own;
}

/// What a mask marks, by its own name, else by those of its folders; empty for other maps.
std::string region_of(const fs::path& file, MapKind kind, const MapPlace& place) {
  if (kind != MapKind::Region) return {};
  std::string region = region_name(said_by(file, place));
  for (fs::path folder = file.parent_path(); region.empty() && folder.has_relative_path();
       folder = folder.parent_path()) {
    region = region_name(folder.filename().string());
  }
  return region;
}

/// The numbers behind words that count frames, times or exposures.
std::map<std::string, long> frames_in(const fs::path& file) {
  const NameParts parts = split_name(file.filename());
  const NameWords words(parts.skeleton);
  std::map<std::string, long> frames;
  for (std::size_t i = 0; i < parts.numbers.size(); ++i) {
    const auto number = parts.numbers[i].count();
    if (words.is_other_count(i) && number) frames[words.before(i)] = static_cast<long>(*number);
  }
  return frames;
}

/// Those that are the same in the names of all views: else they count the views.
std::map<std::string, long> frames_of(const ViewFiles& views) {
  std::map<std::string, long> common;
  if (!views.files.empty()) common = frames_in(views.files.front());
  const auto keep_those_of = [&](const fs::path& file) {
    const auto own = frames_in(file);
    std::erase_if(common, [&](const auto& one) {
      const auto same = own.find(one.first);
      return same == own.end() || same->second != one.second;
    });
  };
  std::ranges::for_each(views.files, keep_those_of);
  std::ranges::for_each(views.left_out, keep_those_of);
  return common;
}

/// Whether the names of views and of a map have numbers of different frames.
bool is_of_other_frame(const fs::path& map, const std::map<std::string, long>& frames) {
  if (frames.empty()) return false;
  return std::ranges::any_of(frames_in(map), [&](const auto& own) {
    const auto same = frames.find(own.first);
    return same != frames.end() && same->second != own.second;
  });
}

/// With the names of the views, and of the light field.
std::vector<MapPlace> places_for(const ViewFiles& views, const fs::path& folder,
                                 const std::optional<SceneFiles>& own) {
  std::set<std::string> names;
  const auto add = [&](const fs::path& view) {
    const std::string name = numbered_name(view.stem().string()).text;
    if (std::ranges::any_of(name, is_letter)) names.insert(name);
  };
  std::ranges::for_each(views.files, add);
  std::ranges::for_each(views.left_out, add);
  if (own) names.insert(own->scenes().begin(), own->scenes().end());
  std::vector<MapPlace> places = map_places(folder);
  for (MapPlace& place : places) {
    place.owners.assign(names.begin(), names.end());
    if (!place.owner) continue;
    const std::vector<std::string>& scenes = place.owner->scenes();
    place.owners.insert(place.owners.end(), scenes.begin(), scenes.end());
  }
  return places;
}

/// What the name of a map adds to that of its view: "*_depth.npy" beside "03.png", the whole name
/// where the view has a folder of its own. Empty if the name is of another view.
std::string role_of(const fs::path& file, const fs::path& view, bool is_alone) {
  std::string name = file.filename().string();
  if (is_alone) return name;
  const std::string stem = view.stem().string();
  const std::size_t at = place_of(stem, name);
  return at == std::string::npos ? std::string() : name.replace(at, stem.size(), "*");
}

/// Maps of views that lie in folders inside `folder`, as rows or one folder a view: with their
/// views, or in folders of the same names inside a folder of maps.
class MapsOfFolders {
 public:
  MapsOfFolders(const ViewFiles& views, const fs::path& folder, const std::set<fs::path>& taken,
                FoundMapSets& found)
      : folder_(folder), taken_(taken), found_(found) {
    for (std::size_t i = 0; i < views.files.size(); ++i) add(views.files[i], static_cast<int>(i));
    for (const fs::path& view : views.left_out) add(view, kLeftOut);
  }

  void find(const std::vector<MapPlace>& places) {
    if (views_.contains(folder_)) return;
    for (const MapPlace& place : places) {
      if (place.is_shared) continue;
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
      const auto kind = taken_.contains(file) ? std::nullopt : kind_of(file, place, false);
      if (!kind) continue;
      const MapClaim claim = claim_of(file, *kind, place);
      for (const View& view : views) {
        const std::string role = role_of(file, view.file, views.size() == 1);
        if (role.empty()) continue;
        if (claim == MapClaim::Computed) {
          found_.computed.push_back({file, *kind});
          break;
        }
        MapSet& set = sets_[{*kind, place.prefix + "*/" + role}];
        set.kind = *kind;
        set.claim = claim;
        set.region = region_of(file, *kind, place);
        set.pattern = place.prefix + "*/" + role;
        set.entries.push_back({view.number, file});
      }
    }
  }

  const fs::path& folder_;
  const std::set<fs::path>& taken_;
  FoundMapSets& found_;
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

FoundMapSets find_maps(const ViewFiles& views, const fs::path& folder,
                       const std::optional<SceneFiles>& own) {
  std::set<fs::path> taken(views.files.begin(), views.files.end());
  taken.insert(views.left_out.begin(), views.left_out.end());
  const ViewKeys keys = keys_of_views(views);
  FoundMapSets found;
  const std::vector<MapPlace> places = places_for(views, folder, own);
  MapsOfFolders(views, folder, taken, found).find(places);
  const auto frames = frames_of(views);
  for (const MapPlace& place : places) {
    std::map<std::pair<MapKind, std::string>, std::vector<fs::path>> groups;
    for (const fs::path& file : list_files(place.folder)) {
      if (taken.contains(file) || (own && !own->contains(file))) continue;
      if (!place.may_hold(file)) continue;
      const bool is_of_scene = own || place.is_called(file);
      const auto kind =
          is_of_other_frame(file, frames) ? std::nullopt : kind_of(file, place, is_of_scene);
      if (!kind) continue;
      if (claim_of(file, *kind, place) == MapClaim::Computed) {
        found.computed.push_back({file, *kind});
        continue;
      }
      const std::string pattern =
          place.prefix + numbered_name(file.stem().string()).text + suffix_of(file);
      groups[{*kind, pattern}].push_back(file);
    }
    for (const auto& [key, files] : groups) {
      MapSet set{.kind = key.first, .pattern = key.second, .entries = {}, .strays = {}};
      set.claim = claim_of(files.front(), key.first, place);
      set.region = region_of(files.front(), key.first, place);
      match(files, keys, set);
      found.sets.push_back(std::move(set));
    }
    const bool is_other = place.folder != folder;
    const bool is_whole = !place.is_shared;  // else files of other scenes are counted
    if (is_other && is_whole && !groups.empty()) found.folders.push_back(place.folder);
  }
  return found;
}

bool is_found_as_truth(const fs::path& file, const fs::path& folder,
                       const std::optional<SceneFiles>& own) {
  const fs::path in = fs::absolute(file).lexically_normal();
  if (!can_hold_values(in) || (own && !own->contains(in))) return false;
  return std::ranges::any_of(places_for(ViewFiles(), folder, own), [&](const MapPlace& place) {
    std::error_code error;
    if (!fs::equivalent(place.folder, in.parent_path(), error) || !place.may_hold(in)) return false;
    auto kind = named_kind(in, place);
    if (!kind && is_bare_truth_name(in.stem().string())) kind = MapKind::Disparity;
    const bool is_value = kind == MapKind::Disparity || kind == MapKind::Depth;
    return is_value && claim_of(in, *kind, place) != MapClaim::Computed;
  });
}

}  // namespace episcope::io
