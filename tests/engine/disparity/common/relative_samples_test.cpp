// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/view_samples.h"

#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>

namespace episcope::in_relative_samples_test {

using namespace episcope::test;

namespace {

constexpr int kRadius = 2;
constexpr int kHeight = 9, kWidth = 11;

float sample(ViewIndex view, int y, int x, int c) {
  const double wave = std::sin(0.9 * x + view.u) + std::cos(0.7 * y + 0.4 * x + c);
  return static_cast<float>(0.4 + 0.1 * wave);
}

// By the definition.
double expected(const LightField& lf, ViewIndex view, int y, int x, int c) {
  double sum = 0, count = 0;
  for (int i = std::max(0, y - kRadius); i <= std::min(kHeight - 1, y + kRadius); ++i) {
    for (int j = std::max(0, x - kRadius); j <= std::min(kWidth - 1, x + kRadius); ++j) {
      if (!lf.is_valid(view, i, j)) continue;
      sum += sample(view, i, j, c);
      count += 1;
    }
  }
  return std::min(1.0, 0.5 * sample(view, y, x, c) / (sum / count));
}

double largest_error(const LightField& lf) {
  const LightField relative = relative_samples(lf, kRadius, Progress());
  double largest = 0;
  for (int i = 0; i < lf.grid().count(); ++i) {
    const ViewIndex view = lf.grid().view_at(i);
    const Image<float> image = relative.view_as_float(view);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        for (int c = 0; c < lf.channels() && lf.is_valid(view, y, x); ++c) {
          const double off = image.at(y, x, c) - expected(lf, view, y, x, c);
          largest = std::max(largest, std::fabs(off));
        }
      }
    }
  }
  return largest;
}

}  // namespace

class RelativeSamplesTest : public QObject {
  Q_OBJECT

 private slots:
  void sample_isHalfItsRatioToTheMean() {
    QVERIFY(largest_error(make_light_field({2, 3}, kHeight, kWidth, 3, sample)) < 2e-5);
  }

  void invalidPixels_enterNoMean() {
    const LightField bare = make_light_field({1, 2}, kHeight, kWidth, 1, sample);
    ViewStack<float> samples = float_samples(bare);
    ViewStack<std::uint8_t> valid({1, 2}, kHeight, kWidth);
    std::fill_n(valid.data(), valid.size(), std::uint8_t{1});
    for (int x = 3; x < 8; ++x) {
      valid.view({0, 1}).at(4, x) = 0;
      samples.view({0, 1}).at(4, x) = 0;
    }
    QVERIFY(largest_error({std::move(samples), {}, std::move(valid)}) < 2e-5);
  }

  void gain_changesNothing() {
    const LightField lf =
        make_light_field({1, 2}, kHeight, kWidth, 1, [](ViewIndex view, int y, int x, int c) {
          const float gain = view.u == 1 ? 0.7F : 1;
          return gain * sample({0, 0}, y, x, c);
        });
    const LightField relative = relative_samples(lf, kRadius, Progress());
    const Image<float> a = relative.view_as_float({0, 0}), b = relative.view_as_float({0, 1});
    QVERIFY(largest_difference(a.view(), b.view()) < 3e-5);
  }
};

}  // namespace episcope::in_relative_samples_test

EPISCOPE_TEST(relative_samples_test, RelativeSamplesTest)
#include "relative_samples_test.moc"
