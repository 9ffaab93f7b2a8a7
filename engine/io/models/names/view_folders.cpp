// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/names/view_folders.h"

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/models/names/index_fields.h"
#include "engine/io/models/sidecar_maps/map_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace episcope::io {

namespace {

namespace fs = std::filesystem;

/// Of which one may be a light field of its own.
bool may_hold_light_field(const fs::path& path) {
  constexpr std::array<std::string_view, 5> suffixes{".h5", ".hdf5", ".mat", ".npy", ".npz"};
  return std::ranges::find(suffixes, suffix_of(path)) != suffixes.end() &&
         !map_kind(path.stem().string());
}

/// Of another form of light fields, which has a reader of its own.
bool has_own_reader(const fs::path& folder) {
  std::error_code error;
  return fs::exists(folder / "parameters.cfg", error) ||
         fs::exists(folder / "light_field.json", error);
}

/// Whether a folder beside views is named as one of maps or of other pictures of the scene.
bool is_beside_views(const fs::path& folder) {
  const std::string name = folder.filename().string();
  return is_map_folder(name) || names_companions(lower_case(name));
}

bool holds_grid(const fs::path& folder) {
  constexpr std::size_t kFewestViews = 4;
  try {
    const ViewNames names = find_view_names(folder, list_images(folder));
    return names.views.size() >= kFewestViews && !names.views.front().index;
  } catch (const IoError&) {
    return false;
  }
}

/// Whether a folder of views holds disparity, depth or labels as well.
bool holds_maps(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const auto kind = map_kind(it->path().stem().string());
    const bool is_map =
        kind == MapKind::Disparity || kind == MapKind::Depth || kind == MapKind::Labels;
    std::error_code ignored;
    if (is_map && it->is_regular_file(ignored)) return true;
  }
  return false;
}

/// Whether another folder beside that of views is a light field with maps of its own: then the
/// folder around them holds several scenes.
bool is_among_scenes(const fs::path& views) {
  std::error_code error;
  for (fs::directory_iterator it(views.parent_path(), error), end; !error && it != end;
       it.increment(error)) {
    const fs::path& other = it->path();
    std::error_code ignored;
    const bool may_be = it->is_directory(ignored) && other.filename() != views.filename() &&
                        !other.filename().string().starts_with('.') && !is_beside_views(other);
    if (may_be && holds_maps(other) && holds_grid(other)) return true;
  }
  return false;
}

/// The only folder inside that is named "viewpoints…", as PlenoptiCam names it beside refocused
/// pictures; else the folder itself.
fs::path viewpoints_folder(const fs::path& folder) {
  std::error_code error;
  fs::path found;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const bool is_named = entry.path().filename().string().starts_with("viewpoints");
    if (!is_named || count_images(entry.path()) < 2) continue;
    if (!found.empty()) return folder;
    found = entry.path();
  }
  return found.empty() ? folder : found;
}

}  // namespace

fs::path only_grid_inside(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error) || count_images(folder) > 0 || has_own_reader(folder)) {
    return {};
  }
  fs::path found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.')) continue;
    if (!entry.is_directory(error)) {
      if (may_hold_light_field(entry.path())) return {};
      continue;
    }
    if (is_beside_views(entry.path()) || count_images(entry.path()) == 0) continue;
    if (!found.empty()) return {};
    found = entry.path();
  }
  return !found.empty() && !has_own_reader(found) && holds_grid(found) ? found : fs::path();
}

fs::path named_views_folder(const fs::path& folder) {
  std::error_code error;
  const auto images_inside = [&](const char* name) {
    const bool is_folder_itself = fs::equivalent(folder / name, folder, error);
    return is_folder_itself ? 0 : count_images(folder / name);
  };
  for (const char* name : {"lf", "views"}) {
    if (images_inside(name) > 1 && !is_among_scenes(folder / name)) return folder / name;
  }
  for (const char* name : {"images", "rectified", "image", "rgb", "color"}) {
    const int inside = images_inside(name);
    const bool is_most = inside > 1 && inside > count_images(folder);
    if (is_most && !is_among_scenes(folder / name)) return folder / name;
  }
  return viewpoints_folder(folder);
}

fs::path views_folder(const fs::path& folder) {
  fs::path named = named_views_folder(folder);
  if (named != folder) return named;
  fs::path only = only_grid_inside(folder);
  return only.empty() ? folder : only;
}

std::vector<std::string> other_picture_folders(const fs::path& source, const fs::path& views) {
  std::vector<std::string> names;
  if (source == views) return names;
  for (const auto& entry : fs::directory_iterator(source)) {
    std::string name = entry.path().filename().string();
    if (name.starts_with('.') || is_beside_views(entry.path()) || entry.path() == views) continue;
    if (count_images(entry.path()) > 1) names.push_back(std::move(name));
  }
  std::ranges::sort(names);
  return names;
}

