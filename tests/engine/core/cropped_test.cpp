// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/shear.h"
#include "tests/test_main.h"

#include <algorithm>

namespace episcope::in_cropped_test {

class CroppedTest : public QObject {
  Q_OBJECT

 private slots:
  void cropped_keepsThePixelsOfThePart() {
    ViewStack<std::uint8_t> samples({2, 3}, 6, 8, 3);
    for (std::size_t i = 0; i < samples.size(); ++i) samples.data()[i] = i * 7 % 251;
    ViewStack<std::uint8_t> valid({2, 3}, 6, 8);
    std::fill_n(valid.data(), valid.size(), std::uint8_t{1});
    valid.view({1, 2}).at(3, 5) = 0;
    LightFieldInfo info;
    info.camera.pinhole = Pinhole{100, 4, 3};
    const LightField whole(std::move(samples), info, std::move(valid));

    const LightField part = cropped(whole, {2, 3, 5, 8}, Progress());

    QVERIFY(part.grid() == whole.grid());
    QCOMPARE(part.height(), 3);
    QCOMPARE(part.width(), 5);
    for (int i = 0; i < 6; ++i) {
      const ViewIndex view = part.grid().view_at(i);
      for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 5; ++x) {
          for (int c = 0; c < 3; ++c) {
            QCOMPARE(part.view<std::uint8_t>(view).at(y, x, c),
                     whole.view<std::uint8_t>(view).at(y + 2, x + 3, c));
          }
        }
      }
    }
    QVERIFY(!part.is_valid({1, 2}, 1, 2));
    QVERIFY(part.is_valid({1, 1}, 1, 2));
    QCOMPARE(part.info().camera.pinhole->center_x, 1.0);
    QCOMPARE(part.info().camera.pinhole->center_y, 1.0);
  }
};

}  // namespace episcope::in_cropped_test

EPISCOPE_TEST(cropped_test, CroppedTest)
#include "cropped_test.moc"
