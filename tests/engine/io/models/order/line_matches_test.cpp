// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/order/line_matches.h"
#include "tests/test_main.h"

#include <cmath>
#include <numbers>
#include <random>

namespace episcope::in_line_matches_test {

class LineMatchesTest : public QObject {
  Q_OBJECT

 private:
  static constexpr int kSize = 256;
  static constexpr double kUsual_px = 5;

  /// A row of views of a wall that moves by `step_px` from view to view, with noise. Its pattern
  /// repeats every `period_px`.
  static LightField::Samples moving(double step_px, double period_px) {
    ViewStack<std::uint8_t> views({1, 3}, kSize, kSize, 1);
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0, 4);
    for (int u = 0; u < 3; ++u) {
      for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
          const double along = 2 * std::numbers::pi * (x + (u - 1) * step_px) / period_px;
          const double down = 2 * std::numbers::pi * y / 23;
          const double grey =
              128 + 40 * std::sin(along + std::sin(down)) + 20 * std::cos(2 * along);
          views.view({0, u}).at(y, x) =
              static_cast<std::uint8_t>(std::lround(grey + noise(random)));
        }
      }
    }
    return views;
  }

 private slots:
  /// A pattern agrees with itself a period further, too.
  void largestMotion_isNotThatOfARepeatedPattern() {
    QVERIFY(io::CoarseMotion(moving(1, 24)).largest(false, kUsual_px, Progress()) <= kUsual_px);
  }
  void largestMotion_isThatOfViewsFarApart() {
    const double found = io::CoarseMotion(moving(18, 90)).largest(false, kUsual_px, Progress());

    QVERIFY2(found >= 17 && found <= 23, qPrintable(QString::number(found)));
  }
};

}  // namespace episcope::in_line_matches_test

EPISCOPE_TEST(line_matches_test, LineMatchesTest)
#include "line_matches_test.moc"
