// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"
#include "engine/io/models/stored_maps.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Views that labels may belong to.
struct LabelPlaces {
  FieldShape shape;
  /// Names of the files of the views without suffix, row by row; empty = not known.
  std::vector<std::string> names{};
};

/// A label file and the view of its name.
struct NamedFile {
  std::filesystem::path path;
  std::optional<ViewIndex> view{};
};

/// Views by the names of files: of the file of the view, else by two numbers for row and column,
/// next to each other or the only ones that vary. Of several pairs the last one counts; `notes`
/// name the first. Without a view: names of none.
[[nodiscard]] std::vector<NamedFile> named_views(const std::vector<std::filesystem::path>& paths,
                                                 const LabelPlaces& places,
                                                 std::vector<std::string>& notes);

/// Files that count all views by the only number that differs, or by two for rows and columns, in
/// their order, wherever they begin; else nothing.
[[nodiscard]] std::optional<std::vector<NamedFile>> counted_views(
    const std::vector<std::filesystem::path>& paths, GridShape grid);

/// By their names, else counted. A file alone may be of no view. Throws IoError if one of several
/// is.
[[nodiscard]] std::vector<NamedFile> placed_views(const std::vector<std::filesystem::path>& paths,
                                                  const LabelPlaces& places,
                                                  std::vector<std::string>& notes);

}  // namespace episcope::io
