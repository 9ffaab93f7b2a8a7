// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/order/view_axes.h"
#include "tests/engine/io/models/order/layered_scene.h"
#include "tests/test_main.h"

#include <cmath>

namespace episcope::in_line_motion_test {

using namespace episcope::test;

class LineMotionTest : public QObject {
  Q_OBJECT

 private:
  /// A picture of which each view shows the middle, enlarged by 1.5 % more than the one before.
  static ViewStack<std::uint8_t> zoomed(int count) {
    const ViewStack<std::uint8_t> one =
        layered_views({.grid = {1, 1}, .height = 192, .width = 256, .discs = 20});
    const ImageView<const std::uint8_t> picture = one.view({0, 0});
    ViewStack<std::uint8_t> film({1, count}, 96, 128, 1);
    for (int i = 0; i < count; ++i) {
      const double scale = 1.3 - 0.015 * i;
      for (int y = 0; y < film.height(); ++y) {
        for (int x = 0; x < film.width(); ++x) {
          const double py = 96 + scale * (y - 47.5), px = 128 + scale * (x - 63.5);
          const int top = static_cast<int>(py), left = static_cast<int>(px);
          const double a = py - top, b = px - left;
          const double value =
              (1 - a) * ((1 - b) * picture.at(top, left) + b * picture.at(top, left + 1)) +
              a * ((1 - b) * picture.at(top + 1, left) + b * picture.at(top + 1, left + 1));
          film.view({0, i}).at(y, x) = static_cast<std::uint8_t>(std::lround(value));
        }
      }
    }
    return film;
  }

 private slots:
  void viewsOfALine_moveAlongIt_data() {
    QTest::addColumn<int>("rows");
    QTest::addColumn<int>("columns");
    QTest::addColumn<double>("noise");
    QTest::newRow("row") << 1 << 9 << 0.0;
    QTest::newRow("column") << 9 << 1 << 0.0;
    QTest::newRow("noisy row") << 1 << 9 << 6.0;
    QTest::newRow("pair") << 1 << 2 << 0.0;
  }
  void viewsOfALine_moveAlongIt() {
    QFETCH(int, rows);
    QFETCH(int, columns);
    QFETCH(double, noise);
    const LightField::Samples views = layered_views({.grid = {rows, columns}, .noise = noise});

    const io::LineMotion motion = io::measure_line_motion(views, Progress());

    QVERIFY2(!motion.is_askew(), motion.warning().c_str());
    QVERIFY2(motion.along > 0.5, motion.warning().c_str());
  }

  void filmOfAZoom_isAskew() {
    const LightField::Samples film = zoomed(9);

    const io::LineMotion motion = io::measure_line_motion(film, Progress());

    QVERIFY2(motion.is_askew(), motion.warning().c_str());
  }
};

}  // namespace episcope::in_line_motion_test

EPISCOPE_TEST(line_motion_test, LineMotionTest)
#include "line_motion_test.moc"
