// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/simplex_labeling.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/solvers/layered_kernel.h"
#include "engine/solvers/layered_sweep.h"
#include "engine/solvers/shared_constants.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <optional>
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

// Levels are halved down to this side; iterations on each below the finest.
// Iterations taken through the image at once: what they work on fits a cache.
constexpr int kTogether = 5;
static_assert(kSimplexCoarseMoves % kTogether == 0);

void check_problem(const SimplexProblem& problem, int height, int layers, int width) {
  const auto& cost = problem.cost;
  if (cost.empty() || cost.height != height || cost.layers != layers || cost.width != width) {
    throw InvalidInput(
        fmt::format("a labeling needs costs of {} labels for {} by {} pixels, not {} for {} by {}",
                    layers, width, height, cost.layers, cost.width, cost.height));
  }
  check_boundaries(problem.g, problem.smoothness, height, width);
}

void check_moves(ImageView<const std::int32_t> from, const LayeredShape& shape, int height) {
  if (from.empty()) return;
  const bool fits = from.height == height && from.width == shape.width;
  const auto pixels = static_cast<std::ptrdiff_t>(height) * shape.width;
  if (fits && std::all_of(from.data, from.data + pixels,
                          [&](std::int32_t at) { return at >= -1 && at < pixels; })) {
    return;
  }
  throw InvalidInput(
      "the pixels that a labeling starts from must form an image of the size of the costs");
}

// A jump changes the layers of both labels, each weighted by half of λ.
PairLimits limits_of(const SimplexProblem& problem) {
  return {problem.cost.height, problem.cost.width, problem.smoothness / 2, problem.g};
}

double row_energy(const SimplexProblem& problem, const PairLimits& limits, ImageView<const int> u,
                  int y) {
  return pair_row_energy(problem.cost, limits, u, y, potts_jump);
}

// Without boundaries.
SimplexResult each_cheapest(const SimplexProblem& problem, ImageView<int> labels) {
  SimplexResult result;
  std::vector<float> least;
  for (int y = 0; y < labels.height; ++y) {
    take_cheapest(problem.cost, y, labels.row(y), least);
    for (const float each : least) result.energy += static_cast<double>(each);
  }
  result.relaxed = result.bound = result.energy;
  result.converged = true;
  return result;
}

