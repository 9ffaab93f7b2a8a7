// SPDX-License-Identifier: BSD-3-Clause
// TV-L2 of one view against the plain loops that one would write first, and against what the memory
// can copy. Both run on one thread, as the estimators run one solver on each.
#include "engine/solvers/tv_l2.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <vector>

namespace {

using namespace episcope;

constexpr int kSize = 768;
constexpr double kLambda = 0.4;
constexpr int kIterations = 30;

struct View {
  Image<float> f{kSize, kSize}, w{kSize, kSize}, g{kSize, kSize};

  // Slanted patches; most observations are worthless, as in views with little texture.
  View() {
    std::mt19937 random(1);
    std::normal_distribution<float> noise;
    std::uniform_real_distribution<float> uniform;
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const int patch = (x / 150) * 5 + y / 120;
        const bool border = x % 150 == 149 || y % 120 == 119;
        const float coherence = 0.4F + 0.6F * uniform(random);
        w.at(y, x) = std::max(1e-3F, std::pow(coherence, 8.0F));
        g.at(y, x) = border ? 0.05F : 0.5F + 0.5F * uniform(random);
        f.at(y, x) = std::sin(static_cast<float>(patch)) + 0.0005F * static_cast<float>(x) +
                     0.3F * (1 - coherence) * noise(random);
      }
    }
  }
  [[nodiscard]] TvL2Problem problem() const { return {f.view(), w.view(), g.view(), kLambda}; }
};

const View& view() {
  static const View the_view;
  return the_view;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double copied_bytes_per_second() {
  std::vector<float> from(kSize * kSize, 1.0F), to(from.size());
  double best = 1e9;
  for (int i = 0; i < 20; ++i) {
    const auto start = std::chrono::steady_clock::now();
    std::copy(from.begin(), from.end(), to.begin());
    benchmark::DoNotOptimize(to.data());
    benchmark::ClobberMemory();
    best = std::min(best, seconds_since(start));
  }
  return 2.0 * sizeof(float) * static_cast<double>(from.size()) / best;
}

void update_dual(const View& v, const std::vector<float>& ahead, std::vector<float>& px,
                 std::vector<float>& py) {
  constexpr float step = 0.35F;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const int i = y * kSize + x;
      const float a = px[i] + (x + 1 < kSize ? step * (ahead[i + 1] - ahead[i]) : 0);
      const float b = py[i] + (y + 1 < kSize ? step * (ahead[i + kSize] - ahead[i]) : 0);
      const float norm = std::sqrt(a * a + b * b);
      const float scale = norm > v.g.data()[i] ? v.g.data()[i] / norm : 1.0F;
      px[i] = a * scale;
      py[i] = b * scale;
    }
  }
}

// Chambolle and Pock's first algorithm as one writes it down; returns the energy reached.
double plain_solve(const View& v, int iterations) {
  constexpr float step = 0.35F;
  std::vector<float> u(v.f.begin(), v.f.end()), ahead = u, px(u.size()), py(u.size());
  for (int k = 0; k < iterations; ++k) {
    update_dual(v, ahead, px, py);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const int i = y * kSize + x;
        const float divergence =
            px[i] - (x > 0 ? px[i - 1] : 0) + py[i] - (y > 0 ? py[i - kSize] : 0);
        const float c = v.w.data()[i] / static_cast<float>(kLambda);
        const float next = (u[i] + step * (divergence + c * v.f.data()[i])) / (1 + step * c);
        ahead[i] = 2 * next - u[i];
        u[i] = next;
      }
    }
  }
  double energy = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const int i = y * kSize + x;
      const double dx = x + 1 < kSize ? u[i + 1] - u[i] : 0;
      const double dy = y + 1 < kSize ? u[i + kSize] - u[i] : 0;
      const double off = u[i] - v.f.data()[i];
      energy +=
          v.g.data()[i] * std::sqrt(dx * dx + dy * dy) + v.w.data()[i] / (2 * kLambda) * off * off;
    }
  }
  return energy;
}

