// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/names/view_files.h"

#include "engine/core/finding.h"
#include "engine/core/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

namespace episcope::io {
namespace {

/// Number of steps that fit into `length` places.
int steps_in(int length, int step) {
  return (length + step - 1) / step;
}

/// What speaks for a part, the most important first.
auto merit_of(const PartOfGrid& part) {
  const auto off_center = [&](int first, int count, int length) {
    return std::abs(2 * first + (count - 1) * part.step - (length - 1));
  };
  return std::tuple(part.grid.count(), std::min(part.grid.v, part.grid.u), -part.step, part.grid.u,
                    -off_center(part.first.v, part.grid.v, part.whole.v) -
                        off_center(part.first.u, part.grid.u, part.whole.u));
}

/// The largest part with one step and one first place, of which others are multiples of the step
/// away.
class PartSearch {
 public:
  PartSearch(const std::vector<bool>& is_filled, PartOfGrid& best)
      : is_filled_(is_filled), best_(best) {}

  void look(int step, ViewIndex offset) {
    const GridShape whole = best_.whole;
    const int columns = steps_in(whole.u - offset.u, step);
    std::vector<int> heights(static_cast<std::size_t>(columns));  // filled places upwards
    for (int row = 0; offset.v + row * step < whole.v; ++row) {
      for (int column = 0; column < columns; ++column) {
        const int place = (offset.v + row * step) * whole.u + offset.u + column * step;
        int& height = heights[static_cast<std::size_t>(column)];
        height = is_filled_[static_cast<std::size_t>(place)] ? height + 1 : 0;
      }
      for (int column = 0; column < columns; ++column) {
        take_better(step, offset, row, column, heights);
      }
    }
  }

 private:
  /// The widest part that ends in this row and is as high as the places above this one.
  void take_better(int step, ViewIndex offset, int row, int column,
                   const std::vector<int>& heights) {
    const auto height_at = [&](int i) { return heights[static_cast<std::size_t>(i)]; };
    const int height = height_at(column);
    if (height == 0) return;
    int begin = column;
    int end = column + 1;
    while (begin > 0 && height_at(begin - 1) >= height) --begin;
    while (end < static_cast<int>(heights.size()) && height_at(end) >= height) ++end;
    const PartOfGrid part{best_.whole,
                          {offset.v + (row - height + 1) * step, offset.u + begin * step},
                          step,
                          {height, end - begin}};
    if (merit_of(part) > merit_of(best_)) best_ = part;
  }

