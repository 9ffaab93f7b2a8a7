// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/order/arrangement.h"

#include <algorithm>
#include <numeric>

namespace episcope::io {
namespace {

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

/// Isotonic regression by joining neighbours that violate the order; returns what is left.
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

}  // namespace

Arrangement::Place Arrangement::place(int index) const {
  const int row = index / period;
  const int column = index % period;
  return {row, snake && row % 2 == 1 ? period - 1 - column : column};
}

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

}  // namespace episcope::io
