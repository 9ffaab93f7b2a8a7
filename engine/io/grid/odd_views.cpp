// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/odd_views.h"

#include "engine/core/text/join.h"
#include "engine/io/grid/grid_with_gaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

namespace episcope::io {
namespace {

constexpr std::size_t kMostNamed = 3;  ///< Reasons, and views of each.

/// A part of a part of a grid, as a part of that grid.
PartOfGrid part_of(const std::optional<PartOfGrid>& outer, const PartOfGrid& inner) {
  if (!outer) return inner;
  return {outer->whole, outer->in_whole(inner.first), outer->step * inner.step, inner.grid};
}

/// With its folder where views lie in several.
std::string name_in(const ViewFiles& views, const std::filesystem::path& file) {
  const auto folder = views.files.front().parent_path();
  const bool is_one_folder = std::ranges::all_of(
      views.files, [&](const auto& each) { return each.parent_path() == folder; });
  return ((is_one_folder ? "" : file.parent_path().filename()) / file.filename()).string();
}

/// One sentence for all views of which the same is to be said, for a few such reasons.
std::string odd_text(const ViewFiles& views, const std::vector<OddView>& odd) {
  std::vector<std::pair<std::string, std::vector<std::string>>> reasons;
  for (const OddView& each : odd) {
    auto found =
        std::ranges::find(reasons, each.why, [](const auto& reason) { return reason.first; });
    if (found == reasons.end()) found = reasons.insert(found, {each.why, {}});
    found->second.push_back(name_in(views, views.files[static_cast<std::size_t>(each.place)]));
  }
  std::string text;
  std::size_t explained = 0;
  for (std::size_t i = 0; i < std::min(reasons.size(), kMostNamed); ++i) {
    const auto& [why, names] = reasons[i];
    const std::size_t named = std::min(names.size(), kMostNamed);
    text += joined(std::span(names).first(named), ", ");
    if (names.size() > named) text += fmt::format(" and {} others", names.size() - named);
    text += fmt::format(" cannot be used: {}. ", why);
    explained += names.size();
  }
  if (odd.size() > explained)
    text += fmt::format("Nor can {} other views. ", odd.size() - explained);
  return text;
}

}  // namespace

std::optional<PartWithout> without_views(const ViewFiles& views, const std::vector<OddView>& odd) {
  GridWithGaps left{.rows = {}, .columns = {}, .files = views.files, .numbering = "from 0"};
  for (int v = 0; v < views.grid.v; ++v) left.rows.push_back(views.in_whole({v, 0}).v);
  for (int u = 0; u < views.grid.u; ++u) left.columns.push_back(views.in_whole({0, u}).u);
  for (const OddView& each : odd) left.files[static_cast<std::size_t>(each.place)].clear();
  const auto part = part_to_open(left);
  if (!part) return std::nullopt;
  PartWithout found{files_of_part(left, *part), *part,
                    odd_text(views, odd) + part_text(left, *part)};
  ViewFiles& kept = found.views;
  kept.part = part_of(views.part, *part);
  kept.orientation = views.orientation;
  kept.left_out.insert(kept.left_out.end(), views.left_out.begin(), views.left_out.end());
  kept.unusable = views.unusable;
  for (const OddView& each : odd) {
    kept.unusable.push_back(views.files[static_cast<std::size_t>(each.place)]);
  }
  return found;
}

}  // namespace episcope::io