namespace {

std::string detected_pattern(const fs::path& folder, const std::vector<fs::path>& images) {
  try {
    return find_view_names(folder, images).pattern;
  } catch (const IoError&) {
    return {};
  }
}

std::map<fs::path, ViewIndex> places_of(const ViewFiles& views) {
  std::map<fs::path, ViewIndex> places;
  for (int i = 0; i < views.grid.count(); ++i) {
    places.emplace(views.files[static_cast<std::size_t>(i)], views.grid.view_at(i));
  }
  return places;
}

void describe(const ViewNames& names, const std::map<fs::path, ViewIndex>& places,
              const std::vector<fs::path>& images, PatternPreview& preview) {
  std::map<fs::path, const NamedView*> matches;
  for (const NamedView& view : names.views) matches.emplace(view.path, &view);
  const std::size_t count = std::min(images.size(), PatternPreview::kMostNames);
  for (std::size_t i = 0; i < count; ++i) {
    NamePreview name{.name = images[i].filename().string()};
    if (const auto match = matches.find(images[i]); match != matches.end()) {
      name.is_match = true;
      name.row = match->second->row;
      name.column = match->second->column;
      name.index = match->second->index;
    }
    if (const auto place = places.find(images[i]); place != places.end()) name.view = place->second;
    preview.names.push_back(std::move(name));
  }
}

/// Fills in all but `detected`.
void preview_names(const fs::path& folder, const std::vector<fs::path>& images,
                   const std::string& pattern, bool snake, PatternPreview& preview) {
  ViewNames names;
  std::map<fs::path, ViewIndex> places;
  try {
    names = pattern.empty() ? find_view_names(folder, images) : match_view_names(images, pattern);
    preview.matches = static_cast<int>(names.views.size());
    if (names.views.size() < 2) {
      preview.problem = fmt::format("{} of {} images match; a grid has two or more views",
                                    names.views.size(), images.size());
    } else {
      const PlacedViews placed = place_views(folder, snake ? with_turned_rows(names) : names);
      preview.grid = placed.views.grid;
      preview.is_list = placed.is_list;
      preview.warnings = placed.warnings;
      if (placed.gaps) preview.warnings.push_back(placed.gaps->text + ": state the grid.");
      if (!placed.is_list) places = places_of(placed.views);
    }
  } catch (const IoError& error) {
    preview.problem = error.sentence();
  } catch (const InvalidInput& error) {
    preview.problem = error.what();
  }
  describe(names, places, images, preview);
}

}  // namespace

PatternPreview preview_pattern(const fs::path& folder, const std::string& pattern, bool snake) {
  try {
    const fs::path inside = views_folder(folder);
    const std::vector<fs::path> images = list_images(inside);
    PatternPreview preview{.images = static_cast<int>(images.size())};
    preview.detected = detected_pattern(inside, images);
    preview_names(inside, images, pattern, snake, preview);
    return preview;
  } catch (const fs::filesystem_error& error) {
    throw IoError(folder,
                  "it cannot be read (" + error.code().message() + "); check its permissions");
  }
}

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFewestFolders = 4;
constexpr std::size_t kMostFolders = 10'000;

/// The only picture of a folder that is no map; empty if there is none, or several.
fs::path picture_in(const fs::path& folder) {
  fs::path found;
  for (const fs::path& image : list_images(folder)) {
    const std::string stem = lower_case(image.stem().string());
    if (map_kind(stem) || names_companions(stem)) continue;
    if (!found.empty() || names_mosaics(stem) || stem == "lf") return {};
    found = image;
  }
  return found;
}

bool speaks_of_views(const std::string& name) {
  constexpr std::array<std::string_view, 3> kWords{"view", "cam", "sai"};
  return std::ranges::any_of(kWords, [text = lower_case(name)](std::string_view word) {
    return text.find(word) != std::string::npos;
  });
}

/// FolderPictures by what the names of their folders would be if these were files.
using FolderPictures = std::map<fs::path, fs::path>;

/// Without those of maps. Nothing if there are too many to be views.
std::vector<fs::path> folders_in(const fs::path& folder) {
  std::vector<fs::path> folders = list_folders(folder);
  std::erase_if(folders, is_beside_views);
  return folders.size() > kMostFolders ? std::vector<fs::path>() : folders;
}

/// Nothing if they are not alike.
FolderPictures only_pictures(const fs::path& folder) {
  FolderPictures pictures;
  for (const fs::path& inside : folders_in(folder)) {
    const fs::path picture = picture_in(inside);
    const bool is_alike =
        pictures.empty() || pictures.begin()->second.filename() == picture.filename();
    if (picture.empty() || !is_alike) return {};
    pictures[inside.string() + picture.extension().string()] = picture;
  }
  return pictures;
}

