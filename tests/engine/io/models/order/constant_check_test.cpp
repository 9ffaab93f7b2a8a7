// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/order/order_check.h"
#include "engine/io/models/order/warp_check.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <algorithm>
#include <random>

namespace episcope::in_constant_check_test {

using namespace episcope::test;

namespace {

constexpr ViewIndex kCenter{2, 2};

/// A plane wholly in front of disparity 0, where any map of about the right mean explains the views
/// better than none.
struct NearPlane {
  ViewStack<std::uint8_t> views;
  ViewStack<float> map{{1, 1}, 64, 80, 1, kCenter};

  NearPlane() {
    const Scene scene = plane_scene({.d0 = 2});
    views = bytes_of(scene).clone();
    const auto truth = scene.truth->field.disparity.view(kCenter);
    std::copy_n(truth.data, truth.size(), map.data());
  }
  void mirror() {
    const auto view = map.view(kCenter);
    for (int y = 0; y < view.height; ++y) std::reverse(view.row(y), view.row(y) + view.width);
  }
  /// Views of different brightness.
  void flicker(double most) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> gain(1 - most, 1 + most);
    for (int i = 0; i < views.grid().count(); ++i) {
      const auto view = views.view(views.view_at(i));
      const double factor = 0.8 * gain(random);
      std::transform(view.data, view.data + view.size(), view.data, [=](std::uint8_t grey) {
        return static_cast<std::uint8_t>(std::min(255.0, factor * grey));
      });
    }
  }
  [[nodiscard]] DisparityView truth() const { return {map.view(kCenter), {}}; }
  [[nodiscard]] io::OrderFinding order() const {
    return io::find_order(views.clone(), {{kCenter, truth()}}, {{}, "the test says so"},
                          io::Flip::Auto, Progress(1));
  }
  [[nodiscard]] io::WarpErrors errors() const {
    return io::warp_errors(views.clone(), kCenter, truth());
  }
};

}  // namespace

/// Whether a truth is right, and not just better than nothing.
class ConstantCheckTest : public QObject {
  Q_OBJECT

 private slots:
  void rightTruth_isChecked_data() {
    QTest::addColumn<double>("flicker");
    QTest::newRow("clean") << 0.0;
    QTest::newRow("under flicker") << 0.1;
  }
  void rightTruth_isChecked() {
    QFETCH(double, flicker);
    NearPlane plane;
    plane.flicker(flicker);

    const io::OrderFinding finding = plane.order();

    QVERIFY2(finding.warnings.empty(), finding.warnings.empty() ? "" : finding.warnings[0].c_str());
    QCOMPARE(finding.sign, std::string("checked"));
  }

  /// What a few squares say is right, though chance is hard to exclude.
  void rightTruthThatFewSquaresCheck_isNotDoubted() {
    NearPlane plane;
    for (int i = 0; i < plane.views.grid().count(); ++i) {
      const auto view = plane.views.view(plane.views.view_at(i));
      for (int y = 0; y < view.height; ++y) {
        if (y >= 32 && y < 48) continue;
        std::transform(
            view.row(y), view.row(y) + view.row_stride, view.row(y),
            [](std::uint8_t grey) { return static_cast<std::uint8_t>(127 + (grey - 127) / 24); });
      }
    }

    const io::ConstantComparison comparison =
        io::compare_with_constant(plane.views.clone(), kCenter, plane.truth(), plane.errors());

    QVERIFY2(comparison.is_better(), qPrintable(QString::number(comparison.left)));
    QVERIFY2(comparison.score < 2.7, qPrintable(QString::number(comparison.score)));
  }

  void mirroredTruth_isNotCalledChecked() {
    NearPlane plane;
    plane.mirror();

    const io::OrderFinding finding = plane.order();

    QVERIFY2(finding.sign.empty(), finding.sign_check.c_str());
    QCOMPARE(finding.warnings.size(), std::size_t{1});
    QVERIFY2(finding.warnings[0].find("could not be checked") != std::string::npos,
             finding.warnings[0].c_str());
  }

  void brightness_isEvenedOut() {
    NearPlane plane;
    const io::WarpErrors before = plane.errors();
    plane.flicker(0.1);

    const io::WarpErrors after = plane.errors();

    // Views are a fifth darker on the average; gains are known to less than 2 %.
    QVERIFY2(after.best() < before.best() + 1, qPrintable(QString::number(after.best())));
    QVERIFY(after.unwarped() > 3 * after.best());
  }

  void constantTruth_cannotBeTold() {
    NearPlane plane;
    std::fill_n(plane.map.data(), plane.map.size(), 2.0F);

    const io::ConstantComparison comparison =
        io::compare_with_constant(plane.views.clone(), kCenter, plane.truth(), plane.errors());

    QVERIFY(!comparison.is_told());
    QVERIFY(!comparison.is_better());
  }
};

}  // namespace episcope::in_constant_check_test

EPISCOPE_TEST(constant_check_test, ConstantCheckTest)

#include "constant_check_test.moc"
