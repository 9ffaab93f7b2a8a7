// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/order/misplaced_views.h"

#include "engine/core/finding.h"
#include "engine/core/numbers.h"
#include "engine/core/parallel.h"
#include "engine/core/text.h"
#include "engine/io/models/order/motion_pictures.h"
#include "engine/io/models/order/warp_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace episcope::io {
namespace {

constexpr int kLookedAt_px = 512;
constexpr std::array<int, 2> kSides_px = {160, 40};  ///< Points that move far match in the smaller.
constexpr double kUnlike = 0.8;  ///< Neighbors that are so unlike show no motion any more.
/// Of the unlikeness as stored; views side by side leave .66.
constexpr double kClearlyLess = 0.75;
constexpr double kOutOfPlace = 1.15;  ///< Unlikeness of a view, in that of most.
constexpr std::size_t kMostCandidates = 16;
constexpr std::size_t kMostSentences = 3;

/// Views in their places, which may be exchanged.
class Neighborhood {
 public:
  Neighborhood(GridShape grid, std::vector<Image<float>> pictures)
      : grid_(grid), pictures_(std::move(pictures)), at_(pictures_.size()) {
    std::iota(at_.begin(), at_.end(), std::size_t{0});
  }

  [[nodiscard]] GridShape grid() const { return grid_; }
  [[nodiscard]] std::size_t index(ViewIndex view) const {
    return static_cast<std::size_t>(view.v) * grid_.u + view.u;
  }
  void exchange(ViewIndex a, ViewIndex b) { std::swap(at_[index(a)], at_[index(b)]); }

  /// Grows about linearly with the distance of the cameras, as long as views are alike.
  [[nodiscard]] double unlikeness(ViewIndex a, ViewIndex b) const {
    const double alike = correlation(pictures_[at_[index(a)]], pictures_[at_[index(b)]]);
    return std::sqrt(std::max(0.0, 1 - alike));
  }
  /// Sum over the neighbors of a view but `other`.
  [[nodiscard]] double sum_of(ViewIndex view, std::optional<ViewIndex> other = {}) const {
    double sum = 0;
    for (const ViewIndex next : neighbors(view)) {
      if (!other || !(next == *other)) sum += unlikeness(view, next);
    }
    return sum;
  }
  [[nodiscard]] double mean_of(ViewIndex view) const {
    return sum_of(view) / static_cast<double>(neighbors(view).size());
  }

 private:
  [[nodiscard]] std::vector<ViewIndex> neighbors(ViewIndex view) const {
    std::vector<ViewIndex> found;
    for (const auto& [down, right] : {std::pair(-1, 0), {0, -1}, {0, 1}, {1, 0}}) {
      const ViewIndex next{view.v + down, view.u + right};
      if (grid_.contains(next)) found.push_back(next);
    }
    return found;
  }

  GridShape grid_;
  std::vector<Image<float>> pictures_;
  std::vector<std::size_t> at_;  ///< The picture of each place.
};

/// Of the middle of every view; of a view without texture all 0.
std::vector<Image<float>> pictures_of(const LightField::Samples& samples, int side,
                                      const Progress& progress) {
  return std::visit(
      [&](const auto& stack) {
        const int height = std::min(stack.height(), kLookedAt_px);
        const int width = std::min(stack.width(), kLookedAt_px);
        const PixelRect middle{(stack.height() - height) / 2, (stack.width() - width) / 2, height,
                               width};
        std::vector<Image<float>> pictures(static_cast<std::size_t>(stack.grid().count()));
        parallel_for(stack.grid().count(), progress, [&](int i) {
          const ViewIndex view = stack.grid().view_at(i);
          pictures[static_cast<std::size_t>(i)] =
              band_passed(reduced(grey_levels(samples, view, middle), side));
        });
        return pictures;
      },
      samples);
}

bool has_texture(const Image<float>& picture) {
  return std::ranges::any_of(picture, [](float value) { return value != 0; });
}

bool are_equal(const LightField::Samples& samples, ViewIndex a, ViewIndex b) {
  return std::visit(
      [&](const auto& stack) {
        const auto one = stack.view(a), other = stack.view(b);
        return std::equal(one.data, one.data + stack.view_size(), other.data);
      },
      samples);
}

/// Groups of views that are the same picture; none if those are most.
std::vector<std::vector<ViewIndex>> equal_views(const LightField::Samples& samples,
                                                const std::vector<Image<float>>& pictures) {
  const GridShape grid = grid_of(samples);
  std::vector<std::vector<ViewIndex>> groups;
  std::vector<bool> is_known(pictures.size(), false);
  std::size_t repeated = 0;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (is_known[i] || !has_texture(pictures[i])) continue;
    std::vector<ViewIndex> group{grid.view_at(static_cast<int>(i))};
    for (std::size_t k = i + 1; k < pictures.size(); ++k) {
      const ViewIndex other = grid.view_at(static_cast<int>(k));
      const bool is_same = !is_known[k] && std::ranges::equal(pictures[i], pictures[k]) &&
                           are_equal(samples, group.front(), other);
      if (!is_same) continue;
      is_known[k] = true;
      group.push_back(other);
    }
    repeated += group.size() - 1;
    if (group.size() > 1) groups.push_back(std::move(group));
  }
  if (2 * repeated >= pictures.size()) groups.clear();
  return groups;
}

