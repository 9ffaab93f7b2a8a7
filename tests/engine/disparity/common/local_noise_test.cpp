// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/view_samples.h"

#include "engine/core/numbers.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace episcope::in_local_noise_test {

using namespace episcope::test;

namespace {

constexpr float kSigma = 0.02F;

// A single view with an edge at x = 30; noise right of x = `noisy_from` only.
LightField view_of(int channels, float step, int noisy_from) {
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0, kSigma);
  return make_light_field({1, 1}, 60, 80, channels, [&](ViewIndex, int y, int x, int) {
    const float clean = 0.3F + 0.001F * static_cast<float>(y) + (x >= 30 ? step : 0);
    return clean + (x >= noisy_from ? noise(random) : 0);
  });
}

Image<float> variance_of(const LightField& lf) {
  return local_noise_variance(lf, {0, 0}, Progress());
}

}  // namespace

class LocalNoiseTest : public QObject {
  Q_OBJECT

 private slots:
  void noise_isMeasured_data();
  void noise_isMeasured();
  void gradientAndEdge_areNoNoise();
  void noise_isThatOfItsPlace();
  void viewNoise_isThatOfMostPixels();
  void map_isMeasuredAsAView();
  void tinyView_hasNone();
};

void LocalNoiseTest::noise_isMeasured_data() {
  QTest::addColumn<int>("channels");
  QTest::newRow("grey") << 1;
  QTest::newRow("colour") << 3;
}

// Of a map in px: a slope has none, whatever its step.
void LocalNoiseTest::map_isMeasuredAsAView() {
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0, 0.3F);
  Image<float> map(60, 80);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      map.at(y, x) = -3 + 0.25F * static_cast<float>(x) + (y < 30 ? noise(random) : 0);
    }
  }

  Image<float> variance = local_noise_variance(map.view(), Progress());

  const double sigma = std::sqrt(quantile({variance.data(), 80 * 27}, 0.5));
  QVERIFY2(sigma > 0.2 && sigma < 0.32, qPrintable(QString::number(sigma)));
  for (int x = 0; x < 80; ++x) QVERIFY(variance.at(40, x) < 1e-10F);
}

void LocalNoiseTest::noise_isMeasured() {
  QFETCH(int, channels);
  Image<float> variance = variance_of(view_of(channels, 0, 0));
  const double sigma = std::sqrt(quantile({variance.data(), variance.size()}, 0.5));
  // The minimum of four measurements is slightly too low.
  QVERIFY2(sigma > 0.75 * kSigma && sigma < 1.05 * kSigma, qPrintable(QString::number(sigma)));
}

void LocalNoiseTest::gradientAndEdge_areNoNoise() {
  const Image<float> variance = variance_of(view_of(3, 0.5F, 80));
  QVERIFY(*std::max_element(variance.begin(), variance.end()) < 1e-9F);
}

void LocalNoiseTest::noise_isThatOfItsPlace() {
  const Image<float> variance = variance_of(view_of(3, 0.5F, 40));
  QVERIFY(variance.at(30, 20) < 1e-9F);
  QVERIFY(variance.at(30, 60) > 0.2F * kSigma * kSigma);
}

// Noise in three quarters of the view, or in a quarter.
void LocalNoiseTest::viewNoise_isThatOfMostPixels() {
  const auto sigma = [](int noisy_from) {
    return std::sqrt(view_noise_variance(view_of(3, 0.5F, noisy_from), {0, 0}, Progress()));
  };
  QVERIFY2(sigma(20) > 0.7 * kSigma && sigma(20) < 1.05 * kSigma,
           qPrintable(QString::number(sigma(20))));
  QVERIFY(sigma(60) < 1e-4);
}

void LocalNoiseTest::tinyView_hasNone() {
  const LightField tiny =
      make_light_field({1, 1}, 2, 9, 1, [](ViewIndex, int, int x, int) { return 0.1F * x; });
  const Image<float> variance = variance_of(tiny);
  QVERIFY(std::all_of(variance.begin(), variance.end(), [](float v) { return v == 0; }));
}

}  // namespace episcope::in_local_noise_test

EPISCOPE_TEST(local_noise_test, LocalNoiseTest)
#include "local_noise_test.moc"
