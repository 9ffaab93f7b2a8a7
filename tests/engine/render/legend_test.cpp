// SPDX-License-Identifier: BSD-3-Clause
#include "engine/render/shade.h"
#include "tests/test_main.h"

namespace episcope::in_legend_test {

class LegendTest : public QObject {
  Q_OBJECT

 private slots:
  void picture_staysAsItIs() {
    Image<std::uint8_t> picture(120, 30, 4);
    for (std::size_t i = 0; i < picture.size(); ++i) {
      picture.data()[i] = i % 4 == 3 ? 255 : static_cast<std::uint8_t>(i % 200);
    }
    const render::Shading shading{render::color_map("viridis"), {-1, 1}};

    const Image<std::uint8_t> whole = render::with_legend(picture, shading, "px");

    QCOMPARE(whole.height(), 120);
    QVERIFY(whole.width() > 60);
    for (int x = 0; x < 30; ++x) QCOMPARE(whole.at(7, x, 1), picture.at(7, x, 1));
  }

  void bar_runsFromLargeToSmall() {
    Image<std::uint8_t> picture(20, 10, 4);
    std::fill_n(picture.data(), picture.size(), std::uint8_t{0});
    const render::Shading shading{render::color_map("grey"), {0, 1}};

    const Image<std::uint8_t> whole = render::with_legend(picture, shading, "");

    QVERIFY(whole.height() >= 100);
    const int bar = 10 + 8 + 2;
    QVERIFY(whole.at(6, bar, 0) > 250);
    QVERIFY(whole.at(35, bar, 0) < whole.at(15, bar, 0));
    QVERIFY(whole.at(68, bar, 0) < 5);
    QCOMPARE(whole.at(5, 5, 0), std::uint8_t{255});  // transparent: white
  }
};

}  // namespace episcope::in_legend_test

EPISCOPE_TEST(legend_test, LegendTest)
#include "legend_test.moc"
