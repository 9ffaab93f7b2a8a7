// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/names/view_names.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/text.h"
#include "engine/io/base/image_file.h"
#include "engine/io/models/names/index_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <tuple>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostGridPlaces = 250'000;  ///< Of a grid with gaps.

std::string tried(const ViewNames& names) {
  return fmt::format("pattern {} matches {} of {} images", names.pattern, names.views.size(),
                     names.images);
}

NumberRun run_of(const ViewNames& names, const std::function<long long(const NamedView&)>& number) {
  std::vector<long long> values;
  for (const NamedView& view : names.views) values.push_back(number(view));
  return NumberRun(std::move(values));
}

/// The values that places are made for: gaps that a user named are meant.
std::vector<long long> expected_values(const NumberRun& run, bool is_chosen) {
  return is_chosen ? run.values : run.filled();
}

void warn_of_steps(const char* what, const NumberRun& run, std::vector<std::string>& warnings) {
  if (run.values.size() < 2 || run.is_plain()) return;
  if (run.has_gaps()) {
    warnings.push_back(fmt::format(finding_text("views.uneven"), what, run.text()));
  } else if (run.step > 1) {
    warnings.push_back(fmt::format(finding_text("views.subsampled"), what, run.text(), run.step));
  }
}

struct Axes {
  NumberRun rows;
  NumberRun columns;
};

void warn_of_steps(const Axes& axes, std::vector<std::string>& warnings) {
  if (axes.rows.values == axes.columns.values) {
    warn_of_steps("rows and columns", axes.rows, warnings);
  } else {
    warn_of_steps("rows", axes.rows, warnings);
    warn_of_steps("columns", axes.columns, warnings);
  }
}

void warn_of_numbers(const Axes& axes, std::vector<std::string>& warnings) {
  warn_of_steps(axes, warnings);
  const bool both_vary = axes.rows.values.size() > 1 && axes.columns.values.size() > 1;
  const long long row = axes.rows.values.front();
  const long long column = axes.columns.values.front();
  if (both_vary && row != column && std::min(row, column) == 0 && std::max(row, column) == 1) {
    warnings.push_back(
        fmt::format(finding_text("views.begin"), row, column, row > column ? "row" : "column"));
  }
}

[[noreturn]] void refuse_twin(const NamedView& view, const fs::path& other) {
  throw IoError(view.path, "this view has the same place as " + other.filename().string() +
                               " by its name; remove one of the two or " + kPatternAdvice);
}

[[noreturn]] void refuse_gaps(const fs::path& folder, const ViewNames& names,
                              const GridWithGaps& views) {
  throw IoError(
      folder,
      fmt::format("{} (row,column as in the names; {}, a grid of {}×{}); add {} or {}",
                  missing_text(views), tried(names), views.rows.size(), views.columns.size(),
                  views.missing() == 1 ? "it" : "them", kPatternAdvice));
}

long long row_of(const NamedView& view) {
  return view.row.value_or(0);
}
long long column_of(const NamedView& view) {
  return view.column.value_or(0);
}

/// By row and column; throws IoError for two views of one place.
std::vector<const NamedView*> sorted_views(const ViewNames& names) {
  const auto place_of = [](const NamedView* view) {
    return std::pair(row_of(*view), column_of(*view));
  };
  std::vector<const NamedView*> sorted;
  for (const NamedView& view : names.views) sorted.push_back(&view);
  std::ranges::stable_sort(sorted, {}, place_of);
  const auto twin = std::ranges::adjacent_find(sorted, {}, place_of);
  if (twin != sorted.end()) refuse_twin(**std::next(twin), (*twin)->path);
  return sorted;
}

PlacedViews placed_views(const std::vector<const NamedView*>& views, GridShape grid) {
  PlacedViews placed;
  placed.views.grid = grid;
  for (const NamedView* view : views) placed.views.files.push_back(view->path);
  if (views.front()->x || views.front()->y) {
    for (const NamedView* view : views) {
      placed.positions.push_back({view->x.value_or(0), view->y.value_or(0)});
    }
  }
  return placed;
}

/// The part without a gap of views sorted by row and column.
PlacedViews place_part(const fs::path& folder, const ViewNames& names,
                       const std::vector<const NamedView*>& sorted, GridWithGaps views) {
  const auto place_of = [](const std::vector<long long>& numbers, long long number) {
    return static_cast<int>(std::ranges::lower_bound(numbers, number) - numbers.begin());
  };
  const auto view_of = [&](const NamedView* view) {
    return ViewIndex{place_of(views.rows, row_of(*view)),
                     place_of(views.columns, column_of(*view))};
  };
  views.files.resize(views.rows.size() * views.columns.size());
  for (const NamedView* view : sorted) {
    const ViewIndex at = view_of(view);
    views.files[static_cast<std::size_t>(at.v * views.shape().u + at.u)] = view->path;
  }
  const std::optional<PartOfGrid> part = part_to_open(views);
  if (!part) refuse_gaps(folder, names, views);
  std::vector<const NamedView*> kept;
  ViewNames kept_names{.pattern = {}};
  for (const NamedView* view : sorted) {
    if (!part->in_part(view_of(view))) continue;
    kept.push_back(view);
    kept_names.views.push_back(*view);
  }
  PlacedViews placed = placed_views(kept, part->grid);
  placed.views = files_of_part(views, *part);
  placed.warnings.push_back(part_text(views, *part));
  warn_of_steps(Axes{run_of(kept_names, row_of), run_of(kept_names, column_of)}, placed.warnings);
  return placed;
}

