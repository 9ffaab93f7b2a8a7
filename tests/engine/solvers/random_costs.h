// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/solvers/layered_sweep.h"
#include "engine/solvers/simplex_labeling.h"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <limits>
#include <random>

namespace episcope::test {

/// What a labeling problem refers to: costs of labels `[y][label][x]`, and weights of boundaries.
template <class Problem>
struct Costs {
  Volume<float> cost;
  Image<float> g;
  double smoothness = 0.1;
  [[nodiscard]] Problem problem() const { return {cost.view(), g, smoothness}; }
};

/// Costs in [0, 1) without any order along the labels, with many local minima, and weights of
/// boundaries in [0.2, 1).
template <class Problem>
Costs<Problem> random_costs(int height, int labels, int width, double smoothness,
                            unsigned seed = 5) {
  Costs<Problem> costs{Volume<float>(height, labels, width), Image<float>(height, width),
                       smoothness};
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform;
  for (std::size_t i = 0; i < costs.cost.view().size(); ++i) {
    costs.cost.view().data[i] = uniform(random);
  }
  for (float& g : costs.g) g = 0.2F + 0.8F * uniform(random);
  return costs;
}

/// E(labels), added up row by row.
template <class Problem, class Jump>
double energy_of(const Problem& problem, double weight, ImageView<const int> labels,
                 const Jump& jump) {
  const PairLimits limits(labels.height, labels.width, weight, problem.g);
  double sum = 0;
  for (int y = 0; y < labels.height; ++y) {
    sum += pair_row_energy(problem.cost, limits, labels, y, jump);
  }
  return sum;
}
inline double potts_energy(const SimplexProblem& problem, ImageView<const int> labels) {
  return energy_of(problem, problem.smoothness / 2, labels, potts_jump);
}
inline double labeling_energy(const LiftedProblem& problem, ImageView<const int> labels) {
  return energy_of(problem, problem.smoothness, labels,
                   [](int from, int to) { return std::abs(to - from); });
}

/// The least energy of all labelings, one after the other.
template <class Problem>
double least_energy(const Problem& problem,
                    double (*energy)(const Problem&, ImageView<const int>)) {
  const auto& cost = problem.cost;
  Image<int> labels(cost.height, cost.width);
  double least = std::numeric_limits<double>::infinity();
  while (true) {
    least = std::min(least, energy(problem, labels));
    std::size_t i = 0;
    while (i < labels.size() && ++labels.data()[i] == cost.layers) labels.data()[i++] = 0;
    if (i == labels.size()) return least;
  }
}

inline bool same_labels(const Image<int>& a, const Image<int>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace episcope::test