/// Those of one name.
FolderPictures pictures_called(const fs::path& folder, const fs::path& name) {
  FolderPictures pictures;
  std::error_code error;
  for (const fs::path& inside : folders_in(folder)) {
    if (!fs::is_regular_file(inside / name, error)) continue;
    pictures[inside.string() + name.extension().string()] = inside / name;
  }
  return pictures;
}

std::vector<fs::path> as_files(const FolderPictures& pictures) {
  std::vector<fs::path> files;
  files.reserve(pictures.size());
  for (const auto& [file, picture] : pictures) files.push_back(file);
  return files;
}

/// "cam_{index}.png" becomes "cam_{index}/0001.png".
void name_pictures(ViewNames& names, const FolderPictures& pictures) {
  const fs::path name = pictures.begin()->second.filename();
  names.pattern.resize(names.pattern.size() - name.extension().string().size());
  names.pattern += '/';
  names.pattern += name.string();
  for (NamedView& view : names.views) view.path = pictures.at(view.path);
}

std::optional<ViewNames> names_of_folders(const fs::path& folder, const FolderPictures& pictures) {
  if (pictures.size() < kFewestFolders) return std::nullopt;
  try {
    ViewNames names = find_view_names(folder, as_files(pictures));
    const bool has_both = names.views.front().row && names.views.front().column;
    const bool is_counted = !has_both || names.pattern.find("}{") != std::string::npos;
    if (names.views.size() != pictures.size()) return std::nullopt;
    if (is_counted && !speaks_of_views(names.pattern)) return std::nullopt;
    name_pictures(names, pictures);
    return names;
  } catch (const IoError&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<ViewNames> find_view_folders(const fs::path& folder, const std::string& pattern) {
  if (count_images(folder) > 0) return std::nullopt;
  if (pattern.empty()) return names_of_folders(folder, only_pictures(folder));
  const std::size_t slash = pattern.rfind('/');
  if (slash == pattern.npos || pattern.find_first_of("{*?", slash) != pattern.npos) {
    return std::nullopt;
  }
  const fs::path name = pattern.substr(slash + 1);
  const FolderPictures pictures = pictures_called(folder, name);
  ViewNames names =
      match_view_names(as_files(pictures), pattern.substr(0, slash) + name.extension().string());
  if (names.views.empty()) return std::nullopt;
  name_pictures(names, pictures);
  return names;
}

std::optional<ViewNames> find_folders_with(const fs::path& folder, const std::string& picture) {
  return names_of_folders(folder, pictures_called(folder, picture));
}

namespace {

constexpr std::size_t kFewestOfSquare = 9;

/// Without maps.
std::vector<fs::path> views_in(const fs::path& folder) {
  std::vector<fs::path> images = list_images(folder);
  std::erase_if(images, [](const fs::path& image) { return map_kind(image.stem().string()); });
  return images;
}

/// Images, or folders, in the order of the number in which their names differ, which is the
/// `varying`-th.
struct CountedFolder {
  std::vector<fs::path> paths;
  std::vector<double> numbers;
  std::string skeleton;
  std::size_t varying = 0;
};

/// Nothing if the names are not of one form, or differ in no number or in several.
std::optional<CountedFolder> by_number(const std::vector<fs::path>& paths) {
  std::vector<NameGroup> groups = group_by_name(paths);
  if (groups.size() != 1 || paths.size() < 2) return std::nullopt;
  std::vector<NumberedImage>& images = groups.front().images;
  std::vector<std::size_t> varying;
  for (std::size_t i = 0; i < images.front().numbers.size(); ++i) {
    const auto differs = [&](const NumberedImage& image) {
      return image.numbers[i].position() != images.front().numbers[i].position();
    };
    if (std::ranges::any_of(images, differs)) varying.push_back(i);
  }
  if (varying.size() != 1) return std::nullopt;
  const auto number = [&](const NumberedImage& image) {
    return image.numbers[varying.front()].position();
  };
  std::ranges::sort(images, {}, number);
  const bool has_twins = std::ranges::adjacent_find(images, {}, number) != images.end();
  if (has_twins) return std::nullopt;
  CountedFolder found{{}, {}, groups.front().skeleton, varying.front()};
  for (const NumberedImage& image : images) {
    found.paths.push_back(image.path);
    found.numbers.push_back(number(image));
  }
  return found;
}

/// The skeleton with `field` for the number that differs, and * for others.
std::string pattern_of(const CountedFolder& numbered, const char* field) {
  std::string text;
  std::size_t number = 0;
  for (const char c : numbered.skeleton) {
    if (c != kNumberMark) {
      text += c;
    } else {
      text += number++ == numbered.varying ? field : "*";
    }
  }
  return text;
}

/// The letters of a name, without what stands between them.
std::string letters_of(const std::string& skeleton) {
  std::string letters;
  std::ranges::copy_if(lower_case(skeleton), std::back_inserter(letters), is_letter);
  return letters;
}

template <std::size_t N>
bool is_one_of(const std::string& word, const std::array<std::string_view, N>& words) {
  return std::ranges::find(words, std::string_view(word)) != words.end();
}

/// Of folders whose names are mere numbers.
bool are_rather_rows(std::size_t folders, std::size_t images, const OpenOptions& options) {
  if (const auto given = given_grid(options)) {
    return given->v == static_cast<int>(folders) && given->u == static_cast<int>(images);
  }
  const auto side = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(images))));
  const bool is_square = side * side == images && images >= kFewestOfSquare;
  return options.frame == 0 && (folders == images || !is_square);
}

}  // namespace

