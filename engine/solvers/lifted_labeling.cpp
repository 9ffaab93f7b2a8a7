// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/lifted_labeling.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/solvers/layered_sweep.h"
#include "engine/solvers/lifted_labeling_kernel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace episcope {
namespace {

constexpr float kRelaxation = 1.9F;
double row_energy(const LiftedProblem& problem, const PairLimits& limits, ImageView<const int> u,
                  int y) {
  const int width = problem.cost.width;
  const int* const here = u.row(y);
  const int* const below = u.row(std::min(y + 1, u.height - 1));
  const auto jump = [&](int pair, int x, int from, int to) {
    return static_cast<double>(limits.row(y, pair)[x]) * std::abs(to - from);
  };
  double sum = 0;
  for (int x = 0; x < width; ++x) {
    const int right = std::min(x + 1, width - 1);
    sum += problem.cost.at(y, here[x], x) + jump(0, x, here[x], here[right]) +
           jump(1, x, here[x], below[x]) + jump(2, x, here[x], below[right]) +
           jump(3, x, here[right], below[x]);
  }
  return sum;
}

void check_problem(const LiftedProblem& problem) {
  const auto& cost = problem.cost;
  if (cost.empty() || cost.height < 1 || cost.width < 1 || cost.layers < 1) {
    throw InvalidInput("a labeling needs costs of at least one pixel and one label");
  }
  if (cost.layers > kLiftedMostLayers) {
    throw InvalidInput("a labeling takes at most " + std::to_string(kLiftedMostLayers) +
                       " labels, not " + std::to_string(cost.layers));
  }
  const auto& g = problem.g;
  if (!g.empty() && (g.height != cost.height || g.width != cost.width || g.channels != 1)) {
    throw InvalidInput("a labeling needs edge weights of " + std::to_string(cost.width) + " by " +
                       std::to_string(cost.height) + " pixels, not " + std::to_string(g.width) +
                       " by " + std::to_string(g.height));
  }
  if (!(problem.smoothness >= 0)) throw InvalidInput("a labeling needs a smoothness of at least 0");
}

class Lifting {
 public:
  Lifting(const LiftedProblem& problem, const Progress& progress, Isa isa);

  void iterate(const Progress& progress) {
    sweep_.iterate(problem_.cost, limits_, {kernel_.move_primal, kernel_.move_dual}, progress);
  }
  // Renews energy, bound and labels of `result` if better ones are found.
  void measure(LiftedResult& result, const Progress& progress);

 private:
  void start(const LayeredSweep::Band& band);

