// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/solvers/tv_l2.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace episcope::in_binary_segmentation_test {

namespace {

Image<std::uint8_t> divide(const Image<float>& score, double lambda,
                           ImageView<const float> weight = {}) {
  TvL2Solver solver(score.height(), score.width());
  Image<float> scratch(score.height(), score.width());
  Image<std::uint8_t> region(score.height(), score.width());
  (void)segment_binary(solver, {score, weight, {}, lambda}, {200, 1e-6, 10}, Progress(1),
                       scratch.view(), region.view());
  return region;
}

Image<float> score_of(int height, int width, const std::function<bool(int y, int x)>& inside) {
  Image<float> score(height, width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) score.at(y, x) = inside(y, x) ? 1.0F : -1.0F;
  }
  return score;
}

// λ times the length of the border by isotropic forward differences, less the score inside.
double energy(const Image<float>& score, double lambda, unsigned region) {
  const int height = score.height(), width = score.width();
  const auto at = [&](int y, int x) { return static_cast<int>(region >> (y * width + x) & 1U); };
  double sum = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int dx = x + 1 < width ? at(y, x + 1) - at(y, x) : 0;
      const int dy = y + 1 < height ? at(y + 1, x) - at(y, x) : 0;
      sum += lambda * std::sqrt(static_cast<double>(dx * dx + dy * dy));
      if (at(y, x) != 0) sum -= score.at(y, x);
    }
  }
  return sum;
}

unsigned bits_of(const Image<std::uint8_t>& region) {
  unsigned bits = 0;
  for (std::size_t i = 0; i < region.size(); ++i) bits |= unsigned{region.data()[i]} << i;
  return bits;
}

}  // namespace

class BinarySegmentationTest : public QObject {
  Q_OBJECT

 private slots:
  void smallLambda_followsTheSignOfTheScore() {
    const Image<float> score = score_of(9, 11, [](int y, int x) { return (x + y) % 2 == 0; });

    const Image<std::uint8_t> region = divide(score, 1e-3);

    for (std::size_t i = 0; i < region.size(); ++i) {
      QCOMPARE(int{region.data()[i]}, score.data()[i] > 0 ? 1 : 0);
    }
  }

  // A band of width b costs 2λ for each unit of its length and gains 2b over being left out: the
  // score changes sign there.
  void band_isDroppedBeyondItsWidth() {
    const Image<float> score = score_of(48, 48, [](int, int x) { return x >= 20 && x < 26; });

    const auto kept = divide(score, 2.4);
    const auto dropped = divide(score, 3.6);

    QCOMPARE(std::count(kept.begin(), kept.end(), 1), 6 * 48);
    QCOMPARE(std::count(dropped.begin(), dropped.end(), 1), 0);
  }

  void tinyImages_areDividedAsByTryingAll() {
    unsigned state = 7;
    const auto random = [&state] {
      state = state * 1664525U + 1013904223U;
      return static_cast<float>(state >> 8) / (1U << 23) - 1.0F;
    };
    double sum_found = 0, sum_best = 0;
    for (int trial = 0; trial < 12; ++trial) {
      Image<float> score(3, 4);
      for (float& value : score) value = random();
      double best = 1e9;
      for (unsigned region = 0; region < 1U << 12; ++region) {
        best = std::min(best, energy(score, 0.3, region));
      }

      const double found = energy(score, 0.3, bits_of(divide(score, 0.3)));

      // The coarea formula holds but nearly for isotropic differences, which differ most where, as
      // here, every second pixel is a corner.
      sum_found += found;
      sum_best += best;
    }
    QVERIFY2(sum_found < 0.95 * sum_best,
             qPrintable(QString("%1 %2").arg(sum_found).arg(sum_best)));
  }

  void doubtfulPixels_followTheOthers() {
    Image<float> score = score_of(32, 32, [](int, int x) { return x >= 16; });
    Image<float> weight(32, 32, 1, 1.0F);
    for (int y = 12; y < 20; ++y) {
      for (int x = 20; x < 28; ++x) {
        score.at(y, x) = -1;
        weight.at(y, x) = 1e-3F;
      }
    }

    const auto region = divide(score, 0.5, weight);

    QCOMPARE(int{region.at(16, 24)}, 1);
    QCOMPARE(int{region.at(16, 8)}, 0);
  }

  void wrongShape_isRefused() {
    TvL2Solver solver(8, 8);
    Image<float> score(8, 8), scratch(8, 8);
    Image<std::uint8_t> region(8, 7);
    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             (void)segment_binary(solver, {score, {}, {}, 1}, {}, Progress(1),
                                                  scratch.view(), region.view()));
  }
};

}  // namespace episcope::in_binary_segmentation_test

EPISCOPE_TEST(binary_segmentation_test, BinarySegmentationTest)
#include "binary_segmentation_test.moc"
