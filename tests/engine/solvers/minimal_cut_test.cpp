// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/solvers/minimal_cut.h"
#include "tests/test_main.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <random>
#include <stop_token>
#include <vector>

namespace episcope::in_minimal_cut_test {

namespace {

struct Edge {
  int from, to, forward, backward;
};

struct Graph {
  std::vector<int> terminals;
  std::vector<Edge> edges;

  [[nodiscard]] CutGraph cut_graph() const {
    CutGraph graph(static_cast<int>(terminals.size()));
    for (int node = 0; node < static_cast<int>(terminals.size()); ++node) {
      graph.add_terminal(node, terminals[node]);
    }
    for (const Edge& edge : edges) {
      graph.add_edge(edge.from, edge.to, edge.forward, edge.backward);
    }
    return graph;
  }

  // `sides`: one bit a node, 1 = the sink's.
  [[nodiscard]] std::int64_t cost(unsigned sides) const {
    std::int64_t sum = 0;
    for (std::size_t node = 0; node < terminals.size(); ++node) {
      const int cost = terminals[node];
      sum += (sides >> node & 1U) != 0 ? std::max(cost, 0) : std::max(-cost, 0);
    }
    for (const Edge& edge : edges) {
      const bool from = (sides >> edge.from & 1U) != 0, to = (sides >> edge.to & 1U) != 0;
      if (!from && to) sum += edge.forward;
      if (from && !to) sum += edge.backward;
    }
    return sum;
  }
};

Graph random_graph(std::mt19937& random) {
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  Graph graph;
  const int nodes = 1 + below(9);
  for (int i = 0; i < nodes; ++i) graph.terminals.push_back(below(21) - 10);
  for (int i = 0; i < 3 * nodes; ++i) {
    const int from = below(nodes), to = below(nodes);
    if (from == to) continue;
    const int forward = below(10) == 0 ? CutGraph::kForbidden : below(12);
    graph.edges.push_back({from, to, forward, below(3) == 0 ? below(12) : 0});
  }
  return graph;
}

// A square of nodes with costs of both signs: large enough that it takes a while.
CutGraph large_graph() {
  constexpr int kSide = 300;
  std::mt19937 random(5);
  CutGraph graph(kSide * kSide);
  for (int i = 0; i < kSide * kSide; ++i) {
    graph.add_terminal(i, static_cast<int>(random() % 2001) - 1000);
    if (i % kSide + 1 < kSide) graph.add_edge(i, i + 1, 400, 400);
    if (i + kSide < kSide * kSide) graph.add_edge(i, i + kSide, 400, 400);
  }
  return graph;
}

}  // namespace

class MinimalCutTest : public QObject {
  Q_OBJECT

 private slots:
  void smallGraphs_areCutAsByTryingAll() {
    std::mt19937 random(3);
    for (int trial = 0; trial < 2000; ++trial) {
      const Graph graph = random_graph(random);
      const auto nodes = graph.terminals.size();
      unsigned best = 0;
      for (unsigned sides = 1; sides < 1U << nodes; ++sides) {
        const std::int64_t cost = graph.cost(sides), least = graph.cost(best);
        const bool has_fewer = std::popcount(sides) < std::popcount(best);
        if (cost < least || (cost == least && has_fewer)) best = sides;
      }

      const auto cut = graph.cut_graph().solve(Progress(1));

      unsigned found = 0;
      for (std::size_t i = 0; i < nodes; ++i) found |= unsigned{cut->at_sink[i]} << i;
      QCOMPARE(found, best);
      QCOMPARE(cut->cost, graph.cost(best));
      QCOMPARE(cut->cost_at_source, graph.cost(0));
    }
  }

  // 400 nodes of 2²⁴ each: more than the type of one cost holds.
  void cost_mayExceedThatOfAnEdge() {
    CutGraph graph(800);
    for (int i = 0; i < 400; ++i) {
      graph.add_terminal(2 * i, 1 << 24);
      graph.add_terminal(2 * i + 1, -(1 << 24));
      graph.add_edge(2 * i, 2 * i + 1, CutGraph::kForbidden, 0);
    }
    QCOMPARE(graph.solve(Progress(1))->cost, std::int64_t{400} << 24);
  }

  void forbiddenTerminals_doNotAddUp() {
    CutGraph graph(1);
    for (int i = 0; i < 10; ++i) graph.add_terminal(0, CutGraph::kForbidden);
    graph.add_terminal(0, -1000);
    const auto cut = graph.solve(Progress(1));
    QCOMPARE(int{cut->at_sink[0]}, 0);
  }

  void emptyGraph_costsNothing() {
    QCOMPARE(CutGraph(0).solve(Progress(1))->cost, std::int64_t{0});
    QCOMPARE(CutGraph(3).solve(Progress(1))->cost, std::int64_t{0});
    QVERIFY_THROWS_EXCEPTION(InvalidInput, CutGraph(-1));
  }

  void stop_throwsCancelled() {
    std::stop_source stop;
    stop.request_stop();
    const Progress progress(stop.get_token(), nullptr);
    QVERIFY_THROWS_EXCEPTION(Cancelled, (void)large_graph().solve(progress));
  }

  void finish_givesNoCut() {
    std::stop_source finish;
    finish.request_stop();
    const Progress progress({}, finish.get_token(), nullptr);
    QVERIFY(!large_graph().solve(progress).has_value());
    QVERIFY(large_graph().solve(Progress(1)).has_value());
  }
};

}  // namespace episcope::in_minimal_cut_test

EPISCOPE_TEST(minimal_cut_test, MinimalCutTest)
#include "minimal_cut_test.moc"
