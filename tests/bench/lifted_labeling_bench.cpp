// SPDX-License-Identifier: BSD-3-Clause
// Functional lifting against the plain loops that one would write first (Pock et al. 2010), and
// against what the memory can copy. Both use as many threads as the machine has.
#include "engine/core/parallel.h"
#include "engine/solvers/simplex_labeling.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <vector>

namespace {

using namespace episcope;

constexpr int kSize = 768;
constexpr int kLabels = 64;
constexpr float kSmoothness = 0.03F;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Slanted patches seen by a stereo method: truncated, noisy costs with a second minimum.
Volume<float> make_costs() {
  Volume<float> costs(kSize, kLabels, kSize);
  parallel_for(kSize, Progress(), [&](int y) {
    std::mt19937 random(static_cast<unsigned>(y));
    std::uniform_real_distribution<float> uniform;
    for (int l = 0; l < kLabels; ++l) {
      for (int x = 0; x < kSize; ++x) {
        const int truth = ((x / 150) * 17 + (y / 120) * 29 + x / 40) % kLabels;
        const auto apart = static_cast<float>(std::abs(l - truth));
        const auto alias = 0.4F + static_cast<float>(std::abs(l - (truth + 13) % kLabels));
        costs.view().at(y, l, x) =
            std::min(1.0F, 0.2F * std::min(apart, alias)) + 0.5F * uniform(random);
      }
    }
  });
  return costs;
}

const LiftedProblem& problem() {
  static const Volume<float> costs = make_costs();
  static const LiftedProblem the_problem{costs.view(), {}, kSmoothness};
  return the_problem;
}

LiftedResult solve(int iterations, double gap) {
  return solve_lifted_labeling(problem(), {iterations, gap, 10}, Progress());
}

// One iteration with three duals, as one writes it down; costs are problem()'s.
class PlainLifting {
 public:
  PlainLifting() {
    for (auto* each : {&phi_, &ahead_, &px_, &py_, &pz_}) each->assign(kVoxels, 0.0F);
  }

  void iterate() {
    parallel_for(kSize, Progress(), [this](int y) { move_duals(y); });
    parallel_for(kSize, Progress(), [this](int y) { move_primal(y); });
  }

 private:
  static constexpr long kRow = static_cast<long>(kLabels) * kSize;
  static constexpr long kVoxels = kSize * kRow;
  static constexpr float kStep = 0.288F;

  void move_duals(int y) {
    for (int l = 0; l < kLabels; ++l) {
      for (int x = 0; x < kSize; ++x) {
        const long i = y * kRow + l * static_cast<long>(kSize) + x;
        const float a = px_[i] + (x + 1 < kSize ? kStep * (ahead_[i + 1] - ahead_[i]) : 0);
        const float b = py_[i] + (y + 1 < kSize ? kStep * (ahead_[i + kRow] - ahead_[i]) : 0);
        const float norm = std::sqrt(a * a + b * b);
        const float scale = norm > kSmoothness ? kSmoothness / norm : 1.0F;
        px_[i] = a * scale;
        py_[i] = b * scale;
        const float next = l + 1 < kLabels ? ahead_[i + kSize] : 0;
        pz_[i] = std::max(pz_[i] + kStep * (next - ahead_[i]), -problem().cost.data[i]);
      }
    }
  }

  void move_primal(int y) {
    for (int l = 0; l < kLabels; ++l) {
      for (int x = 0; x < kSize; ++x) {
        const long i = y * kRow + l * static_cast<long>(kSize) + x;
        const float divergence = px_[i] - (x > 0 ? px_[i - 1] : 0) + py_[i] -
                                 (y > 0 ? py_[i - kRow] : 0) + pz_[i] -
                                 (l > 0 ? pz_[i - kSize] : 0);
        const float next = l == 0 ? 1.0F : std::clamp(phi_[i] + kStep * divergence, 0.0F, 1.0F);
        ahead_[i] = 2 * next - phi_[i];
        phi_[i] = next;
      }
    }
  }

  std::vector<float> phi_, ahead_, px_, py_, pz_;
};

double copied_bytes_per_second() {
  constexpr long kCount = static_cast<long>(kSize) * kLabels * kSize;
  std::vector<float> from(kCount, 1.0F), to(kCount);
  double best = 1e9;
  for (int i = 0; i < 4; ++i) {
    const auto start = std::chrono::steady_clock::now();
    parallel_for(kSize, Progress(), [&](int y) {
      const long row = static_cast<long>(kLabels) * kSize;
      std::copy_n(from.begin() + y * row, row, to.begin() + y * row);
    });
    benchmark::DoNotOptimize(to.data());
    benchmark::ClobberMemory();
    best = std::min(best, seconds_since(start));
  }
  return 2.0 * sizeof(float) * kCount / best;
}

// Seconds of an iteration: the slope between two lengths.
double seconds_per_iteration() {
  double best[2] = {1e9, 1e9};
  for (int repeat = 0; repeat < 2; ++repeat) {
    for (int i = 0; i < 2; ++i) {
      const auto start = std::chrono::steady_clock::now();
      (void)solve_lifted_labeling(problem(), {2 + 10 * i, 0, 1000}, Progress());
      best[i] = std::min(best[i], seconds_since(start));
    }
  }
  return (best[1] - best[0]) / 10;
}

void lifted_iteration(benchmark::State& state) {
  // Reads the costs, φ and four duals; writes φ and the duals.
  constexpr double kBytes = 11.0 * sizeof(float) * kSize * kSize * (kLabels - 1);
  double fast = 0, plain = 1e9;
  for (auto _ : state) {
    fast = seconds_per_iteration();
    PlainLifting lifting;
    for (int i = 0; i < 4; ++i) {
      const auto start = std::chrono::steady_clock::now();
      lifting.iterate();
      plain = std::min(plain, seconds_since(start));
    }
  }
  state.counters["s_per_iteration"] = fast;
  state.counters["s_plain_iteration"] = plain;
  state.counters["times_faster"] = plain / fast;
  state.counters["GB_per_s"] = kBytes / fast / 1e9;
  state.counters["of_copy"] = kBytes / fast / copied_bytes_per_second();
}
BENCHMARK(lifted_iteration)->Unit(benchmark::kSecond)->Iterations(1);

void lifted_solve(benchmark::State& state) {
  LiftedResult result;
  for (auto _ : state) result = solve(1000, 1e-3);
  state.counters["iterations"] = result.iterations;
  state.counters["gap"] = result.relative_gap();
}
BENCHMARK(lifted_solve)->Unit(benchmark::kSecond)->Iterations(1);

}  // namespace

BENCHMARK_MAIN();
