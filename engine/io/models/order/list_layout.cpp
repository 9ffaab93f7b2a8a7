// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/order/list_layout.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/core/text_table.h"
#include "engine/io/models/order/motion_pictures.h"
#include "engine/io/models/order/view_axes.h"
#include "engine/io/models/order/warp_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace episcope::io {
namespace {

/// A list of views understood as rows of `period` views, every second one turned round if `snake`.
/// Which image axis the rows run along is left open; a period of the whole list is a line.
struct Arrangement {
  int period = 1;
  bool snake = false;

  struct Place {
    int row = 0;
    int column = 0;
  };
  [[nodiscard]] Place place(int index) const;
  friend bool operator==(const Arrangement&, const Arrangement&) = default;
};

/// How unlike pairs of views are, as a number that grows with the distance of the cameras.
struct Unlikeness {
  std::vector<std::array<int, 2>> pairs;  ///< Of places in the list.
  std::vector<double> values;

  /// The share of the variance of the unlikeness that is left when it may only grow with the
  /// distance of the views in this arrangement, with the best of several ratios of the two steps:
  /// 0 = fits perfectly, about 1 = not at all.
  [[nodiscard]] double unexplained(const Arrangement& arrangement) const;
};

/// Pairs of equal distance.
struct Group {
  double sum = 0;
  double squares = 0;
  double count = 0;

  [[nodiscard]] double mean() const { return sum / count; }
  /// Sum of squared deviations from the mean.
  [[nodiscard]] double spread() const { return squares - sum * sum / count; }
  void join(const Group& other) {
    sum += other.sum;
    squares += other.squares;
    count += other.count;
  }
};

/// Isotonic regression by joining neighbors that violate the order; returns what is left.
double spread_about_rising_curve(const std::vector<Group>& groups) {
  std::vector<Group> curve;
  for (const Group& group : groups) {
    curve.push_back(group);
    while (curve.size() > 1 && curve[curve.size() - 2].mean() > curve.back().mean()) {
      curve[curve.size() - 2].join(curve.back());
      curve.pop_back();
    }
  }
  return std::accumulate(curve.begin(), curve.end(), 0.0,
                         [](double sum, const Group& group) { return sum + group.spread(); });
}

/// `values` grouped by distance, from small to large.
std::vector<Group> grouped(const std::vector<double>& distances,
                           const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return distances[i]; });
  std::vector<Group> groups;
  double last = -1;
  for (const std::size_t i : order) {
    if (groups.empty() || distances[i] != last) groups.emplace_back();
    groups.back().join({values[i], values[i] * values[i], 1});
    last = distances[i];
  }
  return groups;
}

Arrangement::Place Arrangement::place(int index) const {
  const int row = index / period;
  const int column = index % period;
  return {row, snake && row % 2 == 1 ? period - 1 - column : column};
}

/// Every way to cut a list of `count` views into rows of equal length, the line last.
std::vector<Arrangement> arrangements(int count) {
  std::vector<Arrangement> found;
  for (int period = 2; period < count; ++period) {
    if (count % period != 0) continue;
    found.push_back({period, false});
    found.push_back({period, true});
  }
  found.push_back({count, false});
  return found;
}

double Unlikeness::unexplained(const Arrangement& arrangement) const {
  Group all;
  for (const double value : values) all.join({value, value * value, 1});
  if (values.size() < 2 || all.spread() <= 0) return 1;
  double least = all.spread();
  for (const double ratio : {0.25, 0.5, 1.0, 2.0, 4.0}) {
    std::vector<double> distances;
    distances.reserve(pairs.size());
    for (const auto& [i, j] : pairs) {
      const Arrangement::Place a = arrangement.place(i);
      const Arrangement::Place b = arrangement.place(j);
      const double columns = a.column - b.column;
      const double rows = a.row - b.row;
      distances.push_back(columns * columns + ratio * rows * rows);
    }
    least = std::min(least, spread_about_rising_curve(grouped(distances, values)));
  }
  return least / all.spread();
}

constexpr int kShortList = 128;
constexpr double kWorstFit = 0.35;
constexpr double kWorstLine = 0.2;  ///< A grid with gaps resembles a line more than another grid.
constexpr double kGoodFit = 0.1;
/// Views of less contrast, against the median, hold nothing.
constexpr double kLeastViewContrast = 0.1;
/// Pairs that are less alike than this share of the range tell no distance any more.
constexpr double kSaturation = 0.6;
constexpr double kNegligible = 0.005;
constexpr int kFarthestInList = 32;

