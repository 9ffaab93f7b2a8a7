// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/feature_kernel.h"

#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace episcope::in_label_weights_kernel_test {

namespace {

constexpr int kWidth = 37, kLabels = 19, kPitch = 32;

std::vector<float> numbers(int count, float least, float most, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(least, most);
  std::vector<float> all(static_cast<std::size_t>(count));
  for (float& each : all) each = uniform(random);
  return all;
}

const LabelWeightsKernel& kernel_of(Isa isa) {
  return EPISCOPE_CHOOSE_KERNEL(isa, kLabelWeightsKernel);
}

}  // namespace

/// Against the same in double, one label after the other.
class LabelWeightsKernelTest : public QObject {
  Q_OBJECT

 private slots:
  void misfits_followTheirFormula() {
    const auto disparity = numbers(kWidth, -2, 2, 1);
    const auto middle = numbers(kPitch, 0, kWidth, 3), at = numbers(kPitch, -2, 2, 4);
    const auto across = numbers(kPitch, -0.1F, 0.1F, 5), variance = numbers(kPitch, 2e-3F, 1, 6);
    const auto flat = numbers(kPitch, 0, 2, 7), slope = numbers(kPitch, 0, 1e-3F, 8);
    const auto bend = numbers(kPitch, 0, 1e-2F, 9);
    std::vector<float> is_known(kPitch, 1), found(kWidth * kPitch);
    is_known[3] = 0;

    kernel_of(best_isa())
        .misfits(
            {kWidth, kPitch, disparity.data(), is_known.data(), middle.data(), at.data(),
             across.data(), variance.data(), flat.data(), slope.data(), bend.data(), 1.6e-3F, 3},
            found.data());

    for (int x = 0; x < kWidth; ++x) {
      for (int l = 0; l < kLabels; ++l) {
        const double dx = x - static_cast<double>(middle[l]);
        const double v = variance[l] * (1 + flat[l] + slope[l] * dx + bend[l] * dx * dx);
        const double miss = disparity[x] - at[l] - across[l] * dx;
        const double spread = v + miss * miss;
        const double wanted =
            l == 3 ? 1.5 : std::min(0.5 * std::log(spread * spread / (v * 1.6e-3)), 3.0);
        const auto got = static_cast<double>(found[x * kPitch + l]);
        QVERIFY2(std::fabs(got - wanted) < 1e-5,
                 qPrintable(QString("%1, not %2").arg(got).arg(wanted)));
      }
    }
  }

  void weigh_followsItsFormula() {
    auto p = numbers(kWidth * kPitch, 0, 1, 1);
    auto against = numbers(kWidth * kPitch, 0, 9, 2);
    const auto strength = numbers(kWidth, 0, 2, 3);
    std::vector<float> is_weighed(kPitch), floor(kPitch);
    for (int l = 0; l < kPitch; ++l) {
      is_weighed[l] = l < kLabels && l != 5 ? 1.0F : 0.0F;
      floor[l] = l < kLabels ? 0.02F : 0.0F;
      for (int x = 0; x < kWidth && l >= kLabels; ++x) {
        p[x * kPitch + l] = 0;
        against[x * kPitch + l] = 1e9F;
      }
    }
    auto weighed = p;

    kernel_of(best_isa())
        .weigh(
            {kWidth, kPitch, against.data(), strength.data(), is_weighed.data(), floor.data(), 4},
            weighed.data());

    for (int x = 0; x < kWidth; ++x) {
      const float* const first = against.data() + x * kPitch;
      const double best = *std::min_element(first, first + kLabels);
      std::vector<double> wanted(kLabels);
      double sum = 0;
      for (int l = 0; l < kLabels; ++l) {
        const double excess = is_weighed[l] > 0 ? std::min(first[l] - best, 4.0) : 0;
        wanted[l] = (p[x * kPitch + l] + 0.02) * std::exp(-strength[x] * excess);
        sum += wanted[l];
      }
      for (int l = 0; l < kPitch; ++l) {
        const auto got = static_cast<double>(weighed[x * kPitch + l]);
        QVERIFY(std::fabs(got - (l < kLabels ? wanted[l] / sum : 0)) < 1e-6);
      }
    }
  }

  void weigh_leavesNothingAsItIs() {
    std::vector<float> p(kPitch), against(kPitch), strength(1, 1), none(kPitch);

    kernel_of(best_isa())
        .weigh({1, kPitch, against.data(), strength.data(), none.data(), none.data(), 4}, p.data());

    QCOMPARE(p, std::vector<float>(kPitch));
  }

  void kernels_agree() {
    const auto p = numbers(kWidth * kPitch, 0, 1, 1), against = numbers(kWidth * kPitch, 0, 9, 2);
    const auto strength = numbers(kWidth, 0, 2, 3);
    const std::vector<float> ones(kPitch, 1), none(kPitch);
    const auto weighed = [&](Isa isa) {
      auto out = p;
      kernel_of(isa).weigh(
          {kWidth, kPitch, against.data(), strength.data(), ones.data(), none.data(), 4},
          out.data());
      return out;
    };
    const auto plain = weighed(Isa::Baseline), best = weighed(best_isa());

    for (std::size_t i = 0; i < plain.size(); ++i) {
      QVERIFY(std::fabs(plain[i] - best[i]) < 1e-6F);
    }
  }
};

}  // namespace episcope::in_label_weights_kernel_test

EPISCOPE_TEST(label_weights_kernel_test, LabelWeightsKernelTest)
#include "label_weights_kernel_test.moc"
