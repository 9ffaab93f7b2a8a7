// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/kz02.h"

#include "engine/core/finding.h"
#include "engine/core/parallel.h"
#include "engine/disparity/disparity_range.h"
#include "engine/disparity/stereo_costs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>

namespace episcope {

RecentChanges::RecentChanges(int height, int width, int labels)
    : changed_(tile_of(height - 1) + 1, tile_of(width - 1) + 1), expanded_(labels, -1) {}

Image<char> RecentChanges::since(int label) const {
  Image<char> result(changed_.height(), changed_.width());
  for (int y = 0; y < result.height(); ++y) {
    for (int x = 0; x < result.width(); ++x) {
      if (changed_.at(y, x) <= expanded_[label]) continue;
      for (int i = std::max(0, y - 1); i < std::min(result.height(), y + 2); ++i) {
        for (int j = std::max(0, x - 1); j < std::min(result.width(), x + 2); ++j) {
          result.at(i, j) = 1;
        }
      }
    }
  }
  return result;
}

namespace {

constexpr CutGraph::Cost kForbidden = CutGraph::kForbidden;

bool is_inside(const Image<std::int16_t>& image, PixelIndex at) {
  return at.y >= 0 && at.y < image.height() && at.x >= 0 && at.x < image.width();
}

// Costs of two pixels that keep their labels or take α.
struct PairCosts {
  CutGraph::Cost keep_keep, keep_take, take_keep, take_take;
};

// The costs of two nodes, or of one where the other is fixed: that keeps its label.
void add_pair(int p, int q, const PairCosts& costs, CutGraph& graph) {
  if (p < 0 && q < 0) return;
  if (p < 0) return graph.add_terminal(q, costs.keep_take - costs.keep_keep);
  if (q < 0) return graph.add_terminal(p, costs.take_keep - costs.keep_keep);
  const CutGraph::Cost mixed =
      costs.keep_take + costs.take_keep - costs.keep_keep - costs.take_take;
  assert(mixed >= 0);  // submodular
  // Divided so that few nodes get costs of their own.
  const CutGraph::Cost backward = std::clamp(costs.take_keep - costs.keep_keep, 0, mixed);
  const CutGraph::Cost of_p = costs.take_keep - costs.keep_keep - backward;
  graph.add_terminal(p, of_p);
  graph.add_terminal(q, costs.take_take - costs.keep_keep - of_p);
  if (mixed > 0) graph.add_edge(p, q, mixed - backward, backward);
}

// Two pixels that see the same point at α: they gain by it if both have α in the end, and neither
// may look through it.
PairCosts costs_at_new_label(int f_p, int f_q, int alpha, CutGraph::Cost gain) {
  const auto if_other_takes = [&](int kept) {
    return kept < alpha ? kForbidden : kept == alpha ? gain : 0;
  };
  return {0, if_other_takes(f_p), if_other_takes(f_q), gain};
}

// A pixel with label f_p and the one that sees the same point at f_p: they gain by it if both have
// f_p and keep it; the other must not take a farther one alone.
PairCosts costs_at_old_label(int f_p, int f_q, int alpha, CutGraph::Cost gain) {
  const CutGraph::Cost looks_through = alpha < f_p ? kForbidden : 0;
  if (f_q == f_p) return {gain, looks_through, looks_through, 0};
  return {0, looks_through, 0, 0};
}

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
            {"Match limit K",
             "Two pixels can see the same point if their squared difference, the mean over the "
             "channels, is less; 0 finds it by the rule below",
             "(1/255)²"},
            {0, 10000})
      .choice(
          "limit_rule", &P::rule,
          {"Automatic limit K",
           "noise: three times the least difference of a pixel at any label, the median over "
           "pixels, at least 30; quarter: the mean of what a quarter of the labels fall below"});
}

