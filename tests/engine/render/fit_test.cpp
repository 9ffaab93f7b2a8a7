// SPDX-License-Identifier: BSD-3-Clause
#include "engine/render/shade.h"

#include "tests/test_main.h"

namespace episcope::in_fit_test {

class FitTest : public QObject {
  Q_OBJECT

 private slots:
  void smallPictures_stayAsTheyAre() {
    Image<std::uint8_t> picture(2, 3, 4);
    picture.at(1, 2, 3) = 200;
    const auto same = render::fitted(picture, 3);
    QCOMPARE(same.height(), 2);
    QCOMPARE(same.width(), 3);
    QCOMPARE(same.at(1, 2, 3), 200);
  }

  void largePictures_areMeansOfAreas() {
    Image<std::uint8_t> picture(2, 4, 1);
    const int samples[2][4] = {{0, 10, 100, 100}, {20, 31, 200, 200}};
    for (int y = 0; y < 2; ++y) {
      for (int x = 0; x < 4; ++x) picture.at(y, x, 0) = static_cast<std::uint8_t>(samples[y][x]);
    }
    const auto small = render::fitted(picture, 2);
    QCOMPARE(small.height(), 1);
    QCOMPARE(small.width(), 2);
    QCOMPARE(small.at(0, 0, 0), 15);  // (0 + 10 + 20 + 31) / 4 = 15.25
    QCOMPARE(small.at(0, 1, 0), 150);
  }

  void theLongerSide_isWhatWasAskedFor() {
    const auto small = render::fitted(Image<std::uint8_t>(701, 97, 3), 128);
    QCOMPARE(small.height(), 128);
    QCOMPARE(small.width(), 17);  // 97 · 128 / 701, rounded down
    const auto thin = render::fitted(Image<std::uint8_t>(1, 1000, 3), 10);
    QCOMPARE(thin.height(), 1);
  }
};

}  // namespace episcope::in_fit_test

EPISCOPE_TEST(fit_test, FitTest)
#include "fit_test.moc"
