// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/view_names.h"

#include "engine/core/error.h"
#include "engine/io/grid/number_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostNamed = 5;  ///< Missing views that a message names.

std::string tried(const ViewNames& names) {
  return fmt::format("pattern {} matches {} of {} images", names.pattern, names.views.size(),
                     names.images);
}

NumberRun run_of(const ViewNames& names, const std::function<long long(const NamedView&)>& number) {
  std::vector<long long> values;
  for (const NamedView& view : names.views) values.push_back(number(view));
  return NumberRun(std::move(values));
}

/// The values that places are made for: with gaps filled, unless a user meant them or nearly all is
/// missing.
std::vector<long long> expected_values(const NumberRun& run, bool is_chosen) {
  if (is_chosen || run.is_scattered()) return run.values;
  std::vector<long long> values;
  for (long long value = run.values.front(); value <= run.values.back(); value += run.step) {
    values.push_back(value);
  }
  return values;
}

void warn_of_steps(const char* what, const NumberRun& run, std::vector<std::string>& warnings) {
  if (run.values.size() < 2 || run.is_plain()) return;
  if (run.has_gaps()) {
    warnings.push_back(
        fmt::format("The names number {} {}: they are taken for neighbours at equal distances.",
                    what, run.text()));
  } else if (run.step > 1) {
    warnings.push_back(
        fmt::format("The names number {} {}: the grid is subsampled, and disparities are per {} "
                    "steps of the numbers.",
                    what, run.text(), run.step));
  }
}

struct Axes {
  NumberRun rows;
  NumberRun columns;
};

void warn_of_numbers(const Axes& axes, std::vector<std::string>& warnings) {
  if (axes.rows.values == axes.columns.values) {
    warn_of_steps("rows and columns", axes.rows, warnings);
  } else {
    warn_of_steps("rows", axes.rows, warnings);
    warn_of_steps("columns", axes.columns, warnings);
  }
  const bool both_vary = axes.rows.values.size() > 1 && axes.columns.values.size() > 1;
  const long long row = axes.rows.values.front();
  const long long column = axes.columns.values.front();
  if (both_vary && row != column && std::min(row, column) == 0 && std::max(row, column) == 1) {
    warnings.push_back(
        fmt::format("Rows begin at {} and columns at {}: perhaps a {} of views is missing.", row,
                    column, row > column ? "row" : "column"));
  }
}

/// "view 3,7 is missing", "12 views are missing: 0,1 0,2 …".
std::string missing_text(const std::vector<std::string>& first, std::size_t count) {
  if (count == 1) return "view " + first.front() + " is missing";
  std::string text = fmt::format("{} views are missing:", count);
  for (const std::string& each : first) (text += ' ') += each;
  return count > first.size() ? text + " …" : text;
}

[[noreturn]] void refuse_twin(const NamedView& view, const fs::path& other) {
  throw IoError(view.path, "this view has the same place as " + other.filename().string() +
                               " by its name; remove one of the two or " + kPatternAdvice);
}

[[noreturn]] void refuse_gaps(const fs::path& folder, const ViewNames& names,
                              const std::vector<long long>& rows,
                              const std::vector<long long>& columns,
                              const std::vector<std::pair<long long, long long>>& there) {
  std::vector<std::string> first;
  for (const long long row : rows) {
    for (const long long column : columns) {
      if (first.size() == kMostNamed) break;
      if (std::ranges::binary_search(there, std::pair(row, column))) continue;
      first.push_back(fmt::format("{},{}", row, column));
    }
  }
  throw IoError(
      folder,
      fmt::format("{} (row,column as in the names; {}, a grid of {}×{}); add {} "
                  "or {}",
                  missing_text(first, rows.size() * columns.size() - there.size()), tried(names),
                  rows.size(), columns.size(), first.size() == 1 ? "it" : "them", kPatternAdvice));
}

