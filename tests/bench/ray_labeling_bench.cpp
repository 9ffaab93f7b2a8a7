// SPDX-License-Identifier: BSD-3-Clause
// Multi-label TV against the plain loops that one would write first (Chambolle and Pock 2011, with
// the simplex projected to by sorting), and against what the memory can copy; and labels of a whole
// light field. All use as many threads as the machine has.
#include "engine/core/parallel.h"
#include "engine/labeling/ray_superpixels.h"
#include "engine/labeling/regularizer.h"
#include "engine/scenes/builtin.h"
#include "engine/solvers/simplex_labeling.h"
#include "tests/bench/bench_scene.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace {

using namespace episcope;
using bench::now;

constexpr int kSize = 512;
constexpr int kLabels = 13;
constexpr double kSmoothness = 8;

int true_label(int y, int x) {
  return (x / 90 * 3 + y / 110 * 5) % kLabels;
}

// Patches seen by a classifier that is mistaken in places.
Volume<float> make_costs() {
  Volume<float> costs(kSize, kLabels, kSize);
  parallel_for(kSize, Progress(), [&](int y) {
    std::mt19937 random(static_cast<unsigned>(y));
    std::uniform_real_distribution<float> uniform;
    for (int l = 0; l < kLabels; ++l) {
      for (int x = 0; x < kSize; ++x) {
        costs.view().at(y, l, x) = (l == true_label(y, x) ? 0.4F : 1.2F) + 1.2F * uniform(random);
      }
    }
  });
  return costs;
}

const Volume<float>& costs() {
  static const Volume<float> the_costs = make_costs();
  return the_costs;
}

SimplexResult solve(int iterations, double gap) {
  static SimplexSolver solver(kSize, kLabels, kSize);
  static Image<int> labels(kSize, kSize);
  return solver.solve({costs().view(), {}, kSmoothness}, {iterations, gap, 1000000, {}}, Progress(),
                      labels.view());
}

// One iteration as one writes it down: isotropic TV, two duals.
class PlainLabeling {
 public:
  PlainLabeling() {
    for (auto* each : {&u_, &ahead_, &px_, &py_}) each->assign(kCount, 0.0F);
  }

  void iterate() {
    parallel_for(kSize, Progress(), [this](int y) { move_duals(y); });
    parallel_for(kSize, Progress(), [this](int y) { move_primal(y); });
  }

 private:
  static constexpr long kRow = static_cast<long>(kLabels) * kSize;
  static constexpr long kCount = kSize * kRow;
  static constexpr float kStep = 0.35F;

  void move_duals(int y) {
    constexpr auto limit = static_cast<float>(kSmoothness / 2);
    for (long i = y * kRow; i < (y + 1) * kRow; ++i) {
      const float a = px_[i] + (i % kSize + 1 < kSize ? kStep * (ahead_[i + 1] - ahead_[i]) : 0);
      const float b = py_[i] + (y + 1 < kSize ? kStep * (ahead_[i + kRow] - ahead_[i]) : 0);
      const float norm = std::sqrt(a * a + b * b);
      const float scale = norm > limit ? limit / norm : 1.0F;
      px_[i] = a * scale;
      py_[i] = b * scale;
    }
  }

  void move_primal(int y) {
    float column[kLabels], sorted[kLabels];
    for (int x = 0; x < kSize; ++x) {
      for (int l = 0; l < kLabels; ++l) {
        const long i = y * kRow + static_cast<long>(l) * kSize + x;
        const float divergence =
            px_[i] - (x > 0 ? px_[i - 1] : 0) + py_[i] - (y > 0 ? py_[i - kRow] : 0);
        sorted[l] = column[l] = u_[i] + kStep * (divergence - costs().view().data[i]);
      }
      std::sort(sorted, sorted + kLabels, std::greater<>());
      float sum = 0, theta = 0;
      for (int l = 0; l < kLabels; ++l) {
        sum += sorted[l];
        const float next = (sum - 1) / static_cast<float>(l + 1);
        if (sorted[l] > next) theta = next;
      }
      for (int l = 0; l < kLabels; ++l) {
        const long i = y * kRow + static_cast<long>(l) * kSize + x;
        const float next = std::max(column[l] - theta, 0.0F);
        ahead_[i] = 2 * next - u_[i];
        u_[i] = next;
      }
    }
  }

