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

/// By what their names would be if the folders were files; nothing if they are not alike.
std::map<fs::path, fs::path> pictures_by_folder(const fs::path& folder) {
  std::map<fs::path, fs::path> pictures;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const fs::path& inside = entry.path();
    const bool is_hidden = inside.filename().string().starts_with('.');
    if (is_hidden || !entry.is_directory(error)) continue;
    const fs::path picture = picture_in(inside);
    const bool is_alike =
        pictures.empty() || pictures.begin()->second.filename() == picture.filename();
    if (picture.empty() || !is_alike || pictures.size() == kMostFolders) return {};
    pictures[inside.string() + picture.extension().string()] = picture;
  }
  return pictures;
}

}  // namespace

std::optional<ViewNames> find_view_folders(const fs::path& folder) {
  if (count_images(folder) > 0) return std::nullopt;
  const std::map<fs::path, fs::path> pictures = pictures_by_folder(folder);
  if (pictures.size() < kFewestFolders) return std::nullopt;
  std::vector<fs::path> as_files;
  as_files.reserve(pictures.size());
  for (const auto& [file, picture] : pictures) as_files.push_back(file);
  try {
    ViewNames names = find_view_names(folder, as_files);
    const bool has_both = names.views.front().row && names.views.front().column;
    const bool is_counted = !has_both || names.pattern.find("}{") != std::string::npos;
    if (names.views.size() != pictures.size()) return std::nullopt;
    if (is_counted && !speaks_of_views(names.pattern)) return std::nullopt;
    const fs::path name = pictures.begin()->second.filename();
    names.pattern.resize(names.pattern.size() - name.extension().string().size());
    names.pattern += '/';
    names.pattern += name.string();
    for (NamedView& view : names.views) view.path = pictures.at(view.path);
    return names;
  } catch (const IoError&) {
    return std::nullopt;
  }
}

}  // namespace episcope::io
