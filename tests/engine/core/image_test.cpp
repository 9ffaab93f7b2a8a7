// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/image.h"
#include "tests/test_main.h"

#include <algorithm>

namespace episcope::in_image_test {

class ImageTest : public QObject {
  Q_OBJECT

 private slots:
  void image_interleavesChannels() {
    Image<int> image(2, 3, 3, 7);

    image.at(1, 2, 1) = 42;

    QCOMPARE(image.size(), std::size_t{18});
    QCOMPARE(image.data()[(1 * 3 + 2) * 3 + 1], 42);
    QCOMPARE(std::count(image.begin(), image.end(), 7), 17);
  }

  void view_borrows() {
    Image<int> image(4, 5);

    ImageView<int> view = image.view();
    view.at(3, 4) = 9;
    const ImageView<const int> read_only = view;

    QCOMPARE(image.at(3, 4), 9);
    QCOMPARE(read_only.at(3, 4), 9);
  }

  void view_honoursItsStride() {
    Image<int> image(4, 6);
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 6; ++x) image.at(y, x) = 10 * y + x;
    }

    const ImageView<int> part{image.row(1) + 2, 2, 3, 1, 6};

    QCOMPARE(part.at(0, 0), 12);
    QCOMPARE(part.at(1, 2), 24);
    QCOMPARE(part.size(), std::size_t{6});
  }

  void emptyImage_isEmpty() {
    QVERIFY(Image<int>{}.empty());
    QVERIFY(ImageView<int>{}.empty());
    QVERIFY(!Image<int>(1, 1).empty());
  }
};

}  // namespace episcope::in_image_test

EPISCOPE_TEST(image_test, ImageTest)
#include "image_test.moc"
