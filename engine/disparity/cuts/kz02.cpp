// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/cuts/kz02.h"

#include "engine/core/parallel/parallel.h"
#include "engine/disparity/common/disparity_range.h"
#include "engine/disparity/cuts/label_expansion.h"
#include "engine/disparity/stereo/stereo_costs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace episcope {
namespace {

// λ of the published heuristic, in K [KMT14].
constexpr double kPublishedSmoothness = 0.2;

// Share of the time that is left after `cycle` cycles: most labels find their place in the first.
double time_left(int cycle) {
  return std::pow(0.2, cycle);
}

// The middle label, those half-way to the ends, and so on.
std::vector<int> coarse_to_fine(int labels) {
  std::vector<int> order;
  std::vector<char> is_listed(labels, 0);
  for (int step = labels; step >= 1; step /= 2) {
    for (int label = step / 2; label < labels; label += step) {
      if (is_listed[label] == 0) order.push_back(label);
      is_listed[label] = 1;
    }
  }
  for (int label = 0; label < labels; ++label) {
    if (is_listed[label] == 0) order.push_back(label);
  }
  return order;
}

struct Expanded {
  int cycles = 0;  // begun
  bool converged = false;
  std::int64_t change = 0;  // of the energy
};

Expanded expand_all(const Kz02Parameters& parameters, LabelExpansion& expansion,
                    const Progress& progress) {
  Expanded result;
  const std::vector<int> order = coarse_to_fine(parameters.labels);
  int unchanged = 0;  // labels in succession
  for (; result.cycles < parameters.cycles && !result.converged; ++result.cycles) {
    const Progress cycle =
        progress.part(1 - time_left(result.cycles), 1 - time_left(result.cycles + 1));
    for (std::size_t i = 0; i < order.size() && !result.converged; ++i) {
      const auto change = expansion.expand(order[i], cycle);
      if (!change) return result;
      result.change += *change;
      unchanged = *change < 0 ? 0 : unchanged + 1;
      result.converged = unchanged >= parameters.labels;
      cycle.report(static_cast<double>(i + 1) / static_cast<double>(order.size()));
    }
  }
  progress.report(1);
  return result;
}

// Disparities of the labels, and as confidence which share of the possible gain is reached.
void read_labels(const LabelExpansion& expansion, const Interactions& interactions,
                 const std::vector<float>& labels, ViewIndex view, Estimate& estimate) {
  const Image<std::int16_t>& f = expansion.labels()[0];
  const int sides = static_cast<int>(interactions.sides().size());
  estimate.field.disparity = ViewStack<float>({1, 1}, f.height(), f.width(), 1, view);
  estimate.confidence = ViewStack<float>({1, 1}, f.height(), f.width(), 1, view);
  const auto most = static_cast<float>(sides * Interactions::kUnit);
  for (int y = 0; y < f.height(); ++y) {
    for (int x = 0; x < f.width(); ++x) {
      int gain = 0;
      for (int side = 0; side < sides; ++side) gain -= expansion.gain(side, y, x);
      estimate.field.disparity.view(view).at(y, x) = labels[f.at(y, x)];
      estimate.confidence.view(view).at(y, x) = static_cast<float>(gain) / most;
    }
  }
}

// Moves each pixel between its label and the next by the matching costs over all views.
void refine(const LightField& lf, const Kz02Parameters& parameters, const Image<std::int16_t>& f,
            ViewIndex view, Estimate& estimate, const Progress& progress) {
  const StereoCosts costs = prepare_stereo(
      lf, MatchedViews::All, {.labels = parameters.labels, .range = estimate.range, .view = view},
      progress.part(0, 0.1));
  const float step = costs.labels[1] - costs.labels[0];
  const ImageView<float> disparity = estimate.field.disparity.view(view);
  const int rows = stereo_band_rows(lf.height());
  parallel_for_workers((lf.height() + rows - 1) / rows, progress.part(0.1, 1), [&] {
    return [&, source = StereoCostRows(lf, costs)](int i) mutable {
      const int first = i * rows;
      const auto band = source.compute(first, std::min(rows, lf.height() - first), progress);
      for (int y = 0; y < band.height; ++y) {
        for (int x = 0; x < band.width; ++x) {
          const int label = f.at(first + y, x);
          if (label == 0 || label + 1 == band.layers) continue;
          disparity.at(first + y, x) +=
              step * sub_label_offset(band.at(y, label - 1, x), band.at(y, label, x),
                                      band.at(y, label + 1, x), parameters.refinement);
        }
      }
    };
  });
}

Schema<Matching> matching_schema() {
  using P = Matching;
  return Schema<P>()
      .choice("comparison", &P::comparison,
              {"Comparison",
               "Whether views are compared at the nearest pixels or interpolated between them"})
      .real("limit", &P::limit,
            {"Limit K",
             "Two pixels can see the same point if their squared difference, the mean over the "
             "channels, is less; 0 finds it by the rule below",
             "(1/255)²"},
            {0, 10000})
      .choice(
          "limit_rule", &P::rule,
          {"Rule for K",
           "noise: three times the least difference of a pixel at any label, the median over "
           "pixels, at least 30; quarter: the mean of what a quarter of the labels fall below"});
}

}  // namespace