/// The views of a long list that tell its arrangements apart: neighbors of the middle one, in the
/// list and in every arrangement.
std::set<int> telling_views(int count) {
  std::set<int> chosen;
  const auto add = [&](int index) {
    if (index >= 0 && index < count) chosen.insert(index);
  };
  const int middle = count / 2;
  for (int i = -12; i <= 12; ++i) add(middle + i);
  for (const Arrangement& one : arrangements(count)) {
    const int turned = 2 * (one.period - 1 - middle % one.period) + 1;
    for (const int row : {-2, -1, 1, 2}) {
      for (const int i : {-1, 0, 1}) add(middle + row * one.period + i);
    }
    if (one.snake) add(middle + turned);
    if (chosen.size() > kShortList) break;
  }
  return chosen;
}

/// Views of the list that hold something, by index.
using ListPictures = std::map<int, MotionPictures>;

ListPictures load(int count, const GreyViewOfList& view, const Progress& progress) {
  std::vector<int> wanted;
  if (count <= kShortList) {
    for (int i = 0; i < count; ++i) wanted.push_back(i);
  } else {
    const std::set<int> chosen = telling_views(count);
    wanted.assign(chosen.begin(), chosen.end());
  }
  std::vector<MotionPictures> loaded(wanted.size());
  parallel_for(static_cast<int>(wanted.size()), progress, [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    loaded[at] = MotionPictures(view(wanted[at]));
  });
  std::vector<double> contrasts;
  for (const MotionPictures& one : loaded) contrasts.push_back(one.contrast);
  std::ranges::sort(contrasts);
  const double least = kLeastViewContrast * contrasts[contrasts.size() / 2];
  ListPictures pictures;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (loaded[i].contrast > least) pictures.emplace(wanted[i], std::move(loaded[i]));
  }
  return pictures;
}

/// Roots of 1 − correlation, which grow about linearly as long as views are alike.
Unlikeness unlikeness(const ListPictures& pictures, std::size_t scale, const Progress& progress) {
  Unlikeness found;
  for (auto one = pictures.begin(); one != pictures.end(); ++one) {
    for (auto other = std::next(one); other != pictures.end(); ++other) {
      found.pairs.push_back({one->first, other->first});
    }
  }
  found.values.resize(found.pairs.size());
  parallel_for(static_cast<int>(found.pairs.size()), progress, [&](int i) {
    const auto& [a, b] = found.pairs[static_cast<std::size_t>(i)];
    found.values[static_cast<std::size_t>(i)] =
        1 - io::correlation(pictures.at(a).scales[scale], pictures.at(b).scales[scale]);
  });
  const double least = std::ranges::min(found.values);
  const double most = least + kSaturation * std::max(1 - least, 0.0);
  for (double& value : found.values) value = std::sqrt(std::clamp(value, 0.0, most));
  return found;
}

struct Fit {
  Arrangement arrangement;
  double unexplained = 1;
};

std::vector<Fit> fits(const std::vector<Arrangement>& tried, const Unlikeness& pairs) {
  std::vector<Fit> found;
  for (const Arrangement& one : tried) found.push_back({one, pairs.unexplained(one)});
  std::ranges::stable_sort(found, {}, &Fit::unexplained);
  return found;
}

/// How little the best arrangement leaves unexplained, against the next one.
double ambiguity(const std::vector<Fit>& found) {
  const double next = found.size() > 1 ? found[1].unexplained : 1;
  return (found[0].unexplained + kNegligible) / (next + kNegligible);
}

/// The arrangements that explain about as much as the best one.
std::vector<Arrangement> near_best(const std::vector<Fit>& found) {
  const double most = std::max(2 * found[0].unexplained, found[0].unexplained + 0.05);
  std::vector<Arrangement> near;
  for (const Fit& fit : found) {
    if (fit.unexplained <= most) near.push_back(fit.arrangement);
  }
  return near;
}

/// Only pairs that are close in the list tell apart arrangements that differ within short rows.
std::vector<Fit> refined(const std::vector<Fit>& found, const Unlikeness& all) {
  const std::vector<Arrangement> near = near_best(found);
  if (near.size() < 2) return found;
  const int reach = 2 * std::ranges::min(near, {}, &Arrangement::period).period;
  Unlikeness close;
  for (std::size_t i = 0; i < all.pairs.size(); ++i) {
    if (all.pairs[i][1] - all.pairs[i][0] > reach) continue;
    close.pairs.push_back(all.pairs[i]);
    close.values.push_back(all.values[i]);
  }
  std::vector<Fit> better = fits(near, close);
  return ambiguity(better) < ambiguity(found) ? better : found;
}

