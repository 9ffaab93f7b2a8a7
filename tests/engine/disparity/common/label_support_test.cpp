// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/disparity_range.h"

#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <cmath>
#include <numeric>

namespace episcope::in_label_support_test {

using namespace episcope::test;

class LabelSupportTest : public QObject {
  Q_OBJECT

 private slots:
  // Of the two planes, one at −0.5 and one at 0.8 px.
  void labels_getTheShareOfTheirPixels() {
    const Scene scene = render("edge", 64, 80, {5, 5});

    const std::vector<double> support =
        label_support(*scene.light_field, {-2, -0.5, 0, 0.8, 2}, Progress());

    const double far = support[1], near = support[3];
    QVERIFY2(far > 0.4 && near > 0.4, qPrintable(QString("%1, %2").arg(far).arg(near)));
    QVERIFY(std::abs(std::accumulate(support.begin(), support.end(), 0.0) - 1) < 1e-9);
  }

  // Stripes 4 px apart suit −3 as well as 1: three views cannot tell which.
  void pixelsThatMatchSeveralLabels_doNotCount() {
    const LightField lf =
        make_light_field({3, 3}, 48, 48, 1, [](ViewIndex view, int y, int x, int) {
          const int px = x + view.u - 1, py = y + view.v - 1;
          const bool is_striped = y < 24;
          return is_striped ? static_cast<float>(px % 4) / 4.0F
                            : static_cast<float>((px * 37 + py * 71 + px * py * 13) % 101) / 101.0F;
        });

    const std::vector<double> support = label_support(lf, {-3, -1, 1, 3}, Progress());

    QVERIFY2(support[0] < 0.05, qPrintable(QString::number(support[0])));
    QVERIFY2(support[2] > 0.9, qPrintable(QString::number(support[2])));
  }

  void pixel_isMatchedWhereItsSurroundingsTellItsDisparity() {
    const Scene scene = render("objects", 160, 160);
    const LightField& lf = *scene.light_field;
    const ViewIndex view = lf.center();
    int found = 0, right = 0, all = 0;
    for (int y = 8; y < 160; y += 16) {
      for (int x = 8; x < 160; x += 16) {
        const auto disparity = matched_disparity(lf, view, {y, x}, {-3, 3}, Progress());
        ++all;
        if (!disparity) continue;
        ++found;
        const double truth = scene.truth->field.view(view).disparity.at(y, x);
        right += std::abs(*disparity - truth) < 0.2 ? 1 : 0;
      }
    }
    QVERIFY2(found > all / 2, qPrintable(QString("%1 of %2").arg(found).arg(all)));
    QVERIFY2(right > 0.8 * found, qPrintable(QString("%1 of %2").arg(right).arg(found)));
  }

  void pixelsWithoutTexture_doNotCount() {
    const LightField lf =
        make_light_field({3, 3}, 16, 16, 1, [](ViewIndex, int, int, int) { return 0.5F; });
    QCOMPARE(label_support(lf, {-1, 0, 1}, Progress()), (std::vector<double>{0, 0, 0}));
    QVERIFY(!matched_disparity(lf, {1, 1}, {8, 8}, {-1, 1}, Progress()));
  }
};

}  // namespace episcope::in_label_support_test

EPISCOPE_TEST(label_support_test, LabelSupportTest)
#include "label_support_test.moc"