Schema<Kz02Parameters> kz02_schema() {
  using P = Kz02Parameters;
  return Schema<P>()
      .part(&P::profile, profile_schema())
      .integer("labels", &P::labels,
               {"Disparity steps", "Number of equidistant disparities tested"}, {2, 512, true})
      .integer("distance", &P::distance,
               {"Side view distance",
                "How far the views on the left, on the right, above and below are from the "
                "estimated one. Farther views tell disparities apart better but see less of what "
                "is partly occluded",
                "view steps"},
               {1, 16})
      .part(&P::matching, matching_schema())
      .real("smoothness", &P::smoothness,
            {"Smoothness λ",
             "Cost of a jump by one label between neighbors, as a multiple of K; "
             "three times as much where they have the same color"},
            {0, 4})
      .integer("truncation", &P::truncation,
               {"Truncation T", "Jumps by more steps cost no more", "steps"}, {1, 64, true})
      .integer("cycles", &P::cycles,
               {"Maximum cycles", "How often every label is expanded, at most"}, {1, 100, true})
      .choice("refinement", &P::refinement,
              {"Refinement",
               "How the disparity is interpolated between labels, from the costs over all views"})
      .interval("range", &P::range, {"Disparity range", kRangeHelp, "px"}, {-20, 20})
      .view("view", &P::view,
            {"View", "Row and column of the view to estimate; auto = center view"})
      .search("smoothness", {0.005, 0.01, 0.02, 0.05, 0.2})
      .search("distance", {2, 3, 4})
      .preset(kProfileKey, kPaperProfile,
              {{"comparison", std::string("whole_pixels")},
               {"limit_rule", std::string("quarter")},
               {"refinement", std::string("none")},
               {"smoothness", kPublishedSmoothness}});
}

}  // namespace

LabelExpansion::LabelExpansion(const MultiCameraEnergy& energy, CameraLabels start)
    : energy_(energy),
      labels_(std::move(start)),
      changes_(labels_[0].height(), labels_[0].width(), energy.interactions().labels()) {
  const Interactions& interactions = energy.interactions();
  const int height = interactions.height(), width = interactions.width();
  nodes_.assign(energy.views(), Image<std::int32_t>(height, width));
  std::vector<std::int32_t> gains(width);
  for (int side = 0; side + 1 < energy.views(); ++side) {
    gains_.emplace_back(height, width);
    for (int y = 0; y < height; ++y) {
      const std::int16_t* const f = labels_[0].row(y);
      for (int label = 0; label < interactions.labels(); ++label) {
        if (std::find(f, f + width, label) == f + width) continue;
        interactions.gains(side, label, y, gains.data());
        for (int x = 0; x < width; ++x) {
          if (f[x] == label) gains_[side].at(y, x) = gains[x];
        }
      }
    }
  }
}

std::int32_t LabelExpansion::gain(int side, int y, int x) const {
  const int label = labels_[0].at(y, x);
  const PixelIndex q = energy_.interactions().sides()[side].place(y, x, label);
  const Image<std::int16_t>& other = labels_[side + 1];
  return is_inside(other, q) && other.at(q.y, q.x) == label ? gains_[side].at(y, x) : 0;
}

std::optional<std::int64_t> LabelExpansion::expand(int alpha, const Progress& progress) {
  const int nodes = number_nodes(alpha);
  std::int64_t change = 0;
  if (nodes > 0) {
    const auto cut = build(alpha, nodes, progress).solve(progress);
    if (!cut) return std::nullopt;
    changes_.begin(alpha);
    take(alpha, *cut);
    change = cut->cost - cut->cost_at_source;
  }
  return change;
}

int LabelExpansion::number_nodes(int alpha) {
  const Image<char> tiles = changes_.since(alpha);
  int count = 0;
  for (int view = 0; view < energy_.views(); ++view) {
    for (int y = 0; y < labels_[view].height(); ++y) {
      const std::int16_t* const f = labels_[view].row(y);
      const char* const may_move = tiles.row(RecentChanges::tile_of(y));
      std::int32_t* const node = nodes_[view].row(y);
      for (int x = 0; x < labels_[view].width(); ++x) {
        const bool moves = f[x] != alpha && may_move[RecentChanges::tile_of(x)] != 0;
        node[x] = moves ? count++ : kFixed;
      }
    }
  }
  return count;
}

CutGraph LabelExpansion::build(int alpha, int nodes, const Progress& progress) const {
  CutGraph graph(nodes);
  // Two neighbors and about two pixels of other views each.
  graph.reserve(4 * static_cast<std::size_t>(nodes));
  const int height = labels_[0].height();
  for (int view = 0; view < energy_.views(); ++view) {
    for (int y = 0; y < height; ++y) {
      progress.check();
      add_smoothness(view, y, alpha, graph);
    }
  }
  for (int side = 0; side + 1 < energy_.views(); ++side) {
    for (int y = 0; y < height; ++y) {
      progress.check();
      add_interactions(side, y, alpha, graph);
      add_visibility_of_side(side, y, alpha, graph);
    }
  }
  return graph;
}

