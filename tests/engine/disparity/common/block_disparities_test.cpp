// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/block_disparities.h"

#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace episcope::in_block_disparities_test {

using namespace episcope::test;

namespace {

// Texture at d = 1, of this amplitude, under noise, and darker towards the borders of each view.
LightField textured(double amplitude, float noise, double vignetting) {
  std::mt19937 random(5);
  std::normal_distribution<float> normal(0, noise);
  return make_light_field({5, 5}, 64, 64, 1, [&](ViewIndex view, int y, int x, int) {
    const double px = x + view.u - 2, py = y + view.v - 2;
    const double texture = std::sin(0.61 * px) + std::sin(0.53 * py + 0.2 * px);
    const double away = std::hypot(x - 32, y - 32) / 32;
    const double light = 0.5 + amplitude * texture - vignetting * away * away;
    return static_cast<float>(light) + (noise > 0 ? normal(random) : 0);
  });
}

std::size_t count_near(const std::vector<BlockDisparity>& blocks, double disparity, double off) {
  return std::ranges::count_if(blocks, [&](const BlockDisparity& block) {
    return std::fabs(block.disparity - disparity) <= off + block.doubt;
  });
}

}  // namespace

class BlockDisparitiesTest : public QObject {
  Q_OBJECT

 private slots:
  void blocks_matchWhereTheSceneIs_data() {
    QTest::addColumn<double>("amplitude");
    QTest::addColumn<double>("noise");
    QTest::addColumn<double>("vignetting");
    QTest::addColumn<double>("off");
    QTest::addColumn<bool>("isForLarge");
    QTest::newRow("clear") << 0.15 << 0.0 << 0.0 << 0.1 << false;
    // Whole labels match worse, for lack of interpolation that averages the noise. Other labels
    // cost about twice as much: no more than chance may give to 16 pixels.
    QTest::newRow("faint, under noise") << 0.01 << 0.003 << 0.0 << 0.25 << true;
    QTest::newRow("vignetted") << 0.03 << 0.0 << 0.3 << 0.1 << false;
  }
  void blocks_matchWhereTheSceneIs() {
    QFETCH(double, amplitude);
    QFETCH(double, noise);
    QFETCH(double, vignetting);
    QFETCH(double, off);
    QFETCH(bool, isForLarge);

    const auto blocks = block_disparities(
        textured(amplitude, static_cast<float>(noise), vignetting), {-3, 3}, Progress());

    QCOMPARE(blocks.size(), 2U);
    for (const auto& list : blocks) {
      const std::size_t least = isForLarge && &list == &blocks.front() ? 0 : 20;
      const std::size_t near = count_near(list, 1, off);
      const QString counts = QString("%1 of %2").arg(near).arg(list.size());
      QVERIFY2(list.size() >= least, qPrintable(counts));
      QVERIFY2(near >= 0.95 * list.size(), qPrintable(counts));
    }
  }

  // Stripes 4 px apart suit −3 as well as 1.
  void repeatedPatterns_areNotDistinct() {
    const LightField lf =
        make_light_field({3, 3}, 48, 48, 1, [](ViewIndex view, int y, int x, int) {
          return static_cast<float>((x + y + view.u + view.v - 2) % 4) / 4.0F;
        });
    for (const auto& list : block_disparities(lf, {-4, 4}, Progress())) QVERIFY(list.empty());
  }

  void nothingButNoise_tellsNothing() {
    std::mt19937 random(3);
    std::normal_distribution<float> noise(0.5F, 0.01F);
    const LightField lf = make_light_field({5, 5}, 64, 64, 1,
                                           [&](ViewIndex, int, int, int) { return noise(random); });
    const auto blocks = block_disparities(lf, {-3, 3}, Progress());
    QVERIFY2(blocks[1].size() < 10, qPrintable(QString::number(blocks[1].size())));
    QVERIFY2(blocks[0].size() < 10, qPrintable(QString::number(blocks[0].size())));
  }

  void viewsSmallerThanABlock_tellNothing() {
    const LightField lf =
        make_light_field({3, 3}, 3, 6, 1, [](ViewIndex, int, int, int) { return 0.5F; });
    for (const auto& list : block_disparities(lf, {-1, 1}, Progress())) QVERIFY(list.empty());
  }
};

}  // namespace episcope::in_block_disparities_test

EPISCOPE_TEST(block_disparities_test, BlockDisparitiesTest)
#include "block_disparities_test.moc"
