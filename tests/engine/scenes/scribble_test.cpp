// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/recipes.h"
#include "tests/test_main.h"

namespace episcope::in_scribble_test {

class ScribbleTest : public QObject {
  Q_OBJECT

 private slots:
  void strokes_stayClearOfOutlines() {
    Image<std::int32_t> labels(60, 80, 1, 1);
    for (int y = 20; y < 40; ++y) {
      for (int x = 10; x < 50; ++x) labels.at(y, x) = 7;
    }

    const Image<std::int32_t> painted = scenes::scribble(labels.view());

    int inside = 0;
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 80; ++x) {
        if (painted.at(y, x) != 7) continue;
        ++inside;
        QVERIFY(y >= 25 && y < 35 && x >= 20 && x < 40);
      }
    }
    // Half the width and half the height, less their crossing, one pixel wide.
    QVERIFY(inside >= 20 + 10 - 1);
  }

  void strokes_neverLeaveTheirLabel() {
    Image<std::int32_t> labels(40, 40, 1, 3);
    for (int i = 0; i < 40; ++i) labels.at(i, i) = 5;

    const Image<std::int32_t> painted = scenes::scribble(labels.view());

    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 40; ++x) {
        QVERIFY(painted.at(y, x) == 0 || painted.at(y, x) == labels.at(y, x));
      }
    }
  }
};

}  // namespace episcope::in_scribble_test

EPISCOPE_TEST(scribble_test, ScribbleTest)
#include "scribble_test.moc"
