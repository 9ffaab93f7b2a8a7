// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/sidecar_maps/depth_fit.h"
#include "engine/io/models/sidecar_maps/disparity_units.h"
#include "tests/engine/io/models/sidecar_maps/layered_folder.h"
#include "tests/test_main.h"

#include <cmath>

namespace episcope::in_map_meaning_test {

using namespace episcope::test;

/// What numbers of disparity and depth maps mean: unit, sign, camera.
class MapMeaningTest : public QObject {
  Q_OBJECT

 private:
  static Image<float> copy(ImageView<const float> map, double factor) {
    Image<float> scaled(map.height, map.width);
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        scaled.at(y, x) = static_cast<float>(factor * map.at(y, x));
      }
    }
    return scaled;
  }
  static LightField::Samples samples(const LayeredScene& scene) { return scene.views.clone(); }
  /// Views with rows and columns exchanged.
  static LightField::Samples exchanged(const LayeredScene& scene) {
    const ViewStack<std::uint8_t>& views = scene.views;
    ViewStack<std::uint8_t> other({views.grid().u, views.grid().v}, views.height(), views.width(),
                                  views.channels());
    for (int i = 0; i < views.grid().count(); ++i) {
      const ViewIndex view = views.grid().view_at(i);
      std::copy_n(views.view(view).data, views.view_size(), other.view({view.u, view.v}).data);
    }
    return other;
  }

 private slots:
  void unit_isWhatExplainsTheViews_data() {
    QTest::addColumn<double>("stored");  // per px and view step
    QTest::addColumn<double>("factor");
    QTest::newRow("per step") << 1.0 << 1.0;
    QTest::newRow("whole baseline") << 4.0 << 0.25;
    QTest::newRow("to the outermost view") << 2.0 << 0.5;
    QTest::newRow("negative") << -1.0 << 1.0;
    QTest::newRow("negative, whole baseline") << -4.0 << 0.25;
    QTest::newRow("widths") << 1.0 / 72 << 72.0;
  }
  void unit_isWhatExplainsTheViews() {
    QFETCH(double, stored);
    QFETCH(double, factor);
    const LayeredScene scene;
    const ViewIndex center = scene.views.grid().center();
    const Image<float> map = copy(scene.disparity.view(center), stored);

    const io::SettledUnit found = io::settle_unit(samples(scene), center, {map.view(), {}},
                                                  io::common_units(scene.views.grid(), 72));

    QCOMPARE(found.unit.factor, factor);
    QVERIFY(found.explanation.is_good());
  }

  void unit_staysWhereNothingExplainsTheViews() {
    const LayeredScene scene;
    const ViewIndex center = scene.views.grid().center();
    Image<float> map(scene.views.height(), scene.views.width());
    for (int i = 0; i < static_cast<int>(map.size()); ++i) {
      map.data()[i] = static_cast<float>(3 * std::sin(0.7 * i * i));
    }

    const io::SettledUnit found = io::settle_unit(samples(scene), center, {map.view(), {}},
                                                  io::common_units(scene.views.grid(), 72));

    QCOMPARE(found.unit.factor, 1.0);
    QVERIFY(!found.explanation.is_good());
  }

  // Small numbers explain a little of any views.
  void unit_staysWhereAConstantIsMissing_data() {
    QTest::addColumn<float>("constant");
    for (const float constant : {-4.0F, -3.0F, 3.0F, 4.0F}) {
      QTest::newRow(qPrintable(QString::number(constant))) << constant;
    }
  }
  void unit_staysWhereAConstantIsMissing() {
    QFETCH(float, constant);
    const LayeredScene scene;
    const ViewIndex center = scene.views.grid().center();
    Image<float> map = copy(scene.disparity.view(center), 1);
    for (float& disparity : map) disparity += constant;

    const io::SettledUnit found = io::settle_unit(samples(scene), center, {map.view(), {}},
                                                  io::common_units(scene.views.grid(), 72));

    QCOMPARE(found.unit.factor, 1.0);
  }

  void exchangedRowsAndColumns_areNoOtherUnit() {
    const LayeredScene scene;
    const ViewIndex center = scene.views.grid().center();

    const io::SettledUnit found =
        io::settle_unit(exchanged(scene), center, {scene.disparity.view(center), {}},
                        io::common_units(scene.views.grid(), 72));

    QCOMPARE(found.unit.factor, 1.0);
    QVERIFY(found.explanation.is_transposed);
    QVERIFY(found.explanation.is_good());
  }

  void nearSide_isWhatHidesTheOther_data() {
    QTest::addColumn<double>("sign");
    QTest::addColumn<bool>("exchange");
    QTest::newRow("larger is nearer") << 1.0 << false;
    QTest::newRow("smaller is nearer") << -1.0 << false;
    QTest::newRow("larger is nearer, rows and columns exchanged") << 1.0 << true;
    QTest::newRow("smaller is nearer, rows and columns exchanged") << -1.0 << true;
  }
  void nearSide_isWhatHidesTheOther() {
    QFETCH(double, sign);
    QFETCH(bool, exchange);
    const LayeredScene scene;
    const ViewIndex center = scene.views.grid().center();
    const Image<float> map = copy(scene.disparity.view(center), sign);
    const LightField::Samples views = exchange ? exchanged(scene) : samples(scene);
    const io::Explanation explanation = io::explain_views(views, center, {map.view(), {}}, 1);

    const io::OcclusionOrder side =
        io::find_occlusion_order(views, center, {map.view(), {}}, 1, explanation);

    QVERIFY(side.is_decided());
    QCOMPARE(side.larger_is_nearer(), sign > 0);
  }

  void nearSide_isFoundInWeakViews() {
    LayeredScene scene;
    // Square and wall differ by 7 grey levels of 255 on the average.
    std::transform(scene.views.data(), scene.views.data() + scene.views.size(), scene.views.data(),
                   [](std::uint8_t grey) { return static_cast<std::uint8_t>(grey / 12); });
    const ViewIndex center = scene.views.grid().center();
    const Image<float> map = copy(scene.disparity.view(center), -1);
    const io::Explanation explanation =
        io::explain_views(samples(scene), center, {map.view(), {}}, 1);

    const io::OcclusionOrder side =
        io::find_occlusion_order(samples(scene), center, {map.view(), {}}, 1, explanation);

    QVERIFY(side.is_decided());
    QVERIFY(!side.larger_is_nearer());
  }

  void nearSide_isUndecidedWithoutDepthEdges() {
    const LayeredScene scene;
    const ViewIndex center = scene.views.grid().center();
    const Image<float> map(scene.views.height(), scene.views.width(), 1, LayeredScene::kFar);

    const io::OcclusionOrder side =
        io::find_occlusion_order(samples(scene), center, {map.view(), {}}, 1, {});

    QVERIFY(!side.is_decided());
  }

  void depthFit_findsTheCamera() {
    const LayeredScene scene;
    const ViewIndex center = scene.views.grid().center();

    const io::DepthFit fit =
        io::fit_depth({scene.disparity.view(center), {}}, 1, {scene.depth.view(center), {}});

    QVERIFY(fit.is_exact());
    // Depth is stored with 24 bits: relative errors of 6e-8 in disparities up to 6.5.
    QVERIFY(std::abs(fit.a - LayeredScene::kA) < 1e-3);
    QVERIFY(std::abs(fit.camera().shift - LayeredScene::kB) < 1e-4);
    QVERIFY(std::abs(fit.camera().disparity_from_depth(12) - 0) < 1e-4);
  }

  void depthFit_leavesOutAFarSky() {
    LayeredScene scene;
    const ViewIndex center = scene.views.grid().center();
    const auto depth = scene.depth.view(center);
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < depth.width; ++x) depth.at(y, x) = 200;
    }

    const io::DepthFit fit =
        io::fit_depth({scene.disparity.view(center), {}}, 1, {scene.depth.view(center), {}});

    QVERIFY(fit.is_exact());
    QVERIFY(fit.exact_share < 1);
    QVERIFY(std::abs(fit.a - LayeredScene::kA) < 1e-3);
  }

  void depthFit_isNotExactForOtherScenes() {
    LayeredScene scene;
    const ViewIndex center = scene.views.grid().center();
    const auto depth = scene.depth.view(center);
    for (int y = 0; y < depth.height; ++y) {
      for (int x = 0; x < depth.width; ++x) {
        depth.at(y, x) = static_cast<float>(10 + std::sin(0.1 * x * y));
      }
    }

    QVERIFY(!io::fit_depth({scene.disparity.view(center), {}}, 1, {scene.depth.view(center), {}})
                 .is_exact());
  }
};

}  // namespace episcope::in_map_meaning_test

EPISCOPE_TEST(map_meaning_test, MapMeaningTest)

#include "map_meaning_test.moc"
