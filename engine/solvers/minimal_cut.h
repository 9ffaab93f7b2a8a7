// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace episcope {

/// Which side of a cut every node is on.
struct MinimalCut {
  std::int64_t cost = 0;                   ///< Of this cut: the least of all.
  std::int64_t cost_at_source = 0;         ///< With all nodes on the source's side.
  std::vector<std::uint8_t> at_sink = {};  ///< [node], 1 = on the sink's side.
};

/// A directed graph of millions of nodes of small degree, each on the side of a source or of a
/// sink; every choice of sides has a cost. Finds one of least cost by a maximal flow: the algorithm
/// of Boykov and Kolmogorov 2004 [BK04], as Boost.Graph has it. While solving, about 48 bytes an
/// edge and 32 a node.
class CutGraph {
 public:
  using Cost = std::int32_t;
  /// For what no cut may do. All that can flow through one edge must be less, so finite costs have
  /// to be far smaller.
  static constexpr Cost kForbidden = Cost{1} << 29;

  /// Throws InvalidInput if `nodes` is negative.
  explicit CutGraph(int nodes);

  void reserve(std::size_t edges) { edges_.reserve(edges); }
  /// Adds `cost` to a node on the sink's side; if negative, −`cost` to it on the source's side.
  void add_terminal(int node, Cost cost) {
    terminals_[node] = std::min(terminals_[node] + cost, kForbidden);
  }
  /// Adds `forward` ≥ 0 if `from` is on the source's side and `to` ≠ `from` on the sink's, and
  /// `backward` ≥ 0 the other way round.
  void add_edge(int from, int to, Cost forward, Cost backward);

  /// Finds a cut of least cost; of several, the one with the fewest nodes on the sink's side.
  /// Single- threaded. None if `progress.finish_requested()` while it computes. Throws Cancelled
  /// within milliseconds of a stop request, InvalidInput beyond 2³¹ − 1 edges.
  [[nodiscard]] std::optional<MinimalCut> solve(const Progress& progress) const;

 private:
  struct Edge {
    int from, to;
    Cost forward, backward;
  };

  std::vector<Cost> terminals_;
  std::vector<Edge> edges_;
};

}  // namespace episcope