std::optional<RowFolders> find_row_folders(const fs::path& folder, const OpenOptions& options) {
  constexpr std::array<std::string_view, 6> kRows{"row", "rows", "r", "v", "y", "line"};
  constexpr std::array<std::string_view, 6> kColumns{"col", "column", "columns", "c", "u", "x"};
  std::error_code error;
  if (!fs::is_directory(folder, error) || !options.pattern.empty() || count_images(folder) > 0) {
    return std::nullopt;
  }
  const auto folders = by_number(folders_in(folder));
  if (!folders) return std::nullopt;
  const std::string word = letters_of(folders->skeleton);
  RowFolders found{
      .rows = {}, .numbers = {}, .are_columns = is_one_of(word, kColumns), .pattern = {}};
  if (!word.empty() && !found.are_columns && !is_one_of(word, kRows)) return std::nullopt;
  for (const fs::path& row : folders->paths) {
    auto images = by_number(views_in(row));
    if (!images) return std::nullopt;
    if (found.pattern.empty()) {
      found.pattern = pattern_of(*folders, found.are_columns ? "{col}" : "{row}") + "/" +
                      pattern_of(*images, found.are_columns ? "{row}" : "{col}");
    }
    found.rows.push_back(std::move(images->paths));
    found.numbers.push_back(std::move(images->numbers));
  }
  const bool is_certain =
      !word.empty() || are_rather_rows(found.rows.size(), found.rows.front().size(), options);
  return is_certain ? std::optional(std::move(found)) : std::nullopt;
}

namespace {

std::size_t most_in_a_row(const RowFolders& found) {
  std::size_t most = 0;
  for (const auto& row : found.rows) most = std::max(most, row.size());
  return most;
}

/// Folders of which some hold less images than others: their numbers say which are missing.
/// Throws IoError if images are numbered anew in no folder.
PlacedViews place_with_gaps(const fs::path& folder, const RowFolders& found, bool is_snake) {
  const std::size_t most = most_in_a_row(found);
  ViewNames names{.pattern = found.pattern};
  std::set<long long> columns;
  for (std::size_t row = 0; row < found.rows.size(); ++row) {
    for (std::size_t i = 0; i < found.rows[row].size(); ++i) {
      NamedView view{.path = found.rows[row][i],
                     .row = static_cast<long long>(row),
                     .column = std::llround(found.numbers[row][i])};
      columns.insert(*view.column);
      if (found.are_columns) std::swap(view.row, view.column);
      names.views.push_back(std::move(view));
    }
  }
  names.images = static_cast<int>(names.views.size());
  if (columns.size() == most) {
    return place_views(folder, is_snake ? with_turned_rows(std::move(names)) : names);
  }
  const auto short_row = std::ranges::find_if(
      found.rows, [&](const std::vector<fs::path>& row) { return row.size() < most; });
  throw IoError(folder, fmt::format("{} holds {} images, but other folders of this light field "
                                    "hold {}; add what is missing",
                                    short_row->front().parent_path().filename().string(),
                                    short_row->size(), most));
}

}  // namespace

PlacedViews place_rows(const fs::path& folder, const RowFolders& found, bool is_snake) {
  const std::size_t rows = found.rows.size();
  const std::size_t most = most_in_a_row(found);
  const bool is_full = std::ranges::all_of(
      found.rows, [&](const std::vector<fs::path>& row) { return row.size() == most; });
  if (!is_full) return place_with_gaps(folder, found, is_snake);
  PlacedViews placed;
  const auto length = [](std::size_t count) { return static_cast<int>(count); };
  placed.views.grid = found.are_columns ? GridShape{length(most), length(rows)}
                                        : GridShape{length(rows), length(most)};
  for (int i = 0; i < placed.views.grid.count(); ++i) {
    const ViewIndex view = placed.views.grid.view_at(i);
    const auto [row, place] =
        found.are_columns ? std::pair(view.u, view.v) : std::pair(view.v, view.u);
    placed.views.files.push_back(
        found.rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(place)]);
  }
  return placed;
}

}  // namespace episcope::io
