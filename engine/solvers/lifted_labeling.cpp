// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/lifted_labeling.h"

#include "engine/core/error.h"
#include "engine/core/flush_denormals.h"
#include "engine/core/large_memory.h"
#include "engine/core/parallel.h"
#include "engine/solvers/lifted_labeling_kernel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace episcope {
namespace {

// Rows that one thread takes through an iteration on its own. The same for any number of threads.
constexpr int kBandRows = 32;
constexpr float kRelaxation = 1.9F;
// The largest size of a dual on a pair of sides and of diagonals, in units of Λ g.
const float kSide = std::sqrt(2.0F) - 1;
const float kDiagonal = 1 - std::sqrt(0.5F);

// The largest size of the duals `[y][pair][x]`: the weights of the pairs in the energy. 0 where a
// pair would leave the image.
class PairLimits {
 public:
  PairLimits(const LiftedProblem& problem, long pitch);
  [[nodiscard]] const float* row(int y, int pair) const {
    return memory_.data() + begin_of(y, pair);
  }

 private:
  [[nodiscard]] long begin_of(int y, int pair) const {
    return kLiftedRowUnit + (static_cast<long>(y) * kLiftedPairs + pair) * pitch_;
  }
  void fill_row(const LiftedProblem& problem, int y);

  long pitch_;
  std::vector<float> memory_;
};

PairLimits::PairLimits(const LiftedProblem& problem, long pitch)
    : pitch_(pitch),
      memory_(static_cast<std::size_t>(problem.cost.height * kLiftedPairs * pitch) +
              2 * kLiftedRowUnit) {
  for (int y = 0; y < problem.cost.height; ++y) fill_row(problem, y);
}

void PairLimits::fill_row(const LiftedProblem& problem, int y) {
  const int width = problem.cost.width;
  const auto smoothness = static_cast<float>(problem.smoothness);
  const bool down = y + 1 < problem.cost.height;
  // The share of diagonals missing above the first row and below the last one.
  const float along = kSide + kDiagonal * static_cast<float>((y == 0 ? 1 : 0) + (down ? 0 : 1));
  for (int x = 0; x < width; ++x) {
    const bool right = x + 1 < width;
    const float aside = kSide + kDiagonal * static_cast<float>((x == 0 ? 1 : 0) + (right ? 0 : 1));
    const float weight = smoothness * (problem.g.empty() ? 1.0F : problem.g.at(y, x));
    const float diagonal = right && down ? weight * kDiagonal : 0;
    memory_[begin_of(y, 0) + x] = right ? weight * along : 0;
    memory_[begin_of(y, 1) + x] = down ? weight * aside : 0;
    memory_[begin_of(y, 2) + x] = diagonal;
    memory_[begin_of(y, 3) + x] = diagonal;
  }
}

long pitch_of(int width) {
  return (width / kLiftedRowUnit + 1) * static_cast<long>(kLiftedRowUnit);
}

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

  void iterate(const Progress& progress);
  // Renews energy, bound and labels of `result` if better ones are found.
  void measure(LiftedResult& result, const Progress& progress);

 private:
  struct Band {
    int begin = 0, end = 0;
  };
  [[nodiscard]] Band band(int i) const {
    return {i * kBandRows, std::min(height_, (i + 1) * kBandRows)};
  }
  [[nodiscard]] long row_size() const { return shape_.steps * shape_.pitch; }
  [[nodiscard]] float* phi(int y) { return phi_.get() + kLiftedRowUnit + y * row_size(); }
  [[nodiscard]] LiftedDuals duals(int y);
  // The row before the first: no pairs.
  [[nodiscard]] LiftedDuals duals_above(int y);
  // Row y of 2φ' − φ of a band: its first and last row are kept for the neighbouring bands.
  [[nodiscard]] float* ahead(int y, std::vector<float>& scratch);
  void start(const Band& band);
  void sweep(const Band& band, std::vector<float>& scratch);

  LiftedProblem problem_;
  const LiftedKernel& kernel_;
  LiftedShape shape_;
  int height_;
  int bands_;
  PairLimits limits_;
  LargeArray<float> phi_;
  LargeArray<float> duals_;  // [y][pair][step][x]
  std::vector<float> edges_;
  std::vector<float> nothing_;
  std::array<Image<int>, kLiftedCuts> cuts_;
};

Lifting::Lifting(const LiftedProblem& problem, const Progress& progress, Isa isa)
    : problem_(problem),
      kernel_(EPISCOPE_CHOOSE_KERNEL(isa, kLiftedKernel)),
      height_(problem.cost.height),
      bands_((problem.cost.height + kBandRows - 1) / kBandRows),
      limits_(problem, pitch_of(problem.cost.width)) {
  shape_.steps = problem.cost.layers - 1;
  shape_.width = problem.cost.width;
  shape_.pitch = pitch_of(shape_.width);
  // Each pixel is in 8 pairs, so |K|² ≤ 16; φ moves within [0, 1], the duals within about Λ.
  shape_.primal_step = static_cast<float>(1 / (4 * problem.smoothness));
  shape_.dual_step = static_cast<float>(problem.smoothness / 4);
  shape_.relaxation = kRelaxation;
  const std::size_t size = static_cast<std::size_t>(height_) * row_size();
  phi_ = make_large<float>(size + 2 * kLiftedRowUnit);
  duals_ = make_large<float>(kLiftedPairs * size + 2 * kLiftedRowUnit);
  edges_.resize(2 * static_cast<std::size_t>(bands_) * row_size() + 2 * kLiftedRowUnit);
  nothing_.resize(static_cast<std::size_t>(row_size()) + 2 * kLiftedRowUnit);
  for (auto& cut : cuts_) cut = Image<int>(height_, shape_.width);
  std::fill_n(phi_.get(), kLiftedRowUnit, 0.0F);
  std::fill_n(duals_.get(), kLiftedRowUnit, 0.0F);
  parallel_for(bands_, progress, [this](int i) { start(band(i)); });
}

