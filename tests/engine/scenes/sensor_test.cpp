// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/stage.h"
#include "tests/test_main.h"

#include <cmath>
#include <set>
#include <vector>

namespace episcope::in_sensor_test {

using scenes::Exposure;
using scenes::Sensor;

namespace {

constexpr int kHeight = 101;
constexpr int kWidth = 401;
constexpr float kLight = 0.5F;

Exposure::Format format() {
  Exposure::Format format;
  format.height = kHeight;
  format.width = kWidth;
  format.channels = 1;
  return format;
}

std::vector<std::uint8_t> row(const Exposure& exposure, int y, ViewIndex steps = {0, 0}) {
  const std::vector<float> light(3 * kWidth, kLight);
  std::vector<std::uint8_t> samples(kWidth);
  exposure.write_row(steps, y, light.data(), static_cast<std::uint64_t>(y) * kWidth,
                     samples.data());
  return samples;
}

double mean(const std::vector<std::uint8_t>& samples) {
  double sum = 0;
  for (const std::uint8_t sample : samples) sum += sample;
  return sum / static_cast<double>(samples.size());
}

double deviation(const std::vector<std::uint8_t>& samples) {
  const double middle = mean(samples);
  double sum = 0;
  for (const std::uint8_t sample : samples) sum += (sample - middle) * (sample - middle);
  return std::sqrt(sum / static_cast<double>(samples.size()));
}

}  // namespace

class SensorTest : public QObject {
  Q_OBJECT

 private slots:
  void plainSensor_keepsTheLight() {
    const Exposure exposure({}, format());

    QCOMPARE(row(exposure, 10, {3, -2}), std::vector<std::uint8_t>(kWidth, 128));
  }

  void exposure_multiplies() {
    Sensor sensor;
    sensor.exposure = 0.25F;

    QCOMPARE(row(Exposure(sensor, format()), 10), std::vector<std::uint8_t>(kWidth, 32));
  }

  void vignetting_darkensTheCorners() {
    Sensor sensor;
    sensor.vignetting = 0.5F;
    const Exposure exposure(sensor, format());

    const auto top = row(exposure, 0);
    QCOMPARE(int{top.front()}, 64);
    QCOMPARE(int{top.back()}, 64);
    QCOMPARE(int{row(exposure, kHeight / 2)[kWidth / 2]}, 128);
  }

  void gains_differBetweenViewsWithinTheSpread() {
    Sensor sensor;
    sensor.gain_spread = 0.1F;
    const Exposure exposure(sensor, format());

    std::set<float> gains;
    for (int v = -4; v <= 4; ++v) {
      for (int u = -4; u <= 4; ++u) {
        const float gain = exposure.gain({v, u});
        QVERIFY(gain >= 0.9F && gain <= 1.1F);
        gains.insert(gain);
      }
    }
    QCOMPARE(exposure.gain({0, 0}), 1.0F);
    QVERIFY(gains.size() > 70);
    QVERIFY(*gains.begin() < 0.95F && *gains.rbegin() > 1.05F);
    const double expected = 127.5 * static_cast<double>(exposure.gain({2, 1}));
    QVERIFY(std::abs(mean(row(exposure, 5, {2, 1})) - expected) <= 0.5);
  }

  void noise_growsFromTopToBottom() {
    Sensor sensor;
    sensor.noise_top = 2;
    sensor.noise_bottom = 10;
    const Exposure exposure(sensor, format());

    // 401 samples: within a sixth, four standard deviations.
    QVERIFY(std::abs(deviation(row(exposure, 0)) - 2) < 0.33);
    QVERIFY(std::abs(deviation(row(exposure, kHeight / 2)) - 6) < 1);
    QVERIFY(std::abs(deviation(row(exposure, kHeight - 1)) - 10) < 1.66);
  }
};

}  // namespace episcope::in_sensor_test

EPISCOPE_TEST(sensor_test, SensorTest)
#include "sensor_test.moc"
