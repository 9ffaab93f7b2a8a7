// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/cuts/label_expansion.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>

namespace episcope {
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
  // Two neighbours and about two pixels of other views each.
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

}  // namespace episcope