LiftedDuals Lifting::duals(int y) {
  LiftedDuals row;
  for (int k = 0; k < kLiftedPairs; ++k) {
    row.pair[k] =
        duals_.get() + kLiftedRowUnit + (static_cast<long>(y) * kLiftedPairs + k) * row_size();
    row.limit[k] = limits_.row(y, k);
  }
  return row;
}

LiftedDuals Lifting::duals_above(int y) {
  if (y > 0) return duals(y - 1);
  LiftedDuals row;
  for (int k = 0; k < kLiftedPairs; ++k) {
    row.pair[k] = nothing_.data() + kLiftedRowUnit;
    row.limit[k] = nothing_.data() + kLiftedRowUnit;
  }
  return row;
}

float* Lifting::ahead(int y, std::vector<float>& scratch) {
  const Band all = band(y / kBandRows);
  float* const edges = edges_.data() + kLiftedRowUnit + 2 * (y / kBandRows) * row_size();
  if (y == all.begin) return edges;
  if (y == all.end - 1) return edges + row_size();
  return scratch.data() + kLiftedRowUnit + (y & 1) * row_size();
}

void Lifting::start(const Band& band) {
  std::vector<float> least(shape_.width);
  std::vector<int> label(shape_.width);
  for (int y = band.begin; y < band.end; ++y) {
    std::fill_n(phi(y), row_size() + (y + 1 == height_ ? kLiftedRowUnit : 0), 0.0F);
    std::fill_n(duals(y).pair[0],
                kLiftedPairs * row_size() + (y + 1 == height_ ? kLiftedRowUnit : 0), 0.0F);
    std::fill(label.begin(), label.end(), 0);
    std::copy_n(problem_.cost.row(y, 0), shape_.width, least.begin());
    for (int l = 1; l <= shape_.steps; ++l) {
      const float* const cost = problem_.cost.row(y, l);
      for (int x = 0; x < shape_.width; ++x) {
        if (cost[x] < least[x]) {
          least[x] = cost[x];
          label[x] = l;
        }
      }
    }
    for (int l = 0; l < shape_.steps; ++l) {
      for (int x = 0; x < shape_.width; ++x) {
        phi(y)[l * shape_.pitch + x] = l < label[x] ? 1.0F : 0.0F;
      }
    }
  }
}

// A row of φ needs the old duals of its own and of the row above, a row of duals the new φ of its
// own and of the row below: in this order all is updated in place, and memory is walked once.
void Lifting::sweep(const Band& band, std::vector<float>& scratch) {
  for (int y = band.begin; y < band.end; ++y) {
    kernel_.move_primal(shape_, problem_.cost.row(y, 0), duals(y), duals_above(y), phi(y),
                        ahead(y, scratch));
    if (y == band.begin) continue;
    kernel_.move_dual(shape_, ahead(y - 1, scratch), ahead(y, scratch), duals(y - 1));
  }
}

void Lifting::iterate(const Progress& progress) {
  parallel_for_workers(bands_, progress, [this]() -> std::function<void(int)> {
    auto scratch = std::make_shared<std::vector<float>>(2 * row_size() + 2 * kLiftedRowUnit);
    return [this, scratch](int i) {
      const FlushDenormals flush;
      sweep(band(i), *scratch);
    };
  });
  // The last duals of a band wait for the first φ of the next one, and the other way round.
  std::vector<float> unused;
  parallel_for(bands_, progress, [this, &unused](int i) {
    const FlushDenormals flush;
    const int y = band(i).end - 1;
    kernel_.move_dual(shape_, ahead(y, unused), ahead(std::min(y + 1, height_ - 1), unused),
                      duals(y));
  });
}

void Lifting::measure(LiftedResult& result, const Progress& progress) {
  std::vector<double> bounds(height_);
  std::vector<std::array<double, kLiftedCuts>> energies(height_);
  parallel_for(height_, progress, [&](int y) {
    int* labels[kLiftedCuts];
    for (int k = 0; k < kLiftedCuts; ++k) labels[k] = cuts_[k].row(y);
    bounds[y] = kernel_.bound(shape_, problem_.cost.row(y, 0), duals(y), duals_above(y));
    kernel_.cut(shape_, phi(y), labels);
  });
  parallel_for(height_, progress, [&](int y) {
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
  const PairLimits limits(problem, pitch_of(problem.cost.width));
  double sum = 0;
  for (int y = 0; y < labels.height; ++y) sum += row_energy(problem, limits, labels, y);
  return sum;
}

}  // namespace episcope