std::vector<ViewIndex> all_views(GridShape grid) {
  std::vector<ViewIndex> views;
  for (int i = 0; i < grid.count(); ++i) views.push_back(grid.view_at(i));
  return views;
}

/// Of each view to its neighbors, row by row.
std::vector<double> unlikenesses(const Neighborhood& views) {
  std::vector<double> all;
  for (const ViewIndex view : all_views(views.grid())) all.push_back(views.mean_of(view));
  return all;
}

double usual(std::vector<double> unlikenesses) {
  return quantile(unlikenesses, 0.5);
}

/// Unlikeness of every row to the next one, of which one is turned round, as a share of that as
/// stored; of columns with `of_columns`.
double share_if_turned(const Neighborhood& views, bool of_columns) {
  const GridShape grid = views.grid();
  double stored = 0, turned = 0;
  for (const ViewIndex view : all_views(grid)) {
    const ViewIndex next{view.v + (of_columns ? 0 : 1), view.u + (of_columns ? 1 : 0)};
    if (!grid.contains(next)) continue;
    const ViewIndex opposite{of_columns ? grid.v - 1 - next.v : next.v,
                             of_columns ? next.u : grid.u - 1 - next.u};
    stored += views.unlikeness(view, next);
    turned += views.unlikeness(view, opposite);
  }
  return stored > 0 ? turned / stored : 1;
}

std::string turned_text(const Neighborhood& views) {
  const double rows = share_if_turned(views, false), columns = share_if_turned(views, true);
  if (std::min(rows, columns) > kClearlyLess) return {};
  return fmt::format(finding_text("views.snake"),
                     rows <= columns ? finding_text("row") : finding_text("column"),
                     100 * (1 - std::min(rows, columns)));
}

/// The views that are most unlike their neighbors.
std::vector<ViewIndex> candidates(const Neighborhood& views) {
  const std::vector<double> means = unlikenesses(views);
  const double least = kOutOfPlace * usual(means);
  std::vector<std::pair<double, ViewIndex>> found;
  for (const ViewIndex view : all_views(views.grid())) {
    const double mean = means[views.index(view)];
    if (mean > least) found.emplace_back(-mean, view);
  }
  std::ranges::sort(found, {}, [](const auto& one) { return one.first; });
  if (found.size() > kMostCandidates) found.resize(kMostCandidates);
  std::vector<ViewIndex> chosen;
  for (const auto& one : found) chosen.push_back(one.second);
  return chosen;
}

struct Exchange {
  ViewIndex a, b;
  double share = kClearlyLess;  ///< Of the unlikeness as stored.
};

std::optional<Exchange> best_exchange(Neighborhood& views) {
  std::optional<Exchange> best;
  const std::vector<ViewIndex> chosen = candidates(views);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    for (std::size_t k = i + 1; k < chosen.size(); ++k) {
      const ViewIndex a = chosen[i], b = chosen[k];
      const auto sum = [&] { return views.sum_of(a, b) + views.sum_of(b, a); };
      const double stored = sum();
      views.exchange(a, b);
      const double share = sum() / stored;
      views.exchange(a, b);
      if (share < (best ? best->share : kClearlyLess)) best = Exchange{a, b, share};
    }
  }
  return best;
}

std::vector<std::string> exchanged_texts(Neighborhood& views) {
  std::vector<std::string> texts;
  while (texts.size() < kMostSentences) {
    const auto found = best_exchange(views);
    if (!found) break;
    views.exchange(found->a, found->b);
    const bool is_first = views.index(found->a) < views.index(found->b);
    texts.push_back(
        fmt::format(finding_text("views.exchanged"), view_text(is_first ? found->a : found->b),
                    view_text(is_first ? found->b : found->a), 100 * (1 - found->share)));
  }
  return texts;
}

}  // namespace

std::vector<std::string> find_misplaced_views(const LightField::Samples& samples,
                                              const Progress& progress) {
  const GridShape grid = grid_of(samples);
  if (grid.count() < 3) return {};
  std::vector<Image<float>> pictures = pictures_of(samples, kSides_px[0], progress.part(0, 0.8));
  std::vector<std::string> texts;
  for (const auto& group : equal_views(samples, pictures)) {
    if (texts.size() == kMostSentences) break;
    texts.push_back(fmt::format(finding_text("views.same"), joined(group, " and ", view_text)));
  }
  Neighborhood views(grid, std::move(pictures));
  if (usual(unlikenesses(views)) > kUnlike) {
    views = Neighborhood(grid, pictures_of(samples, kSides_px[1], progress.part(0.8, 1)));
  }
  const std::string turned = turned_text(views);
  std::vector<std::string> more =
      turned.empty() ? exchanged_texts(views) : std::vector<std::string>{turned};
  std::ranges::move(more, std::back_inserter(texts));
  return texts;
}

}  // namespace episcope::io
