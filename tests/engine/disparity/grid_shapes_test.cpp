// SPDX-License-Identifier: BSD-3-Clause
// Every method on grids of one row, of one column, of few and of many views.
#include "engine/core/error.h"
#include "engine/disparity/registry.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <string>
#include <vector>

namespace episcope::in_grid_shapes_test {

using namespace episcope::test;

namespace {

struct Shape {
  const char* name;
  GridShape grid;
  double scale;  // Of disparities: many views see far around.
};

const std::vector<Shape>& shapes() {
  static const std::vector<Shape> all = {
      {"1x9", {1, 9}, 1},     {"9x1", {9, 1}, 1}, {"1x49", {1, 49}, 0.4},
      {"49x1", {49, 1}, 0.4}, {"5x9", {5, 9}, 1}, {"33x3", {33, 3}, 0.5},
      {"3x3", {3, 3}, 1},     {"2x2", {2, 2}, 1}, {"1x2", {1, 2}, 1}};
  return all;
}

// Two superimposed orientations take more views than one.
bool suits(const Estimator& method, GridShape grid) {
  return method.info.id != "epi_two_layer" || (grid.v >= 5 && grid.u >= 5);
}

}  // namespace

class GridShapesTest : public QObject {
  Q_OBJECT

 private slots:
  void shape_isEstimated_data();
  void shape_isEstimated();
  void tooFewViews_areNamed();
};

void GridShapesTest::shape_isEstimated_data() {
  QTest::addColumn<QString>("id");
  QTest::addColumn<int>("index");
  QTest::addColumn<QString>("scene");
  for (const Estimator& method : registered_estimators()) {
    for (std::size_t i = 0; i < shapes().size(); ++i) {
      if (!suits(method, shapes()[i].grid)) continue;
      for (const char* scene : {"slant", "edge"}) {
        QTest::addRow("%s, %s, %s", method.info.id.c_str(), shapes()[i].name, scene)
            << QString::fromStdString(method.info.id) << static_cast<int>(i) << scene;
      }
    }
  }
}

// With the range that is found; two views cannot tell occlusions, so that edges are left out there.
void GridShapesTest::shape_isEstimated() {
  QFETCH(QString, id);
  QFETCH(int, index);
  QFETCH(QString, scene);
  const Shape& shape = shapes()[index];
  const Scene made = render(scene.toStdString(), 72, 80, shape.grid, shape.scale);
  const ViewIndex view = made.light_field->center();

  const Estimate estimate =
      find_estimator(id.toStdString())
          .run(*made.light_field, {}, {.views = ViewSelection::Center}, Progress());

  QVERIFY(all_finite(estimate.field.disparity));
  const Errors error =
      errors(estimate.field.disparity.view(view), made.truth->field.view(view), 10);
  const bool is_narrow = shape.grid.count() < 5;
  const double limit = is_narrow ? 6 : scene == "edge" ? 4 : 1.5;
  QVERIFY2(error.mse_100 < limit, qPrintable(QString::number(error.mse_100)));
}

void GridShapesTest::tooFewViews_areNamed() {
  const Scene made = render("slant", 40, 40, {1, 1});
  for (const Estimator& method : registered_estimators()) {
    try {
      (void)method.run(*made.light_field, {}, {.views = ViewSelection::Center}, Progress());
      QFAIL(method.info.id.c_str());
    } catch (const InvalidInput& error) {
      QVERIFY2(std::string(error.what()).find("views") != std::string::npos, error.what());
    }
  }
}

}  // namespace episcope::in_grid_shapes_test

EPISCOPE_TEST(grid_shapes_test, GridShapesTest)
#include "grid_shapes_test.moc"