  const std::vector<bool>& is_filled_;
  PartOfGrid& best_;
};

}  // namespace

ViewIndex PartOfGrid::in_whole(ViewIndex view) const {
  return {first.v + view.v * step, first.u + view.u * step};
}

std::optional<ViewIndex> PartOfGrid::in_part(ViewIndex view) const {
  const int v = view.v - first.v;
  const int u = view.u - first.u;
  const bool is_inside =
      v >= 0 && u >= 0 && v % step == 0 && u % step == 0 && v / step < grid.v && u / step < grid.u;
  return is_inside ? std::optional(ViewIndex{v / step, u / step}) : std::nullopt;
}

PartOfGrid largest_filled_part(const std::vector<bool>& is_filled, GridShape whole) {
  PartOfGrid best{whole, {0, 0}, 1, {0, 0}};
  PartSearch search(is_filled, best);
  for (int step = 1; step <= std::max(whole.v, whole.u); ++step) {
    if (steps_in(whole.v, step) * steps_in(whole.u, step) < best.grid.count()) break;
    for (int v = 0; v < std::min(step, whole.v); ++v) {
      for (int u = 0; u < std::min(step, whole.u); ++u) search.look(step, {v, u});
    }
  }
  return best;
}

NumberRun::NumberRun(std::vector<long long> all) : values(std::move(all)) {
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  long long common = 0;
  for (const long long value : values) common = std::gcd(common, value - values.front());
  step = std::max(common, 1LL);
}

std::vector<long long> NumberRun::filled() const {
  if (is_scattered()) return values;
  std::vector<long long> all;
  for (long long value = values.front(); value <= values.back(); value += step) {
    all.push_back(value);
  }
  return all;
}

std::optional<std::size_t> NumberRun::place_of(long long value) const {
  const auto found = std::ranges::lower_bound(values, value);
  if (found == values.end() || *found != value) return std::nullopt;
  return static_cast<std::size_t>(found - values.begin());
}

std::string NumberRun::text() const {
  if (values.size() == 1) return std::to_string(values.front());
  if (values.size() == 2 || has_gaps()) {
    std::string text;
    for (std::size_t i = 0; i < std::min<std::size_t>(values.size(), 8); ++i) {
      text += fmt::format("{}{}", i == 0 ? "" : ", ", values[i]);
    }
    return values.size() > 8 ? text + fmt::format(" … {}", values.back()) : text;
  }
  if (step == 1) return fmt::format("{} … {}", values.front(), values.back());
  return fmt::format("{}, {} … {}", values.front(), values[1], values.back());
}

namespace {

namespace fs = std::filesystem;

constexpr int kFewestOpenedViews = 3;
constexpr std::size_t kSmallestShare = 4;  ///< One of so many views that are there.

bool is_there(const GridWithGaps& views, ViewIndex view) {
  const GridShape shape = views.shape();
  return !views.files[static_cast<std::size_t>(view.v * shape.u + view.u)].empty();
}

/// Whether the views are exactly one row and one column.
bool is_cross(const GridWithGaps& views, ViewIndex middle) {
  const GridShape shape = views.shape();
  for (int i = 0; i < shape.count(); ++i) {
    const ViewIndex view = shape.view_at(i);
    if (is_there(views, view) != (view.v == middle.v || view.u == middle.u)) return false;
  }
  return shape.v > 1 && shape.u > 1;
}

std::optional<ViewIndex> middle_of_cross(const GridWithGaps& views, const PartOfGrid& line) {
  for (int i = 0; i < line.grid.count(); ++i) {
    const ViewIndex view = line.in_whole(line.grid.view_at(i));
    if (is_cross(views, view)) return view;
  }
  return std::nullopt;
}

enum class Axis { Rows, Columns };

/// "row 4", "columns 0, 2 … 8".
std::string numbers_text(Axis axis, const std::vector<long long>& all, int first, int count,
                         int step) {
  std::vector<long long> values;
  for (int i = 0; i < count; ++i) values.push_back(all[static_cast<std::size_t>(first + i * step)]);
  const std::string_view one =
      axis == Axis::Rows ? finding_text("numbers.row") : finding_text("numbers.column");
  const std::string_view several =
      axis == Axis::Rows ? finding_text("numbers.rows") : finding_text("numbers.columns");
  return fmt::format(fmt::runtime(count == 1 ? one : several), NumberRun(values).text());
}

}  // namespace

GridShape GridWithGaps::shape() const {
  return {static_cast<int>(rows.size()), static_cast<int>(columns.size())};
}

std::size_t GridWithGaps::missing() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(files, [](const auto& file) { return file.empty(); }));
}

std::string missing_text(const std::vector<std::string>& first, std::size_t count) {
  if (count == 1) return fmt::format(finding_text("numbers.missing"), first.front());
  std::string views;
  for (const std::string& each : first) views += (views.empty() ? "" : " ") + each;
  if (count > first.size()) views += " …";
  return fmt::format(finding_text("numbers.all_missing"), count, views);
}

std::string missing_text(const GridWithGaps& views) {
  std::vector<std::string> first;
  const GridShape shape = views.shape();
  for (int i = 0; i < shape.count() && first.size() < kMostNamedViews; ++i) {
    const ViewIndex view = shape.view_at(i);
    if (is_there(views, view)) continue;
    first.push_back(fmt::format("{},{}", views.rows[static_cast<std::size_t>(view.v)],
                                views.columns[static_cast<std::size_t>(view.u)]));
  }
  return missing_text(first, views.missing());
}

std::optional<PartOfGrid> part_to_open(const GridWithGaps& views) {
  std::vector<bool> is_filled;
  for (const auto& file : views.files) is_filled.push_back(!file.empty());
  const PartOfGrid part = largest_filled_part(is_filled, views.shape());
  const auto count = static_cast<std::size_t>(part.grid.count());
  const std::size_t there = views.files.size() - views.missing();
  const bool is_worth_it =
      part.grid.count() >= kFewestOpenedViews && count * kSmallestShare >= there;
  return is_worth_it ? std::optional(part) : std::nullopt;
}

