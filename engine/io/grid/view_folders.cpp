// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/view_folders.h"

#include "engine/core/error.h"
#include "engine/core/text/suffix.h"
#include "engine/io/beside/map_name.h"
#include "engine/io/grid/image_list.h"
#include "engine/io/grid/name_words.h"
#include "engine/io/grid/view_group.h"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <vector>

namespace episcope::io {
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

/// Pictures by what the names of their folders would be if these were files.
using Pictures = std::map<fs::path, fs::path>;

/// Nothing if there are too many to be views.
std::vector<fs::path> folders_in(const fs::path& folder) {
  std::vector<fs::path> folders = list_folders(folder);
  return folders.size() > kMostFolders ? std::vector<fs::path>() : folders;
}

/// Nothing if they are not alike.
Pictures only_pictures(const fs::path& folder) {
  Pictures pictures;
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
Pictures pictures_called(const fs::path& folder, const fs::path& name) {
  Pictures pictures;
  std::error_code error;
  for (const fs::path& inside : folders_in(folder)) {
    if (!fs::is_regular_file(inside / name, error)) continue;
    pictures[inside.string() + name.extension().string()] = inside / name;
  }
  return pictures;
}

std::vector<fs::path> as_files(const Pictures& pictures) {
  std::vector<fs::path> files;
  files.reserve(pictures.size());
  for (const auto& [file, picture] : pictures) files.push_back(file);
  return files;
}

/// "cam_{index}.png" becomes "cam_{index}/0001.png".
void name_pictures(ViewNames& names, const Pictures& pictures) {
  const fs::path name = pictures.begin()->second.filename();
  names.pattern.resize(names.pattern.size() - name.extension().string().size());
  names.pattern += '/';
  names.pattern += name.string();
  for (NamedView& view : names.views) view.path = pictures.at(view.path);
}

std::optional<ViewNames> names_of_folders(const fs::path& folder, const Pictures& pictures) {
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
  const Pictures pictures = pictures_called(folder, name);
  ViewNames names =
      match_view_names(as_files(pictures), pattern.substr(0, slash) + name.extension().string());
  if (names.views.empty()) return std::nullopt;
  name_pictures(names, pictures);
  return names;
}

std::optional<ViewNames> find_folders_with(const fs::path& folder, const std::string& picture) {
  return names_of_folders(folder, pictures_called(folder, picture));
}

}  // namespace episcope::io
