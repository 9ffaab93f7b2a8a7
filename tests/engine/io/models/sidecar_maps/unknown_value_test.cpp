// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/sidecar_maps/infer_units.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace episcope::in_unknown_value_test {

using namespace episcope::test;

namespace {

constexpr int kTop = 16, kBottom = 46, kLeft = 54, kRight = 78;
constexpr ViewIndex kCenter{2, 2};

/// A plane through disparity 0, whose truth is exactly 0 in a block.
struct PlaneWithZeros {
  ViewStack<std::uint8_t> views;
  DisparityField field;

  PlaneWithZeros() {
    const Scene scene = plane_scene();
    views = bytes_of(scene).clone();
    field.disparity = scene.truth->field.disparity.clone();
    const auto map = field.disparity.view(kCenter);
    for (int y = kTop; y < kBottom; ++y) std::fill_n(map.row(y) + kLeft, kRight - kLeft, 0.0F);
  }
  void add_noise(double deviation) {
    std::mt19937 random(5);
    std::normal_distribution<double> noise(0, deviation);
    std::for_each(views.data(), views.data() + views.size(), [&](std::uint8_t& grey) {
      grey = static_cast<std::uint8_t>(std::clamp(grey + noise(random), 0.0, 255.0));
    });
  }
  /// In all views the same, as a surface of disparity 0 that hides the plane.
  void paste_block() {
    for (int i = 0; i < views.grid().count(); ++i) {
      const auto view = views.view(views.view_at(i));
      for (int y = kTop; y < kBottom; ++y) {
        for (int x = kLeft; x < kRight; ++x) {
          const double grey = 120 + 60 * std::sin(0.8 * x + 0.3 * y) * std::cos(0.5 * y);
          for (int c = 0; c < 3; ++c) view.at(y, x, c) = static_cast<std::uint8_t>(grey);
        }
      }
    }
  }
  std::string drop_zeros() {
    const LightField::Samples samples = views.clone();
    return io::drop_unknown_value(samples, kCenter, {0, 0, 1}, field);
  }
  /// Whether those of the block are marked; the plane itself is 0 at a few pixels, too.
  [[nodiscard]] bool is_block_unknown() const {
    for (int y = kTop; y < kBottom; ++y) {
      for (int x = kLeft; x < kRight; ++x) {
        if (field.view(kCenter).is_valid(y, x)) return false;
      }
    }
    return field.view(kCenter).is_valid(10, 10);
  }
};

}  // namespace

/// Zeros amid values around 0, which may stand for unknown or be right.
class UnknownValueTest : public QObject {
  Q_OBJECT

 private slots:
  void zerosThatTheirSurroundingsBeat_areNotKnown_data() {
    QTest::addColumn<double>("noise");
    QTest::newRow("clean") << 0.0;
    QTest::newRow("under noise") << 15.0;
  }
  void zerosThatTheirSurroundingsBeat_areNotKnown() {
    QFETCH(double, noise);
    PlaneWithZeros plane;
    plane.add_noise(noise);

    const std::string told = plane.drop_zeros();

    QVERIFY2(plane.is_block_unknown(), told.c_str());
    QVERIFY2(told.find("which the views contradict") != std::string::npos, told.c_str());
  }

  void zerosThatAreRight_stay() {
    PlaneWithZeros plane;
    plane.paste_block();

    const std::string told = plane.drop_zeros();

    QVERIFY2(told.empty(), told.c_str());
    QVERIFY(plane.field.valid.empty());
  }

  void zerosThatNothingTells_areReported() {
    PlaneWithZeros plane;
    std::fill_n(plane.views.data(), plane.views.size(), std::uint8_t{90});

    const std::string told = plane.drop_zeros();

    QVERIFY2(told.find("the views do not tell") != std::string::npos, told.c_str());
    QVERIFY(plane.field.valid.empty());
  }
};

}  // namespace episcope::in_unknown_value_test

EPISCOPE_TEST(unknown_value_test, UnknownValueTest)

#include "unknown_value_test.moc"
