// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/ray_labeling.h"

#include "tests/test_main.h"

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace episcope::in_ray_colors_test {

namespace {

constexpr int kHeight = 9, kWidth = 43;
constexpr int kLast = kHeight * kWidth - 1;

// Similar colors everywhere.
LightField light_field(int channels) {
  ViewStack<std::uint8_t> samples({1, 2}, kHeight, kWidth, channels);
  std::mt19937 random(3);
  std::uniform_int_distribution<int> value(100, 125);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples.data()[i] = static_cast<std::uint8_t>(value(random));
  }
  return {std::move(samples), {}};
}

}  // namespace

class RayColorsTest : public QObject {
  Q_OBJECT

 private slots:
  void trusts_areThoseOfEachRay_data() {
    QTest::addColumn<int>("channels");
    QTest::newRow("grey") << 1;
    QTest::newRow("RGB") << 3;
  }
  void trusts_areThoseOfEachRay() {
    QFETCH(int, channels);
    const LightField lf = light_field(channels);
    const RayColors colors(lf, {1, 2}, {0, 0}, Progress());
    std::mt19937 random(5);
    std::uniform_int_distribution<std::int32_t> any(-1, kLast);
    int trusted = 0, partly = 0;
    for (int y = 0; y < kHeight; ++y) {
      const auto pair = colors.pair({0, 0}, y, {0, 1});
      std::vector<std::int32_t> targets(kWidth);
      for (std::int32_t& target : targets) target = any(random);
      targets[y] = -1;
      targets[kWidth - 1 - y] = kLast;
      std::vector<float> trusts(kWidth, 7);

      colors.trusts(pair, {0, kWidth}, targets.data(), trusts.data());

      for (int x = 0; x < kWidth; ++x) {
        QCOMPARE(trusts[x], targets[x] < 0 ? 0.0F : colors.trust(pair, x, targets[x]));
        trusted += trusts[x] > 0 ? 1 : 0;
        partly += trusts[x] > 0 && trusts[x] < 1 ? 1 : 0;
      }
    }
    QVERIFY(trusted > kHeight * kWidth / 2 && partly > 0);
  }

  void otherColumns_stayAsTheyAre() {
    const LightField lf = light_field(3);
    const RayColors colors(lf, {1, 2}, {0, 0}, Progress());
    const std::vector<std::int32_t> targets(kWidth, 4);
    std::vector<float> trusts(kWidth, 7);

    colors.trusts(colors.pair({0, 0}, 2, {0, 1}), {10, 29}, targets.data(), trusts.data());

    QCOMPARE(trusts[9], 7.0F);
    QVERIFY(trusts[10] <= 1 && trusts[28] <= 1);
    QCOMPARE(trusts[29], 7.0F);
  }

  void nothingKnown_isTrusted() {
    const std::vector<std::int32_t> targets{3, -1, 0};
    std::vector<float> trusts(3);

    RayColors().trusts({}, {0, 3}, targets.data(), trusts.data());

    QCOMPARE(trusts, (std::vector<float>{1, 0, 1}));
  }
};

}  // namespace episcope::in_ray_colors_test

EPISCOPE_TEST(ray_colors_test, RayColorsTest)
#include "ray_colors_test.moc"
