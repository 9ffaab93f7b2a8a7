// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/stage.h"
#include "tests/test_main.h"

#include <cmath>

namespace episcope::in_sensor_noise_test {

using episcope::scenes::sensor_noise;

class SensorNoiseTest : public QObject {
  Q_OBJECT

 private slots:
  void noise_isNormal() {
    constexpr int count = 200000;
    double moments[4] = {};
    int beyond_two = 0;
    for (int i = 0; i < count; ++i) {
      const double n = sensor_noise(1, i);
      beyond_two += std::abs(n) > 2;
      for (int k = 0; k < 4; ++k) moments[k] += std::pow(n, k + 1) / count;
    }

    // Four standard errors each; the kurtosis of twelve uniform numbers is 2.9.
    QVERIFY(std::abs(moments[0]) < 0.009);
    QVERIFY(std::abs(moments[1] - 1) < 0.013);
    QVERIFY(std::abs(moments[2]) < 0.035);
    QVERIFY(std::abs(moments[3] - 2.9) < 0.09);
    QVERIFY(std::abs(beyond_two / double{count} - 0.0455) < 0.003);
  }

  void neighbours_areIndependent() {
    constexpr int count = 100000;
    double product = 0;
    double seeds = 0;
    for (int i = 0; i < count; ++i) {
      product += sensor_noise(1, i) * sensor_noise(1, i + 1) / count;
      seeds += sensor_noise(1, i) * sensor_noise(2, i) / count;
    }

    QVERIFY(std::abs(product) < 0.013);
    QVERIFY(std::abs(seeds) < 0.013);
  }

  void noise_dependsOnItsArgumentsAlone() {
    QCOMPARE(sensor_noise(3, 12345), sensor_noise(3, 12345));
    QVERIFY(sensor_noise(3, 12345) != sensor_noise(4, 12345));
  }
};

}  // namespace episcope::in_sensor_noise_test

EPISCOPE_TEST(sensor_noise_test, SensorNoiseTest)
#include "sensor_noise_test.moc"