PlacedViews place_on_grid(const fs::path& folder, const ViewNames& names) {
  const std::vector<const NamedView*> sorted = sorted_views(names);
  const Axes axes{run_of(names, row_of), run_of(names, column_of)};
  GridWithGaps views{expected_values(axes.rows, names.is_chosen),
                     expected_values(axes.columns, names.is_chosen)};
  if (names.is_turned) views.numbering = "as in the names, with every second row turned round";
  const std::size_t places = views.rows.size() * views.columns.size();
  if (places > std::max(kMostGridPlaces, sorted.size())) {
    throw IoError(folder, fmt::format("{} of {} places of a grid of {}×{} have no view ({}); {}",
                                      places - sorted.size(), places, views.rows.size(),
                                      views.columns.size(), tried(names), kPatternAdvice));
  }
  if (places != sorted.size()) return place_part(folder, names, sorted, std::move(views));
  PlacedViews placed = placed_views(sorted, views.shape());
  warn_of_numbers(axes, placed.warnings);
  return placed;
}

ListGaps gaps_of(const ViewNames& names, const NumberRun& run) {
  ListGaps gaps{.length = static_cast<int>(run.length())};
  std::vector<std::string> first;
  for (long long value = run.values.front(); value <= run.values.back(); value += run.step) {
    const auto place = static_cast<int>((value - run.values.front()) / run.step);
    if (run.place_of(value)) {
      gaps.places.push_back(place);
    } else if (first.size() < kMostNamedViews) {
      first.push_back(std::to_string(value));
    }
  }
  gaps.text =
      fmt::format("{} ({}, numbers {})",
                  missing_text(first, static_cast<std::size_t>(run.length()) - run.values.size()),
                  tried(names), run.text());
  return gaps;
}