/// Adds arrangements whose last row is not full: a list with missing views must not be taken for
/// another grid.
void add_unfilled(int count, const Unlikeness& pairs, std::vector<Fit>& found) {
  for (int period = 2; period <= count / 2; ++period) {
    if (count % period != 0) found.push_back({{period}, pairs.unexplained({period})});
  }
  std::ranges::stable_sort(found, {}, &Fit::unexplained);
}

/// All arrangements, the best first, at the scale at which the best one stands out most.
std::vector<Fit> fits(int count, const ListPictures& pictures, const Progress& progress) {
  std::vector<Fit> clearest;
  Unlikeness clearest_pairs;
  for (std::size_t scale = 0; scale < MotionPictures::kScales; ++scale) {
    progress.check();
    Unlikeness pairs = unlikeness(pictures, scale, progress);
    std::vector<Fit> found = refined(fits(arrangements(count), pairs), pairs);
    if (clearest.empty() || ambiguity(found) < ambiguity(clearest)) {
      clearest = std::move(found);
      clearest_pairs = std::move(pairs);
    }
  }
  if (clearest[0].unexplained > kGoodFit) add_unfilled(count, clearest_pairs, clearest);
  return clearest;
}

/// Pairs of views in a row (or column) of the arrangement, `step` apart; a few, spread over all.
std::vector<std::array<int, 2>> neighbours(const ListPictures& pictures,
                                           const Arrangement& arrangement, bool is_along_row,
                                           int step) {
  std::vector<std::array<int, 2>> all;
  for (auto one = pictures.begin(); one != pictures.end(); ++one) {
    const Arrangement::Place p = arrangement.place(one->first);
    for (auto other = std::next(one); other != pictures.end(); ++other) {
      const Arrangement::Place q = arrangement.place(other->first);
      const int along = std::abs(is_along_row ? p.column - q.column : p.row - q.row);
      const int across = std::abs(is_along_row ? p.row - q.row : p.column - q.column);
      if (along == step && across == 0) all.push_back({one->first, other->first});
    }
  }
  std::vector<std::array<int, 2>> few;
  const std::size_t stride = std::max<std::size_t>((all.size() + 4) / 5, 1);
  for (std::size_t i = stride / 2; i < all.size(); i += stride) few.push_back(all[i]);
  return few;
}

/// The motion between views along rows or columns of the arrangement, at the distance at which it
/// is clearest.
AxisEvidence motion(const ListPictures& pictures, const Arrangement& arrangement,
                    bool is_along_row) {
  AxisEvidence clearest;
  for (int step = 1; step <= kFarthestInList; step *= 2) {
    AxisEvidence evidence;
    for (const auto& [i, j] : neighbours(pictures, arrangement, is_along_row, step)) {
      evidence.add(pictures.at(i), pictures.at(j));
    }
    if (std::abs(evidence.score()) > std::abs(clearest.score())) clearest = evidence;
  }
  return clearest;
}

std::string percent_text(double share) {
  return fixed_text(100 * share, 0) + " %";
}

std::string motion_text(const char* which, const AxisEvidence& evidence) {
  return fmt::format("{} {} of the difference is motion along x and {} along y", which,
                     percent_text(evidence.gone_along_x()), percent_text(evidence.gone_along_y()));
}

ListLayout layout_of(int count, const Arrangement& one, bool is_along_x) {
  const int other = count / one.period;
  ListLayout layout;
  layout.grid = is_along_x ? GridShape{other, one.period} : GridShape{one.period, other};
  if (other == 1) return layout;
  layout.order = one.snake ? (is_along_x ? ListOrder::SnakeRows : ListOrder::SnakeColumns)
                           : (is_along_x ? ListOrder::Rows : ListOrder::Columns);
  return layout;
}

/// Of the difference of neighbors; views that are in order reach several times as much.
constexpr double kParallax = 0.15;

/// What pictures of a line are whose motion does not tell; empty if they show parallax.
std::string text_without_parallax(const AxisEvidence& in_line) {
  const bool has_parallax = std::max(in_line.gone_along_x(), in_line.gone_along_y()) >= kParallax;
  if (!in_line.has_pairs() || has_parallax) return {};
  return ": the pictures differ by something else than parallax, as those of a focal stack do, "
         "which is no light field";
}