  std::vector<float> u_, ahead_, px_, py_;
};

// Seconds of an iteration: the slope between two lengths.
double seconds_per_iteration() {
  double best[2] = {1e9, 1e9};
  for (int repeat = 0; repeat < 3; ++repeat) {
    for (int i = 0; i < 2; ++i) {
      const double start = now();
      (void)solve(2 + 20 * i, 0);
      best[i] = std::min(best[i], now() - start);
    }
  }
  return (best[1] - best[0]) / 20;
}

void simplex_iteration(benchmark::State& state) {
  // Reads the costs, u and four duals; writes u and the duals.
  constexpr double kBytes = 11.0 * sizeof(float) * kSize * kSize * kLabels;
  double fast = 0, plain = 1e9;
  for (auto _ : state) {
    fast = seconds_per_iteration();
    PlainLabeling labeling;
    for (int i = 0; i < 4; ++i) {
      const double start = now();
      labeling.iterate();
      plain = std::min(plain, now() - start);
    }
  }
  state.counters["s_per_iteration"] = fast;
  state.counters["s_plain_iteration"] = plain;
  state.counters["times_faster"] = plain / fast;
  state.counters["GB_per_s"] = kBytes / fast / 1e9;
  state.counters["of_copy"] = kBytes / fast / bench::copied_bytes_per_second();
}
BENCHMARK(simplex_iteration)->Unit(benchmark::kSecond)->Iterations(1);

// 9×9 views of a plane with patches, 13 labels of which a quarter of all rays are mistaken.
void label_light_field(benchmark::State& state) {
  constexpr GridShape grid{9, 9};
  LabelProbabilities p;
  for (int l = 1; l <= kLabels; ++l) p.ids.push_back(l);
  p.grid = grid;
  for (int i = 0; i < grid.count(); ++i) p.views.emplace_back(kSize, kLabels, kSize);
  parallel_for(grid.count(), Progress(), [&](int i) {
    std::mt19937 random(static_cast<unsigned>(i));
    const auto map = p.views[i].view();
    std::fill_n(map.data, map.size(), std::uint8_t{10});
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const auto draw = random();
        map.at(y, draw % 4 == 0 ? static_cast<int>(draw / 4 % kLabels) : true_label(y, x), x) = 135;
      }
    }
  });
  DisparityField field{ViewStack<float>(grid, kSize, kSize), {}};
  std::fill_n(field.disparity.data(), field.disparity.size(), 0.0F);
  bench::reset_peak_memory();
  const RayLabelingInput input{&p, &field, nullptr, nullptr};
  RayLabeling result;
  const auto regularizer = state.range(0) == 0 ? Regularizer::View : Regularizer::Rayspace;
  for (auto _ : state) {
    result = label_rays(input, regularizer, {.smoothness = kSmoothness}, Progress());
  }
  state.counters["iterations"] = result.iterations;
  state.counters["gap"] = result.relative_gap();
  state.counters["peak_MiB"] = static_cast<double>(bench::peak_memory()) / (1 << 20);
}
BENCHMARK(label_light_field)
    ->ArgName("rays")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kSecond)
    ->Iterations(1);

// The superpixels of 9×9 views, and one region of them to be shown under the cursor.
void ray_superpixels(benchmark::State& state) {
  scenes::RenderOptions options;
  options.height = options.width = kSize;
  const Scene scene = scenes::render_builtin("demo", options, Progress());
  double made = 0, shown = 0;
  for (auto _ : state) {
    const double start = now();
    const RaySuperpixels superpixels(*scene.light_field, scene.truth->field, Progress());
    made = now() - start;
    const auto ids = superpixels.ids().view({0, 0});
    const auto selected = superpixels.alike(ids.at(kSize / 2, kSize / 2), 0.3F);
    std::vector<std::uint8_t> mask(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) mask[i] = selected[ids.data[i]];
    benchmark::DoNotOptimize(mask.data());
    shown = now() - start - made;
  }
  state.counters["s_made"] = made;
  state.counters["ms_shown"] = 1e3 * shown;
}
BENCHMARK(ray_superpixels)->Unit(benchmark::kSecond)->Iterations(3);

}  // namespace

BENCHMARK_MAIN();
