// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/predict_from_strokes.h"

#include "tests/test_main.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace episcope::in_surface_support_test {

namespace {

constexpr int kHeight = 64;
constexpr int kWidth = 48;
constexpr int kMiddle = kWidth / 2;
constexpr int kUnpainted = 40;  // From this row on.

// Label 1 on the left, label 2 on the right, told apart by their only feature; each painted
// above kUnpainted and at a depth of its own.
struct Halves {
  Volume<float> features{kHeight, 1, kWidth};
  Image<float> disparity{kHeight, kWidth};
  Image<float> trust{kHeight, kWidth};
  Image<std::int32_t> strokes{kHeight, kWidth};
  ForestSamples samples{1, 2, {}, {}};

  Halves() {
    std::fill(trust.begin(), trust.end(), 1.0F);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const int label = x < kMiddle ? 0 : 1;
        features.view().at(y, 0, x) = static_cast<float>(label);
        disparity.at(y, x) = static_cast<float>(label);
        if (y >= kUnpainted || x % kMiddle < 4 || x % kMiddle > 18) continue;
        strokes.at(y, x) = label + 1;
        samples.features.push_back(static_cast<float>(label));
        samples.labels.push_back(label);
      }
    }
  }
  /// The lower part of the left half gets the disparity of the right one.
  void mistake_left() {
    for (int y = kUnpainted; y < kHeight; ++y) {
      for (int x = 0; x < kMiddle; ++x) disparity.at(y, x) = 1;
    }
  }
  [[nodiscard]] std::vector<float> support(int threads = 2) const {
    const Forest forest = Forest::train(samples, {.trees = 8}, Progress());
    const LabelSurfaces surfaces(strokes.view(), 2, disparity.view(), trust.view(), Progress());
    return surface_support({forest, features.view(), Progress()}, surfaces, trust.view(),
                           Progress(threads));
  }
};

}  // namespace

class SurfaceSupportTest : public QObject {
  Q_OBJECT

 private slots:
  void surfacesThatFit_areBelieved() {
    const std::vector<float> support = Halves().support();

    QCOMPARE(support.size(), std::size_t{2});
    QCOMPARE(support[0], 1.0F);
    QCOMPARE(support[1], 1.0F);
  }

  void disparityThatContradictsTheImage_isNot() {
    Halves halves;
    halves.mistake_left();

    const std::vector<float> support = halves.support();

    // Three of eight rows do not fit.
    QVERIFY(support[0] > 0.55F && support[0] < 0.8F);
    QCOMPARE(support[1], 1.0F);
  }

  void pixelsWithoutTrust_sayNothing() {
    Halves halves;
    halves.mistake_left();
    for (int y = kUnpainted; y < kHeight; ++y) std::fill_n(halves.trust.row(y), kWidth, 0.0F);

    QCOMPARE(halves.support()[0], 1.0F);
  }

  void threads_doNotMatter() {
    Halves halves;
    halves.mistake_left();

    QCOMPARE(halves.support(1), halves.support(2));
  }
};

}  // namespace episcope::in_surface_support_test

EPISCOPE_TEST(surface_support_test, SurfaceSupportTest)
#include "surface_support_test.moc"
