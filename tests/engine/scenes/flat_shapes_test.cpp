// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/progress.h"
#include "engine/scenes/builtin.h"
#include "tests/test_main.h"

#include <cmath>

namespace episcope::in_flat_shapes_test {

using namespace episcope::scenes;

namespace {

constexpr int kSize = 64;

// Labels of one view of a shape before a wall: 2 where it is seen, else 1. Lengths of the shape are
// in pixels from the middle of the view.
ViewStack<std::int32_t> seen(Shape shape, std::array<double, 3> extent,
                             std::array<double, 3> profile) {
  const Stage stage = make_stage(kSize, kSize);
  Model model;
  model.add(Texture());
  model.primitives.push_back(make_plane(stage, {-1, 0, 0}));
  Primitive& primitive = model.primitives.emplace_back();
  primitive.shape = shape;
  primitive.center[2] = stage.zero_depth;
  for (int i = 0; i < 3; ++i) {
    primitive.extent[i] = extent[i] * stage.pixel(stage.zero_depth);
    primitive.profile[i] = profile[i] * stage.pixel(stage.zero_depth);
  }
  primitive.label = 2;
  RenderOptions options;
  options.grid = {1, 1};
  options.height = options.width = kSize;
  return cast_views(stage, model, options, Progress()).truth.labels;
}

// Distance of a pixel center from the middle of the view.
double from_middle(int at) {
  return at - (kSize - 1) / 2.0;
}

}  // namespace

class FlatShapesTest : public QObject {
  Q_OBJECT

 private slots:
  void leaf_isPointedAtBothEnds() {
    const auto stack = seen(Shape::Leaf, {20.2, 8.3, 0}, {});
    const auto labels = stack.view({0, 0});

    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const double share = from_middle(x) / 20.2;
        const bool is_leaf = std::abs(from_middle(y)) <= 8.3 * (1 - share * share);
        QCOMPARE(labels.at(y, x), is_leaf ? 2 : 1);
      }
    }
  }

  void triangle_hasItsTipOnTheRight() {
    const auto stack = seen(Shape::Triangle, {20.2, 8.3, 0}, {});
    const auto labels = stack.view({0, 0});

    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const double from_tip = 20.2 - from_middle(x);
        const bool is_inside =
            from_tip >= 0 && from_tip <= 40.4 && std::abs(from_middle(y)) <= 8.3 * from_tip / 40.4;
        QCOMPARE(labels.at(y, x), is_inside ? 2 : 1);
      }
    }
  }

  void lattice_hasItsBars_data() {
    QTest::addColumn<double>("level");
    QTest::newRow("upright bars") << -1.0;
    QTest::newRow("bars both ways") << 1.2;
  }
  void lattice_hasItsBars() {
    QFETCH(double, level);
    const auto stack = seen(Shape::Lattice, {25.3, 18.4, level}, {7.0, 11.0, 1.7});
    const auto labels = stack.view({0, 0});

    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const double dx = from_middle(x);
        const double dy = from_middle(y);
        const bool is_inside = std::abs(dx) <= 25.3 && std::abs(dy) <= 18.4;
        const bool is_bar =
            std::abs(std::remainder(dx, 7.0)) <= 1.7 || std::abs(std::remainder(dy, 11.0)) <= level;
        QCOMPARE(labels.at(y, x), is_inside && is_bar ? 2 : 1);
      }
    }
  }
};

}  // namespace episcope::in_flat_shapes_test

EPISCOPE_TEST(flat_shapes_test, FlatShapesTest)
#include "flat_shapes_test.moc"
