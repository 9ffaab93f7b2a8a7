// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/cuts/kz02.h"

#include "engine/core/parallel/parallel.h"
#include "engine/disparity/common/disparity_range.h"
#include "engine/disparity/common/matching_cost.h"
#include "engine/disparity/common/sub_label.h"
#include "engine/disparity/cuts/label_expansion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <string>
#include <vector>

namespace episcope {
namespace {

std::vector<int> order_of(int labels, const char* how) {
  std::vector<int> order(labels);
  std::iota(order.begin(), order.end(), 0);
  if (how && how[0] == 'd') std::reverse(order.begin(), order.end());
  if (how && how[0] == 's') {
    int step = 1;
    while (step * 2 < labels) step *= 2;
    std::vector<int> strided;
    std::vector<char> seen(labels, 0);
    for (; step >= 1; step /= 2)
      for (int l = step / 2; l < labels; l += step)
        if (!seen[l]) { seen[l] = 1; strided.push_back(l); }
    order = strided;
  }
  return order;
}

}  // namespace

Schema<Kz02Parameters> kz02_schema() {
  using P = Kz02Parameters;
  return Schema<P>()
      .choice("profile", &P::profile, {"Profile", "x"})
      .integer("labels", &P::labels, {"Labels", "Number of equidistant disparities tested"},
               {2, 512, true})
      .integer("distance", &P::distance, {"Distance of side views", "x", "view steps"}, {1, 16})
      .real("limit", &P::limit, {"Limit K", "x"}, {0, 10000})
      .real("smoothness", &P::smoothness, {"Smoothness λ", "x"}, {0, 4})
      .integer("truncation", &P::truncation, {"Truncation T", "x", "labels"}, {1, 64})
      .integer("cycles", &P::cycles, {"Cycles", "x"}, {1, 100})
      .choice("refinement", &P::refinement,
              {"Refinement", "How the disparity is interpolated between labels"})
      .interval("range", &P::range, {"Disparity range", "x", "px"}, {-20, 20})
      .view("view", &P::view, {"View", "x"});
}

Estimate estimate_kz02(const LightField& lf, const Kz02Parameters& p, const Progress& progress) {
  const ViewIndex view = p.view.value_or(lf.center());
  check_matching(lf, view);
  Estimate estimate;
  estimate.range = search_range(lf, p.range, progress.part(0, 0.02));
  const std::vector<float> labels = equidistant_labels(estimate.range, p.labels);
  Stopwatch watch;
  const Interactions interactions(
      lf, view, side_views(lf.grid(), view, p.distance, labels),
      p.profile == Profile::Paper ? Comparison::WholePixels : Comparison::BetweenPixels, p.limit,
      progress.part(0.02, 0.03));
  std::fprintf(stderr, "K %.1f  %.2f s\n", interactions.limit(), watch.seconds());
  const MultiCameraEnergy energy(
      interactions,
      {static_cast<std::int32_t>(std::lround(p.smoothness * Interactions::kUnit)), p.truncation});
  LabelExpansion expansion(energy, energy.farthest());
  int idle = 0;
  std::fprintf(stderr, "set up %.2f s\n", watch.seconds());
  const std::vector<int> order = order_of(p.labels, std::getenv("KZ_ORDER"));
  std::int64_t total = 0;
  for (int cycle = 0; cycle < p.cycles && idle < p.labels; ++cycle) {
    int changed = 0;
    for (int label : order) {
      const auto change = expansion.expand(label, progress);
      if (!change) break;
      total += *change;
      if (*change < 0) { idle = 0; ++changed; } else if (++idle >= p.labels) break;
    }
    std::fprintf(stderr, "cycle %d: E %lld, %d changed, %.1f s\n", cycle, (long long)total, changed,
                 watch.seconds());
  }
  if (std::getenv("KZ_CHECK")) {
    auto e = energy.of(expansion.labels()), s = energy.of(energy.farthest());
    std::fprintf(stderr, "check: %lld = %lld\n", e ? (long long)(*e - *s) : -1LL, (long long)total);
  }
  estimate.field.disparity = ViewStack<float>({1, 1}, lf.height(), lf.width(), 1, view);
  const auto map = estimate.field.disparity.view(view);
  const float step = labels[1] - labels[0];
  const MatchingCost cost{MatchedViews::All, Interpolation::Cubic, 0.05};
  const bool refine = p.refinement != Refinement::None && p.profile != Profile::Paper;
  parallel_for_workers(lf.height(), progress, [&] {
    return [&, matching = MatchingCostRows(lf, view, cost, labels),
            row = Volume<float>(1, p.labels, lf.width())](int y) mutable {
      if (refine) matching.compute(y, row.view(), progress);
      for (int x = 0; x < lf.width(); ++x) {
        const int l = expansion.labels()[0].at(y, x);
        float place = l;
        if (refine && l > 0 && l + 1 < p.labels)
          place += sub_label_offset(row.view().at(0, l - 1, x), row.view().at(0, l, x),
                                    row.view().at(0, l + 1, x), p.refinement);
        map.at(y, x) = labels[0] + place * step;
      }
    };
  });
  return estimate;
}

Estimator kz02_estimator() {
  return make_estimator<Kz02Parameters>(
      {.id = "kz02",
       .name = "KZ02",
       .summary = "Graph cuts over five views",
       .reference = "Kolmogorov and Zabih 2002 [KZ02]",
       .iterative = true},
      kz02_schema(),
      [](const LightField& light_field, const Kz02Parameters& parameters, ViewSelection,
         const Progress& progress) { return estimate_kz02(light_field, parameters, progress); });
}

}  // namespace episcope
