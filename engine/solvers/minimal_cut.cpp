// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/minimal_cut.h"

#include "engine/core/error.h"

#include <fmt/format.h>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>

#include <cassert>
#include <limits>
#include <utility>

namespace episcope {
namespace {

using Graph =
    boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, boost::no_property,
                                       boost::no_property, unsigned, unsigned>;
using Vertex = boost::graph_traits<Graph>::vertex_descriptor;
using Arc = boost::graph_traits<Graph>::edge_descriptor;
using Color = boost::default_color_type;

struct FinishRequested {};

// Ends the library's loops, which know nothing of a progress, by an exception from the maps that
// they cannot go on without.
class Poll {
 public:
  explicit Poll(const Progress& progress) : progress_(progress) {}

  void count() {
    if (--left_ > 0) return;
    left_ = kEvery;
    progress_.check();
    if (progress_.finish_requested()) throw FinishRequested{};
  }

 private:
  // Reads of a map: a millisecond or so.
  static constexpr int kEvery = 1 << 15;

  const Progress& progress_;
  int left_ = kEvery;
};

// A property map of vertices that polls whenever it is read or written.
struct PolledColors {
  using key_type = Vertex;
  using value_type = Color;
  using reference = Color;
  using category = boost::read_write_property_map_tag;

  Color* colors;
  Poll* poll;

  friend Color get(const PolledColors& map, Vertex vertex) {
    map.poll->count();
    return map.colors[vertex];
  }
  friend void put(const PolledColors& map, Vertex vertex, Color color) {
    map.poll->count();
    map.colors[vertex] = color;
  }
};

// The arc back, from its place among the arcs.
struct ReverseArcs {
  using key_type = Arc;
  using value_type = Arc;
  using reference = Arc;
  using category = boost::readable_property_map_tag;

  const unsigned* places;
  const Graph* graph;

  friend Arc get(const ReverseArcs& map, const Arc& arc) {
    return {target(arc, *map.graph), map.places[arc.idx]};
  }
};

// Arcs ordered by the node they leave, each edge as an arc and its reverse.
class Arcs {
 public:
  Arcs(int nodes, std::size_t edges)
      : next_(nodes + 1, 0), ends_(2 * edges), capacities_(2 * edges), reverse_(2 * edges) {}

  // All edges must be counted before the first is placed.
  void count(unsigned from, unsigned to) {
    ++next_[from + 1];
    ++next_[to + 1];
  }
  void begin_placing() {
    for (std::size_t i = 1; i < next_.size(); ++i) next_[i] += next_[i - 1];
  }
  void place(unsigned from, unsigned to, CutGraph::Cost forward, CutGraph::Cost backward) {
    const unsigned there = next_[from]++, back = next_[to]++;
    ends_[there] = {from, to};
    ends_[back] = {to, from};
    capacities_[there] = forward;
    capacities_[back] = backward;
    reverse_[there] = back;
    reverse_[back] = there;
  }

  [[nodiscard]] Graph take_graph() {
    const auto ends = std::move(ends_);
    return Graph(boost::edges_are_sorted, ends.begin(), ends.end(),
                 static_cast<unsigned>(next_.size() - 1));
  }
  [[nodiscard]] CutGraph::Cost* capacities() { return capacities_.data(); }
  [[nodiscard]] const unsigned* reverse() const { return reverse_.data(); }

 private:
  std::vector<unsigned> next_;
  std::vector<std::pair<unsigned, unsigned>> ends_;
  std::vector<CutGraph::Cost> capacities_;
  std::vector<unsigned> reverse_;
};

// Capacities of arcs, which residuals replace. The library sums the flow in their type, so that is
// wider than what is stored.
struct Residuals {
  using key_type = Arc;
  using value_type = std::int64_t;
  using reference = std::int64_t;
  using category = boost::read_write_property_map_tag;

  CutGraph::Cost* residuals;

  friend std::int64_t get(const Residuals& map, const Arc& arc) { return map.residuals[arc.idx]; }
  friend void put(const Residuals& map, const Arc& arc, std::int64_t residual) {
    map.residuals[arc.idx] = static_cast<CutGraph::Cost>(residual);
  }
};

// The flow, and the colors of the vertices after it: those of the sink's tree are white.
std::int64_t maximal_flow(Arcs& arcs, Vertex source, Vertex sink, Poll& poll,
                          std::vector<Color>& colors) {
  const Graph graph = arcs.take_graph();
  std::vector<Arc> parents(num_vertices(graph));
  std::vector<int> distances(num_vertices(graph));
  colors.resize(num_vertices(graph));
  const auto vertex = get(boost::vertex_index, graph);
  const Residuals residuals{arcs.capacities()};
  return boost::boykov_kolmogorov_max_flow(
      graph, residuals, residuals, ReverseArcs{arcs.reverse(), &graph},
      boost::make_iterator_property_map(parents.begin(), vertex),
      PolledColors{colors.data(), &poll},
      boost::make_iterator_property_map(distances.begin(), vertex), vertex, source, sink);
}

}  // namespace

CutGraph::CutGraph(int nodes) {
  if (nodes < 0) throw InvalidInput(fmt::format("a graph cannot have {} nodes", nodes));
  terminals_.resize(nodes);
}

void CutGraph::add_edge(int from, int to, Cost forward, Cost backward) {
  assert(forward >= 0 && backward >= 0 && from != to);
  edges_.push_back({from, to, forward, backward});
}

std::optional<MinimalCut> CutGraph::solve(const Progress& progress) const {
  const auto nodes = static_cast<unsigned>(terminals_.size());
  const unsigned source = nodes, sink = nodes + 1;
  if (2 * (edges_.size() + nodes) > std::numeric_limits<unsigned>::max()) {
    throw InvalidInput(fmt::format("a graph of {} edges is too large", edges_.size()));
  }
  MinimalCut cut;
  const auto for_each_edge = [&](const auto& use) {
    for (unsigned node = 0; node < nodes; ++node) {
      const Cost cost = terminals_[node];
      if (cost > 0) use(source, node, cost, 0);
      if (cost < 0) use(node, sink, -cost, 0);
    }
    for (const Edge& edge : edges_) use(edge.from, edge.to, edge.forward, edge.backward);
  };
  std::size_t terminal_edges = 0;
  for (const Cost cost : terminals_) {
    if (cost != 0) ++terminal_edges;
    if (cost < 0) cut.cost_at_source -= cost;
  }
  Arcs arcs(nodes + 2, edges_.size() + terminal_edges);
  Poll poll(progress);
  std::vector<Color> colors;
  try {
    for_each_edge([&](unsigned from, unsigned to, Cost, Cost) {
      poll.count();
      arcs.count(from, to);
    });
    arcs.begin_placing();
    for_each_edge([&](unsigned from, unsigned to, Cost forward, Cost backward) {
      poll.count();
      arcs.place(from, to, forward, backward);
    });
    cut.cost = maximal_flow(arcs, source, sink, poll, colors);
  } catch (const FinishRequested&) {
    return std::nullopt;
  }
  cut.at_sink.resize(nodes);
  for (unsigned node = 0; node < nodes; ++node) {
    cut.at_sink[node] = colors[node] == boost::white_color ? 1 : 0;
  }
  return cut;
}

}  // namespace episcope