TvL2Result fast_solve(TvL2Solver& solver, Image<float>& u, int iterations) {
  return solver.solve(view().problem(), {iterations, 0, iterations}, Progress(1), u.view());
}

double optimum() {
  TvL2Solver solver(kSize, kSize);
  Image<float> u(kSize, kSize);
  static const double energy = fast_solve(solver, u, 600).energy;
  return energy;
}

void tv_l2_plain(benchmark::State& state) {
  const int iterations = static_cast<int>(state.range(0));
  double energy = 0;
  for (auto _ : state) energy = plain_solve(view(), iterations);
  state.counters["excess_energy"] = energy / optimum() - 1;
}
BENCHMARK(tv_l2_plain)->Arg(100)->Arg(400)->Arg(1600)->Unit(benchmark::kMillisecond)->Iterations(1);

void tv_l2_solver(benchmark::State& state) {
  TvL2Solver solver(kSize, kSize);
  Image<float> u(kSize, kSize);
  TvL2Result result;
  for (auto _ : state) result = fast_solve(solver, u, kIterations);
  state.counters["excess_energy"] = result.energy / optimum() - 1;
  state.counters["relative_gap"] = result.gap / result.energy;
}
BENCHMARK(tv_l2_solver)->Unit(benchmark::kMillisecond)->Iterations(5);

// Seconds of one full-resolution iteration: the slope between two lengths.
double seconds_per_iteration() {
  TvL2Solver solver(kSize, kSize);
  Image<float> u(kSize, kSize);
  double best[2] = {1e9, 1e9};
  for (int repeat = 0; repeat < 3; ++repeat) {
    for (int i = 0; i < 2; ++i) {
      const auto start = std::chrono::steady_clock::now();
      fast_solve(solver, u, 10 + 20 * i);
      best[i] = std::min(best[i], seconds_since(start));
    }
  }
  return (best[1] - best[0]) / 20;
}

// How near an iteration comes to copying the bytes that it must read and write. A tenth: a plane of
// 2.4 MB is copied within the cache, which holds those of the solver as well, so what counts is
// arithmetic. A sweep of one color computes all lanes and keeps half of them, and there are four
// on each level, besides two projections with reciprocal roots and the residual: about 100
// operations a pixel.
void tv_l2_bytes(benchmark::State& state) {
  // Reads u, zx, zy, rx, ry, inverse, f, c, g; writes u, zx, zy, b; coarser levels add a third of
  // u, b, rx, ry, inverse, c twice.
  constexpr double kPlanes = 13 + 2 * 7.0 / 3;
  double seconds = 0;
  for (auto _ : state) seconds = seconds_per_iteration();
  const double bytes = kPlanes * sizeof(float) * kSize * kSize;
  state.counters["ms_per_iteration"] = 1e3 * seconds;
  state.counters["GB_per_s"] = bytes / seconds / 1e9;
  state.counters["of_copy"] = bytes / seconds / copied_bytes_per_second();
}
BENCHMARK(tv_l2_bytes)->Unit(benchmark::kMillisecond)->Iterations(1);

// The same number of plain and of solver iterations: what the kernels alone are worth; and the time
// the plain loops would need for the energy that the solver reaches.
void tv_l2_ratio(benchmark::State& state) {
  double per_iteration = 0, to_energy = 0;
  for (auto _ : state) {
    TvL2Solver solver(kSize, kSize);
    Image<float> u(kSize, kSize);
    auto start = std::chrono::steady_clock::now();
    const double energy = fast_solve(solver, u, kIterations).energy;
    const double fast = seconds_since(start);
    int iterations = 200;
    double plain = 0;
    do {
      iterations *= 2;
      start = std::chrono::steady_clock::now();
      if (plain_solve(view(), iterations) <= energy) break;
      plain = seconds_since(start);
    } while (iterations < 3200);
    plain = seconds_since(start);
    per_iteration = plain / iterations / (fast / kIterations);
    to_energy = plain / fast;
  }
  state.counters["per_iteration"] = per_iteration;
  state.counters["to_same_energy_at_least"] = to_energy;
}
BENCHMARK(tv_l2_ratio)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace

BENCHMARK_MAIN();
