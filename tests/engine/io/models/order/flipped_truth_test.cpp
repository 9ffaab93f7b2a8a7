// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/order/order_check.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <algorithm>

namespace episcope::in_flipped_truth_test {

using namespace episcope::test;

/// Truth whose rows, or rows and columns, a program wrote in another order.
class FlippedTruthTest : public QObject {
  Q_OBJECT

 private:
  static Scene square_plane() {
    PlaneOptions options;
    options.width = options.height;
    options.slope_x = 0.03;
    options.slope_y = -0.02;
    return plane_scene(options);
  }
  /// Of the center view.
  static DisparityField truth_of(const Scene& scene) {
    const ViewIndex center = scene.light_field->grid().center();
    const auto from = scene.truth->field.disparity.view(center);
    DisparityField field{ViewStack<float>({1, 1}, from.height, from.width, 1, center), {}};
    std::copy_n(from.data, from.size(), field.disparity.data());
    return field;
  }
  static DisparityField turned(const DisparityField& field, bool transposed) {
    DisparityField out{field.disparity.clone(), {}};
    const auto from = field.disparity.view(field.disparity.first());
    const auto to = out.disparity.view(field.disparity.first());
    for (int y = 0; y < from.height; ++y) {
      for (int x = 0; x < from.width; ++x) {
        to.at(y, x) = transposed ? from.at(x, y) : from.at(from.height - 1 - y, x);
      }
    }
    return out;
  }

 private slots:
  void turnedTruth_isPutUpright_data() {
    QTest::addColumn<bool>("transposed");
    QTest::addColumn<QString>("words");
    QTest::newRow("upside down") << false << "bottom to top";
    QTest::newRow("transposed") << true << "rows and columns exchanged";
  }
  void turnedTruth_isPutUpright() {
    QFETCH(bool, transposed);
    QFETCH(QString, words);
    const Scene scene = square_plane();
    const DisparityField right = truth_of(scene);
    DisparityField field = turned(right, transposed);

    const std::string undone = io::put_truth_upright(scene.light_field->samples(), field).undone;

    QVERIFY2(undone.find(words.toStdString()) != std::string::npos, undone.c_str());
    QCOMPARE(largest_difference(right, field), 0.0);
  }

  void mirroredTruthOfAllViews_isPutUpright() {
    const Scene scene = square_plane();
    const ViewStack<float>& right = scene.truth->field.disparity;
    DisparityField field{right.clone(), {}};
    for (int i = 0; i < right.grid().count(); ++i) {
      const auto view = field.disparity.view(right.view_at(i));
      for (int y = 0; y < view.height; ++y) std::reverse(view.row(y), view.row(y) + view.width);
    }

    const std::string undone = io::put_truth_upright(scene.light_field->samples(), field).undone;

    QVERIFY2(undone.find("right to left") != std::string::npos, undone.c_str());
    QCOMPARE(largest_difference(scene.truth->field, field), 0.0);
  }

  /// Much of the motion is explained upside down, too.
  void turnedTruthOfLittleDepth_isPutUpright() {
    PlaneOptions options;
    options.d0 = 2;
    options.slope_x = 0;
    options.slope_y = 0.02;
    const Scene scene = plane_scene(options);
    const DisparityField right = truth_of(scene);
    DisparityField field = turned(right, false);

    QVERIFY(!io::put_truth_upright(scene.light_field->samples(), field).undone.empty());
    QCOMPARE(largest_difference(right, field), 0.0);
  }

  void rightTruth_isLeft() {
    const Scene scene = square_plane();
    DisparityField field = truth_of(scene);

    QCOMPARE(io::put_truth_upright(scene.light_field->samples(), field).undone, std::string());
    QCOMPARE(largest_difference(truth_of(scene), field), 0.0);
  }

  void truthThatFitsNoWay_isLeft() {
    const Scene scene = square_plane();
    DisparityField field = truth_of(scene);
    std::fill_n(field.disparity.data(), field.disparity.size(), 3.0F);

    QCOMPARE(io::put_truth_upright(scene.light_field->samples(), field).undone, std::string());
    QCOMPARE(field.disparity.data()[0], 3.0F);
  }
};

}  // namespace episcope::in_flipped_truth_test

EPISCOPE_TEST(flipped_truth_test, FlippedTruthTest)
#include "flipped_truth_test.moc"