PlacedViews place_on_grid(const fs::path& folder, const ViewNames& names) {
  const auto row_of = [](const NamedView& view) { return view.row.value_or(0); };
  const auto column_of = [](const NamedView& view) { return view.column.value_or(0); };
  const auto place_of = [&](const NamedView& view) {
    return std::pair(row_of(view), column_of(view));
  };
  std::vector<const NamedView*> sorted;
  for (const NamedView& view : names.views) sorted.push_back(&view);
  std::ranges::stable_sort(sorted, {}, [&](const NamedView* view) { return place_of(*view); });
  std::vector<std::pair<long long, long long>> there;
  for (const NamedView* view : sorted) {
    if (!there.empty() && there.back() == place_of(*view)) {
      refuse_twin(*view, sorted[there.size() - 1]->path);
    }
    there.push_back(place_of(*view));
  }
  const Axes axes{run_of(names, row_of), run_of(names, column_of)};
  const std::vector<long long> rows = expected_values(axes.rows, names.is_chosen);
  const std::vector<long long> columns = expected_values(axes.columns, names.is_chosen);
  if (rows.size() * columns.size() != there.size()) {
    refuse_gaps(folder, names, rows, columns, there);
  }
  PlacedViews placed;
  placed.views.grid = {static_cast<int>(rows.size()), static_cast<int>(columns.size())};
  for (const NamedView* view : sorted) placed.views.files.push_back(view->path);
  if (sorted.front()->x || sorted.front()->y) {
    for (const NamedView* view : sorted) {
      placed.positions.push_back({view->x.value_or(0), view->y.value_or(0)});
    }
  }
  warn_of_numbers(axes, placed.warnings);
  return placed;
}

/// Throws IoError that names what is missing from a list.
void require_no_gaps(const fs::path& folder, const ViewNames& names, const NumberRun& run) {
  if (names.is_chosen || !run.has_gaps() || run.is_scattered()) return;
  std::vector<std::string> first;
  for (long long value = run.values.front();
       value <= run.values.back() && first.size() < kMostNamed; value += run.step) {
    if (!run.place_of(value)) first.push_back(std::to_string(value));
  }
  const auto count = static_cast<std::size_t>(run.length()) - run.values.size();
  throw IoError(folder,
                fmt::format("{} ({}, numbers {}); add {} or {}", missing_text(first, count),
                            tried(names), run.text(), count == 1 ? "it" : "them",
                            "say by --pattern '" + names.pattern + "' that none is missing"));
}

PlacedViews place_in_list(const fs::path& folder, const ViewNames& names) {
  ViewNames line = names;
  for (NamedView& view : line.views) view.column = view.index;
  const NumberRun run = run_of(names, [](const NamedView& view) { return *view.index; });
  require_no_gaps(folder, names, run);
  line.is_chosen = true;  // gaps that are left are meant
  PlacedViews placed = place_on_grid(folder, line);
  placed.is_list = true;
  placed.warnings.clear();
  warn_of_steps("views", run, placed.warnings);
  return placed;
}

/// Numbers the different values of a coordinate, from the smallest on.
void number_by(std::optional<double> NamedView::*coordinate,
               std::optional<long long> NamedView::*number, std::vector<NamedView>& views) {
  std::vector<double> values;
  for (const NamedView& view : views) values.push_back((view.*coordinate).value_or(0));
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  for (NamedView& view : views) {
    view.*number =
        std::ranges::lower_bound(values, (view.*coordinate).value_or(0)) - values.begin();
  }
}

}  // namespace

PlacedViews place_views(const fs::path& folder, const ViewNames& names) {
  const NamedView& first = names.views.front();
  if (!first.row && !first.column && !first.index) {
    ViewNames numbered = names;
    number_by(&NamedView::y, &NamedView::row, numbered.views);
    number_by(&NamedView::x, &NamedView::column, numbered.views);
    return place_on_grid(folder, numbered);
  }
  return names.views.front().index ? place_in_list(folder, names) : place_on_grid(folder, names);
}

}  // namespace episcope::io