PlacedViews place_in_list(const fs::path& folder, const ViewNames& names) {
  ViewNames line = names;
  for (NamedView& view : line.views) view.column = view.index;
  const NumberRun run = run_of(names, [](const NamedView& view) { return *view.index; });
  const bool has_gaps = !names.is_chosen && run.has_gaps() && !run.is_scattered();
  line.is_chosen = true;  // gaps that are left are meant
  PlacedViews placed = place_on_grid(folder, line);
  placed.is_list = true;
  placed.warnings.clear();
  if (has_gaps) {
    placed.gaps = gaps_of(names, run);
  } else {
    warn_of_steps("views", run, placed.warnings);
  }
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

ViewNames with_turned_rows(ViewNames names) {
  const NamedView& first = names.views.front();
  if (!first.row || !first.column) return names;
  const NumberRun rows = run_of(names, row_of);
  const NumberRun columns = run_of(names, column_of);
  for (NamedView& view : names.views) {
    const bool is_odd = (*view.row - rows.values.front()) / rows.step % 2 == 1;
    if (is_odd) view.column = columns.values.front() + columns.values.back() - *view.column;
  }
  names.is_turned = true;
  return names;
}

namespace {

using GroupForm = IndexFields::Form;

/// A full grid is taken rather than a list of up to so many times its views.
constexpr std::size_t kGridsWorth = 4;

struct Candidate {
  const NameGroup* group = nullptr;
  IndexFields fields;
  std::tuple<bool, std::size_t> rank{};  ///< What speaks for it, the most important first.
};

std::vector<Candidate> candidates_of(const std::vector<NameGroup>& groups) {
  std::vector<Candidate> candidates;
  for (const NameGroup& group : groups) {
    if (group.images.size() < 2 || names_mosaics(group.skeleton)) continue;
    Candidate candidate{&group, find_index_fields(group)};
    if (candidate.fields.form == GroupForm::None) continue;
    const std::size_t worth = candidate.fields.form == GroupForm::Grid ? kGridsWorth : 1;
    candidate.rank = {!names_companions(group.skeleton), worth * group.images.size()};
    candidates.push_back(std::move(candidate));
  }
  std::ranges::stable_sort(candidates, std::ranges::greater{}, &Candidate::rank);
  return candidates;
}

struct Look {
  long long area = 0;
  bool is_color = false;
};

/// Of the first image of a group; nothing for one that cannot be decoded.
Look look_of(const NameGroup& group) {
  try {
    return std::visit(
        [](const auto& image) {
          return Look{static_cast<long long>(image.height()) * image.width(),
                      image.channels() == 3};
        },
        decode_image(group.images.front().path));
  } catch (const IoError&) {
    return {};
  }
}

bool has_words(const NameGroup& group) {
  const fs::path stem = fs::path(group.images.front().path).stem();
  return std::ranges::any_of(stem.string(), [](unsigned char c) { return std::isalpha(c) != 0; });
}

bool has_loss(const NameGroup& group) {
  constexpr std::array kSuffixes{".jpg", ".jpeg", ".webp"};
  const std::string suffix = suffix_of(group.images.front().path);
  return std::ranges::find(kSuffixes, suffix) != kSuffixes.end();
}

/// The one to prefer of candidates of the same rank; throws IoError if there is none.
const Candidate& best_of(const fs::path& folder, const std::vector<Candidate>& candidates) {
  using Merit = std::tuple<long long, bool, bool, bool>;
  std::vector<std::pair<Merit, const Candidate*>> equal;
  for (const Candidate& each : candidates) {
    if (each.rank == candidates.front().rank) equal.push_back({{}, &each});
  }
  if (equal.size() == 1) return candidates.front();
  for (auto& [merit, each] : equal) {
    const Look look = look_of(*each->group);
    merit = {look.area, look.is_color, !has_words(*each->group), !has_loss(*each->group)};
  }
  std::ranges::stable_sort(equal, std::ranges::greater{},
                           &std::pair<Merit, const Candidate*>::first);
  if (equal[0].first > equal[1].first) return *equal[0].second;
  throw IoError(folder,
                fmt::format("two sets of {} images could be the views, {} and {}; say which by "
                            "--pattern, in which a letter may be a {{row}} as well",
                            equal[0].second->group->images.size(),
                            pattern_text(*equal[0].second->group, equal[0].second->fields),
                            pattern_text(*equal[1].second->group, equal[1].second->fields)));
}

[[noreturn]] void refuse(const fs::path& folder, const std::vector<NameGroup>& groups,
                         std::size_t images) {
  const auto mosaics = std::ranges::find_if(
      groups, [](const NameGroup& group) { return names_mosaics(group.skeleton); });
  if (mosaics != groups.end()) {
    throw IoError(folder, "each of these images is a light field of its own, such as " +
                              mosaics->images.front().path.filename().string() +
                              "; open one of them");
  }
  throw IoError(folder, fmt::format("the images do not form a grid of views: {} image{} found, and "
                                    "no number in the names tells row and column; {}",
                                    images, images == 1 ? " was" : "s were", kPatternAdvice));
}

ViewNames names_of(const Candidate& candidate) {
  const IndexFields& fields = candidate.fields;
  ViewNames names{.pattern = pattern_text(*candidate.group, fields)};
  for (const NumberedImage& image : candidate.group->images) {
    NamedView view{.path = image.path};
    const auto number = [&](std::size_t place) {
      const NameNumber& each = image.numbers[place];
      return fields.are_signed ? *each.signed_count() : *each.count();
    };
    if (fields.row) view.row = number(*fields.row);
    if (fields.column) view.column = number(*fields.column);
    if (fields.index) view.index = number(*fields.index);
    if (fields.y) view.y = image.numbers[*fields.y].position();
    if (fields.x) view.x = image.numbers[*fields.x].position();
    names.views.push_back(std::move(view));
  }
  return names;
}

}  // namespace

ViewNames find_view_names(const fs::path& folder, const std::vector<fs::path>& images) {
  std::vector<NameGroup> groups = group_by_name(images);
  std::ranges::for_each(groups, separate_joined_digits);
  const std::vector<Candidate> candidates = candidates_of(groups);
  if (candidates.empty()) refuse(folder, groups, images.size());
  const Candidate& best = best_of(folder, candidates);
  if (best.fields.form == GroupForm::Unclear) {
    throw IoError(folder,
                  fmt::format("several numbers vary in the names of {} images, such as {}, "
                              "and it is not clear which are row and column; {}",
                              best.group->images.size(),
                              best.group->images.front().path.filename().string(), kPatternAdvice));
  }
  ViewNames names = names_of(best);
  names.images = static_cast<int>(images.size());
  return names;
}

ViewNames match_view_names(const std::vector<fs::path>& images, const std::string& pattern) {
  const NamePattern compiled(pattern);
  ViewNames names{.pattern = pattern, .is_chosen = true, .images = static_cast<int>(images.size())};
  for (const fs::path& path : images) {
    if (auto view = compiled.match(path)) names.views.push_back(std::move(*view));
  }
  return names;
}

}  // namespace episcope::io