ViewFiles files_of_part(const GridWithGaps& views, const PartOfGrid& part) {
  ViewFiles files{part.grid, {}, part};
  const GridShape shape = views.shape();
  for (int i = 0; i < shape.count(); ++i) {
    const fs::path& file = views.files[static_cast<std::size_t>(i)];
    if (file.empty()) continue;
    (part.in_part(shape.view_at(i)) ? files.files : files.left_out).push_back(file);
  }
  return files;
}

std::string part_text(const GridWithGaps& views, const PartOfGrid& part) {
  const GridShape shape = views.shape();
  const std::string rows =
      numbers_text(Axis::Rows, views.rows, part.first.v, part.grid.v, part.step);
  const std::string columns =
      numbers_text(Axis::Columns, views.columns, part.first.u, part.grid.u, part.step);
  const std::size_t others =
      views.files.size() - views.missing() - static_cast<std::size_t>(part.grid.count());
  if (const auto middle = middle_of_cross(views, part)) {
    const bool is_row = part.grid.v == 1;
    return fmt::format(finding_text("views.cross"), views.rows[static_cast<std::size_t>(middle->v)],
                       views.columns[static_cast<std::size_t>(middle->u)], views.numbering,
                       is_row ? "row" : "column", part.grid.v, part.grid.u, others,
                       is_row ? "column" : "row", is_row ? "{col}" : "{row}");
  }
  return fmt::format(
      fmt::runtime(others == 1 ? finding_text("views.part_but_one") : finding_text("views.part")),
      shape.v, shape.u, missing_text(views), views.numbering, part.grid.v, part.grid.u, rows,
      columns, others);
}

namespace {

constexpr std::size_t kMostNamedReasons = 3;  ///< Reasons, and views of each.

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

/// One sentence for all views of which the same is to be said, for a few such reasons; `text`
/// follows.
std::string unusable_text(const ViewFiles& views, const std::vector<UnusableView>& unusable,
                          std::string text) {
  std::vector<std::pair<std::string, std::vector<std::string>>> reasons;
  for (const UnusableView& each : unusable) {
    auto found =
        std::ranges::find(reasons, each.why, [](const auto& reason) { return reason.first; });
    if (found == reasons.end()) found = reasons.insert(found, {each.why, {}});
    found->second.push_back(name_in(views, views.files[static_cast<std::size_t>(each.place)]));
  }
  const std::span explained(reasons.data(), std::min(reasons.size(), kMostNamedReasons));
  std::size_t others = unusable.size();
  for (const auto& [why, names] : explained) others -= names.size();
  if (others > 0) text = fmt::format(finding_text("views.unusable_others"), others, text);
  for (auto each = explained.rbegin(); each != explained.rend(); ++each) {
    const auto& [why, names] = *each;
    const std::size_t named = std::min(names.size(), kMostNamedReasons);
    std::string those = joined(std::span(names).first(named), ", ");
    if (names.size() > named) those += fmt::format(" and {} others", names.size() - named);
    text = fmt::format(finding_text("views.unusable"), those, why, text);
  }
  return text;
}

}  // namespace

std::optional<PartWithout> without_views(const ViewFiles& views,
                                         const std::vector<UnusableView>& unusable) {
  GridWithGaps left{.rows = {}, .columns = {}, .files = views.files, .numbering = "from 0"};
  for (int v = 0; v < views.grid.v; ++v) left.rows.push_back(views.in_whole({v, 0}).v);
  for (int u = 0; u < views.grid.u; ++u) left.columns.push_back(views.in_whole({0, u}).u);
  for (const UnusableView& each : unusable)
    left.files[static_cast<std::size_t>(each.place)].clear();
  const auto part = part_to_open(left);
  if (!part) return std::nullopt;
  PartWithout found{files_of_part(left, *part), *part,
                    unusable_text(views, unusable, part_text(left, *part))};
  ViewFiles& kept = found.views;
  kept.part = part_of(views.part, *part);
  kept.orientation = views.orientation;
  kept.left_out.insert(kept.left_out.end(), views.left_out.begin(), views.left_out.end());
  kept.unusable = views.unusable;
  for (const UnusableView& each : unusable) {
    kept.unusable.push_back(views.files[static_cast<std::size_t>(each.place)]);
  }
  return found;
}

}  // namespace episcope::io
