// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/pattern_preview.h"

#include "engine/core/error.h"
#include "engine/io/grid/image_list.h"
#include "engine/io/grid/view_group.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

std::string detected_pattern(const fs::path& folder, const std::vector<fs::path>& images) {
  try {
    return find_view_names(folder, images).pattern;
  } catch (const IoError&) {
    return {};
  }
}

/// The message without the path at its beginning.
std::string sentence_of(const IoError& error) {
  const std::string text = error.what();
  const std::string path = error.path().string() + ": ";
  return text.starts_with(path) ? text.substr(path.size()) : text;
}

/// Where views are, by path.
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
    preview.problem = sentence_of(error);
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

}  // namespace episcope::io
