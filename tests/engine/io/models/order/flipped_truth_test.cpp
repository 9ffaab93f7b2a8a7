// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/order/order_check.h"
#include "engine/io/models/order/truth_views.h"
#include "engine/io/models/order/view_axes.h"
#include "tests/engine/io/models/sidecar_maps/layered_folder.h"
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

  void viewsOfTruthInAnotherOrder_arePutRight_data() {
    QTest::addColumn<bool>("transposed");
    QTest::addColumn<bool>("flips_u");
    QTest::addColumn<bool>("flips_v");
    QTest::addColumn<QString>("words");
    QTest::newRow("as stored") << false << false << false << "";
    QTest::newRow("[u][v]") << true << false << false << "rows and columns of views exchanged";
    QTest::newRow("u reversed") << false << true << false << "u reversed";
    QTest::newRow("v reversed") << false << false << true << "v reversed";
    QTest::newRow("counted by columns from below") << true << true << false << "exchanged, u rev";
  }
  /// The center view, and without a flip all on the diagonal, is right in any order.
  void viewsOfTruthInAnotherOrder_arePutRight() {
    QFETCH(bool, transposed);
    QFETCH(bool, flips_u);
    QFETCH(bool, flips_v);
    QFETCH(QString, words);
    const LayeredScene scene;
    const GridShape grid = scene.views.grid();
    GroundTruth truth;
    truth.field.disparity = scene.disparity.clone();
    truth.labels = scene.labels.clone();
    if (transposed) io::swap_view_axes(truth);
    io::reverse_views(truth.field, grid, {flips_u, flips_v});
    io::reverse_views(truth.labels, grid, {flips_u, flips_v});

    const auto warnings =
        io::put_truth_views_in_order(LightField::Samples(scene.views.clone()), truth);

    QCOMPARE(warnings.size(), std::size_t{words.isEmpty() ? 0U : 2U});
    for (const std::string& warning : warnings) {
      QVERIFY2(warning.find(words.toStdString()) != std::string::npos, warning.c_str());
    }
    QCOMPARE(largest_difference(truth.field, {scene.disparity.clone(), {}}), 0.0);
    QVERIFY(std::equal(scene.labels.data(), scene.labels.data() + scene.labels.size(),
                       truth.labels.data()));
  }

  /// Where no disparity is known, edges of the views tell.
  void labelsAloneInAnotherOrder_arePutRight() {
    LayeredScene scene;
    for (int i = 0; i < static_cast<int>(scene.views.size()); ++i) {
      std::uint8_t& sample = scene.views.data()[i];
      sample = sample / 8 + (scene.labels.data()[i / 3] == 2 ? 100 : 0);
    }
    GroundTruth truth;
    truth.labels = scene.labels.clone();
    io::swap_view_axes(truth);

    const auto warnings =
        io::put_truth_views_in_order(LightField::Samples(scene.views.clone()), truth);

    QCOMPARE(warnings.size(), std::size_t{1});
    QVERIFY(std::equal(scene.labels.data(), scene.labels.data() + scene.labels.size(),
                       truth.labels.data()));
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