// Each pixel is in 8 pairs, so |K|² ≤ 16. u moves within [0, 1]; how far the duals move grows with
// λ, but more slowly: where λ is large, the costs bound them.
void set_steps(double smoothness, LayeredShape& shape) {
  const double dual_size = std::min(smoothness, std::sqrt(smoothness));
  shape.primal_step = static_cast<float>(1 / (2 * dual_size));
  shape.dual_step = static_cast<float>(dual_size / 8);
  shape.relaxation = kOverRelaxation;
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

double SimplexResult::relative_gap() const {
  return labeling_gap(relaxed, bound);
}

struct SimplexSolver::State {
  // The problem at half the size of the one before.
  struct Level {
    Level(int height, int layers, int width)
        : cost(height, layers, width), sweep(height, layers, width) {}
    Volume<float> cost;
    Image<float> g;
    LayeredSweep sweep;
  };

  State(int height, int layers, int width, Isa isa);

  void begin(const SimplexProblem& problem, const SimplexOptions& options,
             const Progress& progress);
  void start(const SimplexProblem& problem, const Progress& progress);
  void climb(const SimplexProblem& problem, const Progress& progress);
  void choose_layers(const SimplexProblem& problem, const SimplexOptions& options,
                     const Progress& progress);
  void take_over(const SimplexProblem& problem, const SimplexOptions& options,
                 const Progress& progress);
  void measure(const SimplexProblem& problem, const PairLimits& limits, SimplexResult& result,
               ImageView<int> labels, const Progress& progress);
  void measure_band(const SimplexProblem& problem, const PairLimits& limits, int band);

  const SimplexKernel& kernel;
  const LayeredMoves moves;
  LayeredSweep sweep;
  std::optional<LayeredSweep> last;  // where the call before ended, if ever taken over from
  std::vector<Level> coarse;
  bool has_run = false;
  RacingLayers racing;
  Image<int> rounded;
  std::vector<double> bounds, relaxed, energies;  // of each band
};

SimplexSolver::State::State(int height, int layers, int width, Isa isa)
    : kernel(EPISCOPE_CHOOSE_KERNEL(isa, kSimplexKernel)),
      moves{kernel.move_primal, kernel.move_dual},
      sweep(height, layers, width),
      racing(height, layers, width),
      rounded(height, width) {
  while (std::min(height, width) >= 2 * kSimplexMinSide) {
    height = (height + 1) / 2;
    width = (width + 1) / 2;
    coarse.emplace_back(height, layers, width);
  }
  for (auto* each : {&bounds, &relaxed, &energies}) each->assign(sweep.bands(), 0.0);
}

// Begins at the coarsest level with its cheapest labels.
void SimplexSolver::State::start(const SimplexProblem& problem, const Progress& progress) {
  VolumeView<const float> cost = problem.cost;
  ImageView<const float> g = problem.g;
  for (Level& level : coarse) {
    halve(cost, progress, level.cost.view());
    if (!g.empty()) level.g = halved(g);
    cost = level.cost.view();
    if (!g.empty()) g = level.g;
  }
  LayeredSweep& first = coarse.empty() ? sweep : coarse.back().sweep;
  parallel_for(first.bands(), progress, [&](int i) {
    const auto band = first.band(i);
    first.clear(band);
    std::vector<float> least;
    std::vector<int> labels(cost.width);
    for (int y = band.begin; y < band.end; ++y) {
      take_cheapest(cost, y, labels.data(), least);
      for (int x = 0; x < cost.width; ++x) {
        first.phi(y)[labels[x] * first.shape().pitch + x] = 1;
      }
    }
  });
}

void SimplexSolver::State::climb(const SimplexProblem& problem, const Progress& progress) {
  double smoothness = std::ldexp(problem.smoothness, -static_cast<int>(coarse.size()));
  for (std::size_t k = coarse.size(); k-- > 0;) {
    Level& level = coarse[k];
    const PairLimits limits(level.cost.height(), level.cost.width(), smoothness / 2,
                            problem.g.empty() ? ImageView<const float>{} : level.g);
    set_steps(smoothness, level.sweep.shape());
    for (int i = 0; i < kSimplexCoarseMoves; i += kTogether) {
      level.sweep.iterate({level.cost.view(), limits, moves}, kTogether, progress);
    }
    begin_from(level.sweep, progress, k > 0 ? coarse[k - 1].sweep : sweep);
    smoothness *= 2;
  }
}

// Those of the labels reached so far take part in any case.
void SimplexSolver::State::choose_layers(const SimplexProblem& problem,
                                         const SimplexOptions& options, const Progress& progress) {
  if (options.racing_iterations == 0) return;
  parallel_for(sweep.bands(), progress, [&](int i) {
    for (int y = sweep.band(i).begin; y < sweep.band(i).end; ++y) {
      kernel.cut(sweep.shape(), sweep.phi(y), rounded.row(y));
    }
  });
  racing.choose(problem.cost, options.behind, rounded, progress);
  parallel_for(sweep.bands(), progress, [&](int i) { sweep.clear_all_but(racing, sweep.band(i)); });
}

void SimplexSolver::State::take_over(const SimplexProblem& problem, const SimplexOptions& options,
                                     const Progress& progress) {
  const ImageView<const std::int32_t> from = options.from_last;
  if (!last) last.emplace(sweep.height(), sweep.shape().steps, sweep.shape().width);
  std::swap(sweep, *last);
  if (options.racing_iterations > 0) {
    Image<int> moved(rounded.height(), rounded.width());
    for (std::size_t i = 0; i < moved.size(); ++i) {
      moved.data()[i] = rounded.data()[from.data[i] < 0 ? i : from.data[i]];
    }
    racing.choose(problem.cost, options.behind, moved, progress);
  }
  begin_from_moved(*last, from, racing, progress, sweep);
}

void SimplexSolver::State::begin(const SimplexProblem& problem, const SimplexOptions& options,
                                 const Progress& progress) {
  racing.take_all();
  if (!options.from_last.empty() && has_run) {
    take_over(problem, options, progress);
  } else {
    if (!options.goes_on || !has_run) {
      start(problem, progress);
      climb(problem, progress);
    }
    choose_layers(problem, options, progress);
  }
  has_run = true;
  set_steps(problem.smoothness, sweep.shape());
}

void SimplexSolver::State::measure_band(const SimplexProblem& problem, const PairLimits& limits,
                                        int i) {
  const auto band = sweep.band(i);
  const LayeredShape& shape = sweep.shape();
  std::vector<float> rows(2 * sweep.row_size() + 2 * kLayerRowUnit);
  const auto feasible = [&](int y) {
    float* const row = rows.data() + kLayerRowUnit + (y & 1) * sweep.row_size();
    kernel.project(shape, sweep.phi(y), row);
    return row;
  };
  bounds[i] = relaxed[i] = 0;
  const float* here = feasible(band.begin);
  for (int y = band.begin; y < band.end; ++y) {
    const float* const below = y + 1 < sweep.height() ? feasible(y + 1) : here;
    const auto duals = sweep.duals(y, limits);
    bounds[i] += kernel.bound(shape, problem.cost.row(y, 0), duals, sweep.duals_above(y, limits));
    relaxed[i] += kernel.energy(shape, problem.cost.row(y, 0), duals, here, below);
    kernel.cut(shape, here, rounded.row(y));
    here = below;
  }
}

void SimplexSolver::State::measure(const SimplexProblem& problem, const PairLimits& limits,
                                   SimplexResult& result, ImageView<int> labels,
                                   const Progress& progress) {
  parallel_for(sweep.bands(), progress, [&](int i) { measure_band(problem, limits, i); });
  parallel_for(sweep.bands(), progress, [&](int i) {
    energies[i] = 0;
    for (int y = sweep.band(i).begin; y < sweep.band(i).end; ++y) {
      energies[i] += row_energy(problem, limits, rounded, y);
    }
  });
  const auto sum = [](const std::vector<double>& of) {
    return std::accumulate(of.begin(), of.end(), 0.0);
  };
  const double energy = sum(energies);
  result.bound = std::max(result.bound, sum(bounds));
  // A labeling is a u as well, and often better than the one it was read from.
  result.relaxed = std::min({result.relaxed, sum(relaxed), energy});
  if (energy >= result.energy) return;
  result.energy = energy;
  for (int y = 0; y < labels.height; ++y) {
    std::copy_n(rounded.row(y), labels.width, labels.row(y));
  }
}

SimplexSolver::SimplexSolver(int height, int layers, int width, Isa isa) {
  if (height < 1 || layers < 1 || width < 1) {
    throw InvalidInput("a labeling needs costs of at least one pixel and one label");
  }
  if (layers > kMaxSimplexLayers) {
    throw InvalidInput(
        fmt::format("a labeling takes at most {} labels, not {}", kMaxSimplexLayers, layers));
  }
  state_ = std::make_unique<State>(height, layers, width, isa);
}
SimplexSolver::~SimplexSolver() = default;
SimplexSolver::SimplexSolver(SimplexSolver&&) noexcept = default;

LayeredSweep& SimplexSolver::unknowns() {
  return state_->sweep;
}

SimplexResult SimplexSolver::solve(const SimplexProblem& problem, const SimplexOptions& options,
                                   const Progress& progress, ImageView<int> labels) {
  State& state = *state_;
  const LayeredShape& shape = state.sweep.shape();
  check_problem(problem, state.sweep.height(), shape.steps, shape.width);
  if (labels.height != state.sweep.height() || labels.width != shape.width) {
    throw InvalidInput("the label image of a labeling must have the size of the costs");
  }
  check_moves(options.from_last, shape, state.sweep.height());
  if (problem.smoothness == 0 || shape.steps == 1) return each_cheapest(problem, labels);
  SimplexResult result;
  const PairLimits limits = limits_of(problem);
  state.begin(problem, options, progress.part(0, 0));
  result.energy = result.relaxed = std::numeric_limits<double>::infinity();
  result.bound = -result.energy;
  const int check_every = std::max(1, options.check_every);
  double done = 0;
  for (bool last = false; !last;) {
    const Progress quiet = progress.part(done, done);
    const int count = std::min({progress.finish_requested() ? 1 : kTogether,
                                check_every - result.iterations % check_every,
                                options.max_iterations - result.iterations});
    if (result.iterations >= options.racing_iterations) state.racing.take_all();
    state.sweep.iterate({problem.cost, limits, state.moves, &state.racing}, count, quiet);
    result.iterations += count;
    done = std::max(done, 1 - std::exp2(-result.iterations / 20.0));
    progress.report(done);
    last = result.iterations >= options.max_iterations || progress.finish_requested();
    const bool is_due =
        result.iterations > options.racing_iterations && result.iterations % check_every == 0;
    if (!last && !is_due) continue;
    state.measure(problem, limits, result, labels, quiet);
    result.converged = result.relative_gap() <= options.gap;
    last = last || result.converged;
    progress.step(labeling_gap_text(result.relative_gap()));
  }
  progress.report(1);
  return result;
}

}  // namespace episcope
