// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/predict_from_strokes.h"
#include "tests/test_main.h"

#include <cmath>
#include <vector>

namespace episcope::in_label_surfaces_test {

namespace {

constexpr int kHeight = 80;
constexpr int kWidth = 96;

double ground(int y) {
  return 0.02 * y - 0.5;
}

// Ground of label 1 that rises towards the viewer, and a card of label 2 at one depth, of which the
// left part is painted.
struct Room {
  Image<float> disparity{kHeight, kWidth};
  Image<std::int32_t> strokes{kHeight, kWidth};

  Room() {
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const bool is_card = x > 60 && y < 40;
        disparity.at(y, x) = static_cast<float>(is_card ? ground(45) : ground(y));
      }
    }
    for (int y = 10; y < 25; ++y) {
      for (int x = 10; x < 16; ++x) strokes.at(y, x) = 1;
      for (int x = 64; x < 70; ++x) strokes.at(y, x) = 2;
    }
  }
  [[nodiscard]] float misfit(int y, int x, int label, int labels = 2) const {
    const LabelSurfaces surfaces(strokes.view(), labels, disparity.view(), {}, Progress());
    return surfaces.misfits(y)[static_cast<std::ptrdiff_t>(x) * surfaces.pitch() + label];
  }
};

}  // namespace

class LabelSurfacesTest : public QObject {
  Q_OBJECT

 private slots:
  // What a forest that knows disparities gets wrong: ground at the depth of the card.
  void ground_fitsItsPlaneAtUnpaintedDepths() {
    const Room room;
    QCOMPARE(room.disparity.at(45, 30), room.disparity.at(20, 80));

    QVERIFY(room.misfit(45, 30, 0) < room.misfit(45, 30, 1));
    QVERIFY(room.misfit(20, 80, 1) + 1 < room.misfit(20, 80, 0));
  }

  void outliers_doNotTiltThePlane() {
    Room room;
    for (int y = 16; y < 19; ++y) {
      for (int x = 10; x < 16; ++x) room.disparity.at(y, x) = 3;
    }

    QVERIFY(std::abs(room.misfit(30, 20, 0) - Room().misfit(30, 20, 0)) < 0.1F);
  }

  void misfits_areBounded() {
    const Room room;
    for (const int x : {0, 50, 95}) {
      for (int label = 0; label < 2; ++label) {
        QVERIFY(room.misfit(79, x, label) <= LabelSurfaces::kMostMisfit);
      }
    }
    // A label without strokes is neither likely nor excluded.
    QCOMPARE(room.misfit(5, 5, 2, 3), LabelSurfaces::kMostMisfit / 2);
  }

  void support_scalesWhatSpeaksAgainstALabel() {
    const Room room;
    LabelSurfaces surfaces(room.strokes.view(), 2, room.disparity.view(), {}, Progress());

    surfaces.set_support({0.25F, 1}, Progress());

    // On the card, and on the ground.
    const float* at = surfaces.misfits(20) + static_cast<std::ptrdiff_t>(80) * surfaces.pitch();
    const float all = room.misfit(20, 80, 0) - room.misfit(20, 80, 1);
    QVERIFY(std::abs(at[0] - at[1] - 0.25F * all) < 1e-5F);
    at = surfaces.misfits(20) + static_cast<std::ptrdiff_t>(30) * surfaces.pitch();
    QCOMPARE(at[0], room.misfit(20, 30, 0));
    QCOMPARE(at[1], room.misfit(20, 30, 1));
  }

  void weighing_keepsTheSum() {
    const Room room;
    const LabelSurfaces surfaces(room.strokes.view(), 2, room.disparity.view(), {}, Progress());
    std::vector<float> p(static_cast<std::size_t>(kWidth) * 16);
    for (int x = 0; x < kWidth; ++x) p[static_cast<std::size_t>(x) * 16] = 1;

    surfaces.weigh_row(20, p.data());

    for (int x = 0; x < kWidth; ++x) {
      const float* at = p.data() + static_cast<std::ptrdiff_t>(x) * 16;
      QVERIFY(std::abs(at[0] + at[1] - 1) < 1e-5F);
    }
    // Even a forest that is sure can be overruled.
    QVERIFY(p[16 * 20] > 0.9F);
    QVERIFY(p[16 * 80 + 1] > 0.1F);
  }

  void untrustedDisparity_saysNothing() {
    const Room room;
    const Image<float> trust(kHeight, kWidth);
    const LabelSurfaces surfaces(room.strokes.view(), 2, room.disparity.view(), trust.view(),
                                 Progress());
    std::vector<float> p(static_cast<std::size_t>(kWidth) * 16);
    for (int x = 0; x < kWidth; ++x) p[static_cast<std::size_t>(x) * 16] = 1;

    surfaces.weigh_row(20, p.data());

    for (int x = 0; x < kWidth; ++x) QCOMPARE(p[static_cast<std::size_t>(x) * 16], p[0]);
    QVERIFY(p[0] > 0.97F);
  }
};

}  // namespace episcope::in_label_surfaces_test

EPISCOPE_TEST(label_surfaces_test, LabelSurfacesTest)
#include "label_surfaces_test.moc"
