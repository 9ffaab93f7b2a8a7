// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/grid/load_views.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

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
/// The same for a list without rows and columns: "view 37 is missing".
[[nodiscard]] std::string missing_text(const std::vector<std::string>& first, std::size_t count);
inline constexpr std::size_t kMostNamedViews = 5;  ///< Missing views that these texts name.

/// The part without a gap that is opened (`largest_filled_part`); nothing if that would be less
/// than three views or a quarter of those that are there.
[[nodiscard]] std::optional<PartOfGrid> part_to_open(const GridWithGaps& views);

/// The views of a part, and those that it leaves out.
[[nodiscard]] ViewFiles files_of_part(const GridWithGaps& views, const PartOfGrid& part);

/// Sentences about what is missing, which part is opened, and what is left out.
[[nodiscard]] std::string part_text(const GridWithGaps& views, const PartOfGrid& part);

/// What these views are called in the account of a folder.
inline constexpr const char* kViewsLeftOut = "views outside of the part that is opened";
inline constexpr const char* kUnusableViews = "unusable views";

}  // namespace episcope::io
