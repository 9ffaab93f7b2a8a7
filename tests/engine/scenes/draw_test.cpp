// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/stage.h"
#include "tests/test_main.h"

#include <cmath>

namespace episcope::in_draw_test {

using scenes::Draw;

constexpr int kDraws = 40000;

class DrawTest : public QObject {
  Q_OBJECT

 private slots:
  void sameSeed_drawsTheSame() {
    Draw one(5);
    Draw two(5);
    Draw other(6);
    int equal = 0;
    for (int i = 0; i < 100; ++i) {
      const double drawn = one.unit();
      QCOMPARE(two.unit(), drawn);
      equal += other.unit() == drawn;
    }
    QCOMPARE(equal, 0);
  }

  void part_doesNotDependOnWhatWasDrawn() {
    Draw one(5);
    const double first = one.part(3).unit();
    one.unit();

    QCOMPARE(one.part(3).unit(), first);
    QVERIFY(one.part(4).unit() != first);
  }

  void unit_isUniform() {
    Draw draw(1);
    double sum = 0;
    double squares = 0;
    for (int i = 0; i < kDraws; ++i) {
      const double u = draw.unit();
      QVERIFY(u >= 0 && u < 1);
      sum += u;
      squares += u * u;
    }
    // 40 000 draws give ±0.0015.
    QVERIFY(std::abs(sum / kDraws - 0.5) < 0.006);
    QVERIFY(std::abs(squares / kDraws - 1.0 / 3) < 0.006);
  }

  void weighted_followsTheWeights() {
    Draw draw(2);
    int counts[3] = {};
    for (int i = 0; i < kDraws; ++i) ++counts[draw.weighted(std::array<double, 3>{1, 0, 3})];

    QCOMPARE(counts[1], 0);
    QVERIFY(std::abs(counts[0] / static_cast<double>(kDraws) - 0.25) < 0.01);
  }

  void integer_reachesBothEnds() {
    Draw draw(3);
    int counts[3] = {};
    for (int i = 0; i < kDraws; ++i) ++counts[draw.integer(4, 6) - 4];

    for (const int count : counts) QVERIFY(std::abs(count - kDraws / 3) < kDraws / 50);
  }
};

}  // namespace episcope::in_draw_test

EPISCOPE_TEST(draw_test, DrawTest)
#include "draw_test.moc"
