// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Views in equal steps out of a grid, with one step along rows and columns.
struct PartOfGrid {
  GridShape whole;
  ViewIndex first;  ///< In the whole grid.
  int step = 1;
  GridShape grid;

  /// Place of a view of the part in the whole grid.
  [[nodiscard]] ViewIndex in_whole(ViewIndex view) const;
  /// Place of a view of the whole grid in the part; nothing if the part omits it.
  [[nodiscard]] std::optional<ViewIndex> in_part(ViewIndex view) const;
};

/// Finds the largest part whose places are all filled (`is_filled`, row by row). Of several parts
/// of one size it prefers the squarest, then the densest, the widest, and the one nearest to the
/// center of the whole grid. O(V·U²).
[[nodiscard]] PartOfGrid largest_filled_part(const std::vector<bool>& is_filled, GridShape whole);

/// Image files of the views of a grid, row by row from view (0, 0) on.
struct ViewFiles {
  GridShape grid;
  std::vector<std::filesystem::path> files;
  std::optional<PartOfGrid> part{};               ///< Of a grid with gaps that this is a part of,
  std::vector<std::filesystem::path> left_out{};  ///< and its views that are not in this part,
  std::vector<std::filesystem::path> unusable{};  ///< or that `load_usable_views` could not use.

  int orientation = 1;  ///< In which all of them are to be shown (`common_orientation`).

  [[nodiscard]] const std::filesystem::path& file(ViewIndex view) const {
    return files[static_cast<std::size_t>(view.v) * grid.u + view.u];
  }
  /// Grid with the views that are missing or left out.
  [[nodiscard]] GridShape whole_grid() const { return part ? part->whole : grid; }
  /// Place of a view in the whole grid.
  [[nodiscard]] ViewIndex in_whole(ViewIndex view) const {
    return part ? part->in_whole(view) : view;
  }
  /// Place of the center of the whole grid; nothing if that view is missing or left out.
  [[nodiscard]] std::optional<ViewIndex> whole_center() const {
    return part ? part->in_part(part->whole.center()) : std::optional(grid.center());
  }
};

/// Distinct values of an index, ascending, in equal steps with or without gaps.
struct NumberRun {
  std::vector<long long> values;
  long long step = 1;  ///< The greatest one on which all values lie.

  /// Sorts and thins out `all`, which must not be empty.
  explicit NumberRun(std::vector<long long> all);

  /// Number of steps from the first value to the last, gaps included.
  [[nodiscard]] long long length() const { return (values.back() - values.front()) / step + 1; }
  [[nodiscard]] bool has_gaps() const { return length() != static_cast<long long>(values.size()); }
  /// Whether more values are missing than present: then it is no index.
  [[nodiscard]] bool is_scattered() const {
    return length() > 2 * static_cast<long long>(values.size());
  }
  /// All values from the first to the last, missing ones included.
  [[nodiscard]] std::vector<long long> filled() const;
  /// Whether the values are 0 … n−1 or 1 … n.
  [[nodiscard]] bool is_plain() const {
    return !has_gaps() && step == 1 && (values.front() == 0 || values.front() == 1);
  }
  /// Place of a value, from 0; nothing if it is not among them.
  [[nodiscard]] std::optional<std::size_t> place_of(long long value) const;
  /// "0 … 8", "0, 2 … 16", "2, 5, 6".
  [[nodiscard]] std::string text() const;
};

/// Views of which some are missing in the grid that their names number.
struct GridWithGaps {
  std::vector<long long> rows;  ///< The numbers of all rows and columns.
  std::vector<long long> columns;
  std::vector<std::filesystem::path> files{};  ///< Row by row; empty = missing.
  const char* numbering = "as in the names";   ///< What `rows` and `columns` are.

  [[nodiscard]] GridShape shape() const;
  [[nodiscard]] std::size_t missing() const;
};

/// "view 3,5 is missing", "12 views are missing: 0,1 0,2 …".
[[nodiscard]] std::string missing_text(const GridWithGaps& views);
/// Text about a list without rows and columns: "view 37 is missing".
[[nodiscard]] std::string missing_text(const std::vector<std::string>& first, std::size_t count);
inline constexpr std::size_t kMostNamedViews = 5;  ///< Missing views that these texts name.

/// Part without a gap to open (`largest_filled_part`); nothing if it has fewer than three views or
/// less than a quarter of the views present.
[[nodiscard]] std::optional<PartOfGrid> part_to_open(const GridWithGaps& views);

/// Views of a part, with the views that it omits.
[[nodiscard]] ViewFiles files_of_part(const GridWithGaps& views, const PartOfGrid& part);

/// Sentences about missing views, the part that is opened, and the views left out.
[[nodiscard]] std::string part_text(const GridWithGaps& views, const PartOfGrid& part);

/// Kinds of these views in the usage of a folder.
inline constexpr const char* kViewsLeftOut = "views outside of the part that is opened";
inline constexpr const char* kUnusableViews = "unusable views";

/// View that cannot be used with the others.
struct UnusableView {
  int place = 0;    ///< Among the files of the views.
  std::string why;  ///< "the image cannot be decoded: …", "this view has 8×8 px, …".
  bool is_damaged = false;
};

/// What more than half of those have that are known; nothing if there is no such thing.
template <class T>
[[nodiscard]] std::optional<T> majority(const std::vector<std::optional<T>>& each) {
  std::map<T, std::size_t> counts;
  std::size_t known = 0;
  for (const std::optional<T>& one : each) {
    if (!one) continue;
    ++counts[*one];
    ++known;
  }
  for (const auto& [value, count] : counts) {
    if (2 * count > known) return value;
  }
  return std::nullopt;
}

/// Part of a grid that remains without some views.
struct PartWithout {
  ViewFiles views;
  PartOfGrid kept;      ///< Of the grid of all.
  std::string warning;  ///< Which were left out and why, and which part is left.
};

/// Removes unusable views, which count as missing: returns the largest part of the grid without
/// them, in equal steps (`part_to_open`). Nothing if that is too small.
[[nodiscard]] std::optional<PartWithout> without_views(const ViewFiles& views,
                                                       const std::vector<UnusableView>& unusable);

}  // namespace episcope::io
