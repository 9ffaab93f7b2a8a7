// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/pixel_features.h"

#include "engine/scenes/builtin.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>

namespace episcope::in_disparity_trust_test {

class DisparityTrustTest : public QObject {
  Q_OBJECT

 private slots:
  void sure_isTrusted_unsureIsNot() {
    Image<float> confidence(40, 60);
    for (int y = 0; y < 40; ++y) std::fill_n(confidence.row(y), 30, 0.8F);

    const Image<float> trust = disparity_trust(confidence.view());

    QCOMPARE(trust.at(20, 10), 1.0F);
    QCOMPARE(trust.at(20, 50), 0.0F);
    // Beside what is sure there is some trust, the less the farther.
    QVERIFY(trust.at(20, 31) > trust.at(20, 33));
    QVERIFY(trust.at(20, 33) > 0);
  }

  // Methods scale confidence differently.
  void unit_doesNotMatter() {
    Image<float> confidence(40, 60), smaller(40, 60);
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 60; ++x) {
        confidence.at(y, x) = static_cast<float>(x) / 60;
        smaller.at(y, x) = 0.25F * confidence.at(y, x);
      }
    }

    const Image<float> trust = disparity_trust(confidence.view());
    const Image<float> same = disparity_trust(smaller.view());

    for (int x = 0; x < 60; ++x) {
      QVERIFY(std::abs(trust.at(20, x) - same.at(20, x)) < 1e-5F);
    }
    // Half of what suffices is worth a quarter.
    const int enough = static_cast<int>(0.43 * 54);
    QVERIFY(std::abs(trust.at(20, enough / 2) - 0.25F) < 0.06F);
    QCOMPARE(trust.at(20, enough + 2), 1.0F);
  }

  // Without trust, edges are those of the image alone.
  void untrustedDisparity_makesNoEdges() {
    scenes::RenderOptions options;
    options.grid = {3, 3};
    options.height = options.width = 64;
    const Scene scene = scenes::render_builtin("objects", options, Progress());
    const LightField& lf = *scene.light_field;
    const ViewRectangle center{lf.center(), {1, 1}};
    const ViewStack<float> none({1, 1}, lf.height(), lf.width(), 1, lf.center());
    const DisparityField& truth = scene.truth->field;
    const auto alone = edge_probabilities(lf, center, {}, {}, Progress(1));

    const auto untrusted = edge_probabilities(lf, center, truth, {}, Progress(1), &none);
    const auto trusted = edge_probabilities(lf, center, truth, {}, Progress(1));

    QVERIFY(std::equal(alone.data(), alone.data() + alone.size(), untrusted.data()));
    QVERIFY(!std::equal(alone.data(), alone.data() + alone.size(), trusted.data()));
  }
};

}  // namespace episcope::in_disparity_trust_test

EPISCOPE_TEST(disparity_trust_test, DisparityTrustTest)
#include "disparity_trust_test.moc"
