// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/lifted_labeling.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/solvers/layered_kernel.h"
#include "engine/solvers/layered_sweep.h"
#include "engine/solvers/pair_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <vector>

namespace episcope {
namespace {

double row_energy(const LiftedProblem& problem, const PairLimits& limits, ImageView<const int> u,
                  int y) {
  return pair_row_energy(problem.cost, limits, u, y,
                         [](int from, int to) { return std::abs(to - from); });
}

void check_problem(const LiftedProblem& problem) {
  const auto& cost = problem.cost;
  if (cost.empty() || cost.height < 1 || cost.width < 1 || cost.layers < 1) {
    throw InvalidInput("a labeling needs costs of at least one pixel and one label");
  }
  if (cost.layers > kMaxLiftedLayers) {
    throw InvalidInput(
        fmt::format("a labeling takes at most {} labels, not {}", kMaxLiftedLayers, cost.layers));
  }
  check_boundaries(problem.g, problem.smoothness, cost.height, cost.width);
}

class Lifting {
 public:
  Lifting(const LiftedProblem& problem, const Progress& progress, Isa isa);

  void iterate(const Progress& progress) {
    const LayeredMoves moves{kernel_.move_primal, kernel_.move_dual};
    sweep_.iterate({problem_.cost, limits_, moves}, 1, progress);
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
  sweep_.shape().relaxation = kOverRelaxation;
  for (auto& cut : cuts_) cut = Image<int>(problem.cost.height, problem.cost.width);
  parallel_for(sweep_.bands(), progress, [this](int i) { start(sweep_.band(i)); });
}

// φ begins as the step at the cheapest label.
void Lifting::start(const LayeredSweep::Band& band) {
  sweep_.clear(band);
  const LayeredShape& shape = sweep_.shape();
  std::vector<float> least;
  std::vector<int> label(shape.width);
  for (int y = band.begin; y < band.end; ++y) {
    take_cheapest(problem_.cost, y, label.data(), least);
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

// Each pixel for itself: the optimum without smoothness.
LiftedResult cheapest_labels(const LiftedProblem& problem) {
  const auto& cost = problem.cost;
  LiftedResult result;
  result.labels = Image<int>(cost.height, cost.width);
  std::vector<float> least;
  for (int y = 0; y < cost.height; ++y) {
    take_cheapest(cost, y, result.labels.row(y), least);
    for (const float each : least) result.energy += each;
  }
  result.bound = result.energy;
  result.converged = true;
  return result;
}

// How far the solver has come, as far as can be told between two checks of the gap; and by the gap,
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
  return labeling_gap(energy, bound);
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
    progress.step(labeling_gap_text(gap));
  }
  return result;
}

}  // namespace episcope
