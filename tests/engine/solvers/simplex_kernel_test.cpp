// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/layered_kernel.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace episcope::in_simplex_kernel_test {

namespace {

// By sorting: the threshold of the sorted prefix that still holds its least element.
std::vector<float> projected(std::vector<float> v) {
  std::vector<float> sorted = v;
  std::sort(sorted.rbegin(), sorted.rend());
  float sum = 0, theta = 0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    sum += sorted[i];
    const float next = (sum - 1) / static_cast<float>(i + 1);
    if (sorted[i] > next) theta = next;
  }
  for (float& value : v) value = std::max(value - theta, 0.0F);
  return v;
}

}  // namespace

class SimplexKernelTest : public QObject {
  Q_OBJECT

 private slots:
  void project_agreesWithSorting();
  void kernel_usesAdjointOperators();
};

void SimplexKernelTest::project_agreesWithSorting() {
  constexpr int kWidth = 37, kLabels = 7;
  constexpr long kPitch = 48;
  const LayeredShape shape{kLabels, kWidth, kPitch, 1, 1, 1};
  std::mt19937 random(4);
  std::normal_distribution<float> normal;
  std::vector<float> from(kLabels * kPitch), to(kLabels * kPitch);
  for (float& value : from) value = 2 * normal(random);

  baseline::kSimplexKernel.project(shape, from.data(), to.data());

  for (int x = 0; x < kWidth; ++x) {
    std::vector<float> column;
    for (int l = 0; l < kLabels; ++l) column.push_back(from[l * kPitch + x]);
    column = projected(column);
    for (int l = 0; l < kLabels; ++l) {
      QVERIFY(std::fabs(to[l * kPitch + x] - column[l]) < 1e-5F);
    }
  }
}

// Costs that force a labeling make the bound −⟨div p, u⟩ of its u, which must be ⟨p, ∇u⟩.
void SimplexKernelTest::kernel_usesAdjointOperators() {
  constexpr int kWidth = 21, kLabels = 3;
  constexpr long kPitch = 32, kRow = kLabels * kPitch;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-0.5F, 0.5F);
  const LayeredShape shape{kLabels, kWidth, kPitch, 1, 1, 1};
  std::vector<float> memory(7 * kRow + 32), limits(kPitch + 32, 1.0F);
  const auto row = [&](int i) { return memory.data() + 16 + i * kRow; };
  PairDuals first, none;
  for (int k = 0; k < kPairKinds; ++k) {
    first.pair[k] = row(k);
    none.pair[k] = row(4);
    first.limit[k] = none.limit[k] = limits.data() + 16;
    for (int l = 0; l < kLabels; ++l) {
      for (int x = 0; x < kWidth - (k != 1 ? 1 : 0); ++x) row(k)[l * kPitch + x] = uniform(random);
    }
  }
  float *const u = row(5), *const below = row(6);
  std::vector<int> chosen(2 * kWidth);
  for (int& label : chosen) label = static_cast<int>((uniform(random) + 0.5F) * kLabels);
  for (int x = 0; x < kWidth; ++x) {
    u[chosen[x] * kPitch + x] = 1;
    below[chosen[kWidth + x] * kPitch + x] = 1;
  }
  double product = 0, bounds = 0;
  for (long i = 0; i < kRow; ++i) {
    if (i % kPitch >= kWidth) continue;
    product += row(0)[i] * (u[i + 1] - u[i]) + row(1)[i] * (below[i] - u[i]) +
               row(2)[i] * (below[i + 1] - u[i]) + row(3)[i] * (below[i] - u[i + 1]);
  }

  for (int y = 0; y < 2; ++y) {
    std::vector<float> cost(kLabels * kWidth, 1e3F);  // 0 at the chosen label
    for (int x = 0; x < kWidth; ++x) cost[chosen[y * kWidth + x] * kWidth + x] = 0;
    bounds += baseline::kSimplexKernel.bound(shape, cost.data(), y == 0 ? first : none,
                                             y == 0 ? none : first);
  }

  QVERIFY2(std::fabs(bounds - product) < 1e-4,
           qPrintable(QString("%1 and not %2").arg(bounds).arg(product)));
}

}  // namespace episcope::in_simplex_kernel_test

EPISCOPE_TEST(simplex_kernel_test, SimplexKernelTest)
#include "simplex_kernel_test.moc"
