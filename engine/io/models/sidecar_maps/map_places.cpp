// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/sidecar_maps/map_places.h"

#include "engine/io/models/names/view_folders.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

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

/// "lf", "views": of a folder that holds only the pictures of a scene, whose other files lie beside
/// it.
bool has_inner_name(const fs::path& folder) {
  constexpr std::array<std::string_view, 12> names{"lf",    "views", "images", "rectified",
                                                   "image", "rgb",   "color",  "input",
                                                   "sai",   "sais",  "png",    "subaperture"};
  const std::string name = numbered_name(folder.filename().string()).text;
  return std::ranges::find(names, name) != names.end();
}

/// Of a folder: regions and masks may be called after a method.
MapClaim claim_of(const std::string& name) {
  const auto kind = map_kind(name);
  return kind && is_mask(*kind) ? MapClaim::None : map_claim(name);
}

/// The folders of maps inside a folder, and those inside them.
std::vector<MapPlace> places_inside(const fs::path& outer, const fs::path& but) {
  std::vector<MapPlace> places;
  for (const fs::path& inner : map_folders_in(outer)) {
    if (fs::equivalent(inner, but)) continue;
    const std::string name = inner.filename().string();
    places.push_back({inner, map_kind(name), name + "/", claim_of(name)});
    const MapPlace whole = places.back();
    for (const fs::path& deep : map_folders_in(inner)) {
      const std::string own = deep.filename().string();
      const auto kind = map_kind(own);
      const MapClaim claim = claim_of(own);
      places.push_back({deep, kind ? kind : whole.kind, whole.prefix + own + "/",
                        claim == MapClaim::None ? whole.claim : claim});
    }
  }
  return places;
}

/// False also where the folder around cannot be listed, as those of users may be.
bool is_only_grid_of(const fs::path& around, const fs::path& folder) {
  try {
    return only_grid_inside(around) == folder;
  } catch (const fs::filesystem_error&) {
    return false;
  }
}

}  // namespace

std::vector<MapPlace> map_places(const fs::path& folder) {
  std::vector<MapPlace> places{{folder, std::nullopt}};
  const auto add = [&](std::vector<MapPlace> more) {
    std::ranges::move(more, std::back_inserter(places));
  };
  add(places_inside(folder, folder));
  std::error_code error;
  const fs::path whole = fs::absolute(folder).lexically_normal();
  const fs::path clean = whole.has_filename() ? whole : whole.parent_path();
  const bool is_only_inside = is_only_grid_of(clean.parent_path(), clean);
  if (has_inner_name(clean) || is_only_inside) {
    std::vector<MapPlace> around = places_inside(clean.parent_path(), folder);
    around.insert(around.begin(), {clean.parent_path(), std::nullopt});
    if (!has_inner_name(clean)) {
      const SceneFiles own({clean.filename().string(), clean.parent_path().filename().string()},
                           light_fields_beside(clean), true);
      std::erase_if(around, [&](const MapPlace& place) {
        return !place.prefix.empty() &&
               !own.contains(place.prefix.substr(0, place.prefix.find('/')));
      });
      around.front().owner = own;
      for (MapPlace& place : around) place.scene = clean.filename().string();
    }
    add(std::move(around));
    return places;
  }
  if (fs::exists(folder / kBaselineFile, error)) {
    places.push_back({clean.parent_path(), std::nullopt});
  }
  std::vector<MapPlace> of_scenes = places_inside(clean.parent_path(), folder);
  for (MapPlace& place : of_scenes) {
    place.scene = clean.filename().string();
    place.is_shared = true;
  }
  add(std::move(of_scenes));
  return places;
}

}  // namespace episcope::io