  LiftedProblem problem_;
  const LiftedKernel& kernel_;
  LayeredSweep sweep_;
  PairLimits limits_;
  std::array<Image<int>, kLiftedCuts> cuts_;
};

Lifting::Lifting(const LiftedProblem& problem, const Progress& progress, Isa isa)
    : problem_(problem),
      kernel_(EPISCOPE_CHOOSE_KERNEL(isa, kLiftedKernel)),
      sweep_(problem.cost.height, problem.cost.layers - 1, problem.cost.width),
      limits_(problem.cost.height, problem.cost.width, problem.smoothness, problem.g) {
  // Each pixel is in 8 pairs, so |K|² ≤ 16; φ moves within [0, 1], the duals within about Λ.
  sweep_.shape().primal_step = static_cast<float>(1 / (4 * problem.smoothness));
  sweep_.shape().dual_step = static_cast<float>(problem.smoothness / 4);
  sweep_.shape().relaxation = kRelaxation;
  for (auto& cut : cuts_) cut = Image<int>(problem.cost.height, problem.cost.width);
  parallel_for(sweep_.bands(), progress, [this](int i) { start(sweep_.band(i)); });
}

// φ begins as the step at the cheapest label.
void Lifting::start(const LayeredSweep::Band& band) {
  sweep_.clear(band);
  const LayeredShape& shape = sweep_.shape();
  std::vector<float> least(shape.width);
  std::vector<int> label(shape.width);
  for (int y = band.begin; y < band.end; ++y) {
    std::fill(label.begin(), label.end(), 0);
    std::copy_n(problem_.cost.row(y, 0), shape.width, least.begin());
    for (int l = 1; l <= shape.steps; ++l) {
      const float* const cost = problem_.cost.row(y, l);
      for (int x = 0; x < shape.width; ++x) {
        if (cost[x] < least[x]) {
          least[x] = cost[x];
          label[x] = l;
        }
      }
    }
    for (int l = 0; l < shape.steps; ++l) {
      for (int x = 0; x < shape.width; ++x) {
        sweep_.phi(y)[l * shape.pitch + x] = l < label[x] ? 1.0F : 0.0F;
      }
    }
  }
}

void Lifting::measure(LiftedResult& result, const Progress& progress) {
  const int height = sweep_.height();
  std::vector<double> bounds(height);
  std::vector<std::array<double, kLiftedCuts>> energies(height);
  parallel_for(height, progress, [&](int y) {
    int* labels[kLiftedCuts];
    for (int k = 0; k < kLiftedCuts; ++k) labels[k] = cuts_[k].row(y);
    bounds[y] = kernel_.bound(sweep_.shape(), problem_.cost.row(y, 0), sweep_.duals(y, limits_),
                              sweep_.duals_above(y, limits_));
    kernel_.cut(sweep_.shape(), sweep_.phi(y), labels);
  });
  parallel_for(height, progress, [&](int y) {
    for (int k = 0; k < kLiftedCuts; ++k) {
      energies[y][k] = row_energy(problem_, limits_, cuts_[k], y);
    }
  });
  result.bound = std::max(result.bound, std::accumulate(bounds.begin(), bounds.end(), 0.0));
  for (int k = 0; k < kLiftedCuts; ++k) {
    double energy = 0;
    for (const auto& row : energies) energy += row[k];
    if (energy >= result.energy) continue;
    result.energy = energy;
    result.labels = cuts_[k];
  }
}

std::string gap_text(double gap) {
  char text[40];
  std::snprintf(text, sizeof text, "labeling, gap %.1e", gap);
  return text;
}

// Each pixel for itself: the optimum without smoothness.
LiftedResult cheapest_labels(const LiftedProblem& problem) {
  const auto& cost = problem.cost;
  LiftedResult result;
  result.labels = Image<int>(cost.height, cost.width);
  for (int y = 0; y < cost.height; ++y) {
    for (int x = 0; x < cost.width; ++x) {
      int& label = result.labels.at(y, x);
      for (int l = 1; l < cost.layers; ++l) {
        if (cost.at(y, l, x) < cost.at(y, label, x)) label = l;
      }
      result.energy += cost.at(y, label, x);
    }
  }
  result.bound = result.energy;
  result.converged = true;
  return result;
}

// How far the solver has come, as far as can be told between two looks at the gap; and by the gap,
// which falls about geometrically.
double share_by_iterations(int iterations) {
  return std::min(0.7, 1 - std::exp2(-iterations / 6.0));
}
double share_by_gap(double gap, double wanted) {
  constexpr double first_gap = 0.3;
  return std::log(std::max(gap, 1e-12) / first_gap) /
         std::log(std::clamp(wanted, 1e-9, first_gap / 2) / first_gap);
}

}  // namespace

double LiftedResult::relative_gap() const {
  return energy == bound ? 0 : (energy - bound) / std::abs(energy);
}

LiftedResult solve_lifted_labeling(const LiftedProblem& problem, const LiftedOptions& options,
                                   const Progress& progress, Isa isa) {
  check_problem(problem);
  if (problem.smoothness == 0 || problem.cost.layers == 1) return cheapest_labels(problem);
  Lifting lifting(problem, progress.part(0, 0), isa);
  LiftedResult result;
  result.energy = std::numeric_limits<double>::infinity();
  result.bound = -result.energy;
  const int check_every = std::max(1, options.check_every);
  double done = 0;
  for (bool last = false; !last;) {
    const Progress quiet = progress.part(done, done);
    lifting.iterate(quiet);
    ++result.iterations;
    done = std::max(done, share_by_iterations(result.iterations));
    progress.report(done);
    last = result.iterations >= options.max_iterations || progress.finish_requested();
    if (!last && result.iterations % check_every != 0) continue;
    lifting.measure(result, quiet);
    const double gap = result.relative_gap();
    result.converged = gap <= options.gap;
    last = last || result.converged;
    done = std::clamp(share_by_gap(gap, options.gap), done, 1.0);
    progress.report(done);
    progress.step(gap_text(gap));
  }
  return result;
}

double labeling_energy(const LiftedProblem& problem, ImageView<const int> labels) {
  check_problem(problem);
  if (labels.height != problem.cost.height || labels.width != problem.cost.width) {
    throw InvalidInput("the energy of a labeling needs labels of the size of the costs");
  }
  const PairLimits limits(labels.height, labels.width, problem.smoothness, problem.g);
  double sum = 0;
  for (int y = 0; y < labels.height; ++y) sum += row_energy(problem, limits, labels, y);
  return sum;
}

}  // namespace episcope
