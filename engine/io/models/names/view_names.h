// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/io/models/names/name_pattern.h"
#include "engine/io/models/names/view_files.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Images whose names follow one pattern and have the same fields.
struct ViewNames {
  std::string pattern;  ///< "out_{row}_{col}_*.png", "{index}.png", …
  std::vector<NamedView> views{};
  bool is_chosen = false;  ///< A user named the pattern: then gaps in numbers are meant.
  int images = 0;          ///< In the folder, for messages.
  bool is_turned = false;  ///< `with_turned_rows`.
};

struct ListGaps {
  std::vector<int> places{};  ///< Where in the whole list each view is, from 0.
  int length = 0;             ///< Of the whole list.
  std::string text{};         ///< "view 37 is missing (pattern … matches 80 of 80 images, …)".
};

struct PlacedViews {
  ViewFiles views;
  bool is_list = false;  ///< One index: the grid is 1×N, and rows and columns are yet unknown.
  std::optional<ListGaps> gaps{};         ///< Of a list some of whose numbers are missing.
  std::vector<CameraPosition> positions;  ///< Row by row; empty = unknown.
  std::vector<std::string> warnings;      ///< A sentence each: numbers in steps of two, …
};

/// Places views by their names: by the order of their row and column numbers, whatever these are,
/// or by positions if names have nothing else. Names with only a row or only a column form a single
/// column or row. Of a grid with gaps the largest part without is taken (`part_to_open`), with a
/// warning. Throws IoError that names missing views if there is no such part, or two views of one
/// place. `folder` is for messages.
[[nodiscard]] PlacedViews place_views(const std::filesystem::path& folder, const ViewNames& names);

/// Turns a grid in snake order: counts the columns of every second row from the other end. Names of
/// a list stay as they are.
[[nodiscard]] ViewNames with_turned_rows(ViewNames names);

/// End of messages: how to state the meaning of names.
inline constexpr const char* kPatternAdvice =
    "name the numbers by --pattern, as in --pattern 'view_{row}_{col}.png'";

/// Finds the views among the images of a folder by their names alone. Names that differ in numbers
/// only form a group (index_fields.h); the views are the group with the largest grid. Groups named
/// like companions of views (label, depth, …) come last. Ties go to the group of the largest
/// images, then of color, then of names without words, then of a lossless format. Throws IoError
/// that names the option `pattern` if there is no group, or if two are equal.
[[nodiscard]] ViewNames find_view_names(const std::filesystem::path& folder,
                                        const std::vector<std::filesystem::path>& images);

/// Finds the images whose names match a user's pattern (NamePattern); maybe none. Throws
/// InvalidInput for a wrong pattern.
[[nodiscard]] ViewNames match_view_names(const std::vector<std::filesystem::path>& images,
                                         const std::string& pattern);

}  // namespace episcope::io