/// The arrangement with the image axes along which it runs; not decided if these contradict it.
ListLayout with_axes(int count, const Arrangement& one, const ListPictures& pictures) {
  const AxisEvidence in_rows = motion(pictures, one, true);
  ListLayout layout = layout_of(count, one, !in_rows.is_y());
  if (one.period == count) {
    layout.is_decided = in_rows.is_decided();
    layout.evidence = motion_text("between neighbors", in_rows);
    if (!layout.is_decided) layout.evidence += text_without_parallax(in_rows);
    return layout;
  }
  const AxisEvidence across = motion(pictures, one, false);
  layout.is_decided = (in_rows.is_x() && across.is_y()) || (in_rows.is_y() && across.is_x());
  layout.evidence = motion_text("between neighbors in the list", in_rows) + ", " +
                    motion_text(fmt::format("between views {} apart", one.period).c_str(), across);
  return layout;
}

std::string fit_text(int count, const Fit& fit) {
  const int period = fit.arrangement.period;
  const int rows = (count + period - 1) / period;
  const int missing = rows * period - count;
  std::string name = rows == 1 ? "a line" : fmt::format("{} lines of {}", rows, period);
  if (fit.arrangement.snake) name += " in snake order";
  if (missing > 0) name += fmt::format(", {} of them missing", missing);
  return fmt::format("{}: {} unexplained", name, percent_text(fit.unexplained));
}

/// The only one of the best fits that motion along the image axes does not contradict. `unknown`
/// is the answer without a decision, with the fits as its evidence.
ListLayout chosen(const std::vector<Fit>& found, const ListPictures& pictures, ListLayout unknown,
                  const Progress& progress) {
  const int count = unknown.grid.count();
  const std::string compared = unknown.evidence;
  unknown.evidence = compared + ": none fits";
  ListLayout best = unknown;
  bool is_any_likely = false;
  for (const Fit& fit : found) {
    const int period = fit.arrangement.period;
    const double most = std::min(period == count ? kWorstLine : kWorstFit,
                                 1.5 * (found[0].unexplained + kNegligible) - kNegligible);
    if (fit.unexplained > most) continue;
    is_any_likely = true;
    progress.check();
    ListLayout layout = with_axes(count, fit.arrangement, pictures);
    layout.evidence = compared + "; " + layout.evidence;
    if (!layout.is_decided) {
      if (!best.is_decided) best.evidence = layout.evidence;
      continue;
    }
    if (best.is_decided || count % period != 0) {
      unknown.evidence =
          compared + (best.is_decided ? ": too alike to tell" : ": rows that are not full");
      return unknown;
    }
    best = std::move(layout);
  }
  if (!is_any_likely) {
    best.evidence += text_without_parallax(motion(pictures, {count, false}, true));
  }
  return best;
}

}  // namespace

ViewIndex ListLayout::place(int index) const {
  const bool is_by_rows = order == ListOrder::Rows || order == ListOrder::SnakeRows;
  const bool is_snake = order == ListOrder::SnakeRows || order == ListOrder::SnakeColumns;
  const Arrangement::Place at = Arrangement{is_by_rows ? grid.u : grid.v, is_snake}.place(index);
  return is_by_rows ? ViewIndex{at.row, at.column} : ViewIndex{at.column, at.row};
}

std::string layout_text(const ListLayout& layout) {
  const std::string grid = fmt::format("{}×{}", layout.grid.v, layout.grid.u);
  if (layout.grid.v == 1 || layout.grid.u == 1) return grid;
  switch (layout.order) {
    case ListOrder::Rows:
      return grid + ", row by row";
    case ListOrder::Columns:
      return grid + ", column by column";
    case ListOrder::SnakeRows:
      return grid + ", row by row in snake order";
    case ListOrder::SnakeColumns:
      return grid + ", column by column in snake order";
  }
  return grid;
}

ListLayout find_list_layout(int count, const GreyViewOfList& view, const Progress& progress) {
  if (count < 2) throw InvalidInput("a list of views needs two views at least");
  const ListPictures pictures = load(count, view, progress);
  ListLayout unknown;
  unknown.grid = {1, count};
  if (pictures.size() < 2) {
    unknown.evidence = "the views hold no texture";
    return unknown;
  }
  if (count == 2) return with_axes(2, {2, false}, pictures);

  const std::vector<Fit> found = fits(count, pictures, progress);
  unknown.evidence = "differences between views by distance, as " + fit_text(count, found[0]);
  if (found.size() > 1) unknown.evidence += ", " + fit_text(count, found[1]);
  return chosen(found, pictures, std::move(unknown), progress);
}

ListLayout find_list_layout(const LightField::Samples& samples, const Progress& progress) {
  const GridShape grid = grid_of(samples);
  return find_list_layout(
      grid.count(), [&](int i) { return grey_levels(samples, grid.view_at(i)); }, progress);
}

}  // namespace episcope::io