void LabelExpansion::add_smoothness(int view, int y, int alpha, CutGraph& graph) const {
  const Image<std::int16_t>& f = labels_[view];
  const auto add_row = [&](int y1, int dx, const std::int32_t* weight) {
    const std::int16_t *const here = f.row(y), *const there = f.row(y1) + dx;
    const std::int32_t *const p = nodes_[view].row(y), *const q = nodes_[view].row(y1) + dx;
    for (int x = 0; x + dx < f.width(); ++x) {
      const auto jump = [&](int a, int b) {
        return weight[x] * std::min(std::abs(a - b), energy_.truncation());
      };
      if (p[x] < 0 && q[x] < 0) continue;
      add_pair(p[x], q[x],
               {jump(here[x], there[x]), jump(here[x], alpha), jump(alpha, there[x]), 0}, graph);
    }
  };
  add_row(y, 1, energy_.to_right(view, y));
  if (y + 1 < f.height()) add_row(y + 1, 0, energy_.below(view, y));
}

void LabelExpansion::add_interactions(int side, int y, int alpha, CutGraph& graph) const {
  const SideView& there = energy_.interactions().sides()[side];
  const Image<std::int16_t>& other = labels_[side + 1];
  thread_local std::vector<std::int32_t> gains;
  gains.resize(other.width());
  energy_.interactions().gains(side, alpha, y, gains.data());
  for (int x = 0; x < other.width(); ++x) {
    const int p = nodes_[0].at(y, x), f_p = labels_[0].at(y, x);
    if (const PixelIndex at = there.place(y, x, alpha); is_inside(other, at)) {
      const PairCosts costs = costs_at_new_label(f_p, other.at(at.y, at.x), alpha, gains[x]);
      add_pair(p, nodes_[side + 1].at(at.y, at.x), costs, graph);
    }
    if (f_p == alpha) continue;
    if (const PixelIndex at = there.place(y, x, f_p); is_inside(other, at)) {
      const int f_q = other.at(at.y, at.x);
      const PairCosts costs = costs_at_old_label(f_p, f_q, alpha, gains_[side].at(y, x));
      add_pair(p, nodes_[side + 1].at(at.y, at.x), costs, graph);
    }
  }
}

// What the side view keeps, where the reference view sees something nearer.
void LabelExpansion::add_visibility_of_side(int side, int y, int alpha, CutGraph& graph) const {
  const SideView& there = energy_.interactions().sides()[side];
  const Image<std::int16_t>& reference = labels_[0];
  const std::int16_t* const f = labels_[side + 1].row(y);
  const std::int32_t* const q = nodes_[side + 1].row(y);
  for (int x = 0; x < reference.width(); ++x) {
    if (f[x] <= alpha) continue;
    const PixelIndex at = there.place_in_reference(y, x, f[x]);
    if (!is_inside(reference, at) || reference.at(at.y, at.x) == f[x]) continue;
    add_pair(q[x], nodes_[0].at(at.y, at.x),
             costs_at_old_label(f[x], reference.at(at.y, at.x), alpha, 0), graph);
  }
}

void LabelExpansion::take(int alpha, const MinimalCut& cut) {
  const int height = labels_[0].height(), width = labels_[0].width();
  std::vector<std::int32_t> gains(width);
  for (int view = 0; view < energy_.views(); ++view) {
    for (int y = 0; y < height; ++y) {
      std::int16_t* const f = labels_[view].row(y);
      const std::int32_t* const node = nodes_[view].row(y);
      bool changed = false;
      for (int x = 0; x < width; ++x) {
        if (node[x] < 0 || cut.at_sink[node[x]] == 0) continue;
        f[x] = static_cast<std::int16_t>(alpha);
        changes_.mark(y, x);
        changed = true;
      }
      if (!changed || view > 0) continue;
      for (int side = 0; side + 1 < energy_.views(); ++side) {
        energy_.interactions().gains(side, alpha, y, gains.data());
        for (int x = 0; x < width; ++x) {
          if (f[x] == alpha) gains_[side].at(y, x) = gains[x];
        }
      }
    }
  }
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
  estimate.notes.push_back(fmt::format(
      fmt::runtime(expanded.converged ? finding_text("cuts.minimum") : finding_text("cuts.ended")),
      interactions.limit(), -static_cast<double>(expanded.change) / Interactions::kUnit,
      expanded.cycles));
  return estimate;
}

Estimator kz02_estimator() {
  return make_estimator<Kz02Parameters>(
      {.id = "kz02",
       .name = "KZ02",
       .summary = "Scene reconstruction from five views by graph cuts, with visibility",
       .reference = "Kolmogorov and Zabih 2002 [KZ02]",
       .iterative = true,
       .revision = 3,
       .main_parameters = {"range", "labels", "smoothness"}},
      kz02_schema(),
      [](const LightField& light_field, const Kz02Parameters& parameters, ViewSelection,
         const Progress& progress) { return estimate_kz02(light_field, parameters, progress); });
}

}  // namespace episcope