Schema<Kz02Parameters> kz02_schema() {
  using P = Kz02Parameters;
  return Schema<P>()
      .part(&P::profile, profile_schema())
      .integer("labels", &P::labels, {"Labels", "Number of equidistant disparities tested"},
               {2, 512, true})
      .integer("distance", &P::distance,
               {"Distance of side views",
                "How far the views on the left, on the right, above and below are from the "
                "estimated one. Farther views tell disparities apart better but see less of what "
                "is partly occluded",
                "view steps"},
               {1, 16})
      .part(&P::matching, matching_schema())
      .real("smoothness", &P::smoothness,
            {"Smoothness λ",
             "Cost of a jump by one label between neighbours, as a multiple of K; "
             "three times as much where they have the same colour"},
            {0, 4})
      .integer("truncation", &P::truncation,
               {"Truncation T", "Jumps by more labels cost no more", "labels"}, {1, 64, true})
      .integer("cycles", &P::cycles, {"Cycles", "How often every label is expanded, at most"},
               {1, 100, true})
      .choice("refinement", &P::refinement,
              {"Refinement",
               "How the disparity is interpolated between labels, from the costs over all views"})
      .interval("range", &P::range, {"Disparity range", kRangeHelp, "px"}, {-20, 20})
      .view("view", &P::view,
            {"View", "Row and column of the view to estimate; auto = centre view"})
      .search("smoothness", {0.005, 0.01, 0.02, 0.05, 0.2})
      .search("distance", {2, 3, 4})
      .preset(kProfileKey, kPaperProfile,
              {{"comparison", std::string("whole_pixels")},
               {"limit_rule", std::string("quarter")},
               {"refinement", std::string("none")},
               {"smoothness", kPublishedSmoothness}});
}

Estimate estimate_kz02(const LightField& lf, const Kz02Parameters& parameters,
                       const Progress& progress) {
  const ViewIndex view = parameters.view.value_or(lf.center());
  check_matching(lf, view);
  Estimate estimate;
  estimate.range = search_range(lf, parameters.range, progress.part(0, 0.02));
  const std::vector<float> labels = equidistant_labels(estimate.range, parameters.labels);
  progress.step("data term");
  const Interactions interactions(lf, view,
                                  side_views(lf.grid(), view, parameters.distance, labels),
                                  parameters.matching, progress.part(0.02, 0.04));
  const auto weight =
      static_cast<std::int32_t>(std::lround(parameters.smoothness * Interactions::kUnit));
  const MultiCameraEnergy energy(interactions, {weight, parameters.truncation});
  LabelExpansion expansion(energy, energy.farthest());
  const bool is_refined = parameters.refinement != Refinement::None;
  progress.step("graph cuts");
  const Expanded expanded =
      expand_all(parameters, expansion, progress.part(0.04, is_refined ? 0.95 : 1));
  read_labels(expansion, interactions, labels, view, estimate);
  if (is_refined) {
    progress.step("between labels");
    refine(lf, parameters, expansion.labels()[0], view, estimate, progress.part(0.95, 1));
  }
  estimate.notes.push_back(
      fmt::format("K = {:.1f} (1/255)²; energy fell by {:.0f} K in {} cycles{}",
                  interactions.limit(), -static_cast<double>(expanded.change) / Interactions::kUnit,
                  expanded.cycles, expanded.converged ? ", to a minimum" : ""));
  return estimate;
}

Estimator kz02_estimator() {
  return make_estimator<Kz02Parameters>(
      {.id = "kz02",
       .name = "KZ02",
       .summary = "Scene reconstruction from five views by graph cuts, with visibility",
       .reference = "Kolmogorov and Zabih 2002 [KZ02]",
       .iterative = true,
       .revision = 2},
      kz02_schema(),
      [](const LightField& light_field, const Kz02Parameters& parameters, ViewSelection,
         const Progress& progress) { return estimate_kz02(light_field, parameters, progress); });
}

}  // namespace episcope
