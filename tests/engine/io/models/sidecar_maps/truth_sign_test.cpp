// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/image_file.h"
#include "engine/io/base/npy.h"
#include "engine/io/models/order/view_axes.h"
#include "engine/io/models/sidecar_maps/disparity_units.h"
#include "engine/io/open.h"
#include "tests/engine/io/models/order/layered_scene.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <algorithm>
#include <vector>

namespace episcope::in_truth_sign_test {

using namespace episcope::test;

namespace fs = std::filesystem;

/// Whether larger disparity of the truth is nearer, where the map itself hardly tells.
class TruthSignTest : public QObject {
  Q_OBJECT

 private slots:
  void occlusionOfViews_decides_data() {
    QTest::addColumn<bool>("is_negative");
    QTest::newRow("larger is nearer") << false;
    QTest::newRow("smaller is nearer") << true;
  }
  void occlusionOfViews_decides() {
    QFETCH(bool, is_negative);
    const LightField::Samples samples =
        layered_views({.grid = {5, 5}, .height = 160, .width = 192, .discs = 12});
    // In the order in which they are stored, or reversed, warping explains the views alike.
    const io::Explanation explanation{1, 10, false, is_negative, is_negative};

    const io::TruthSign sign = io::find_truth_sign(samples, {}, explanation);

    QVERIFY2(sign.is_known, sign.evidence.c_str());
    QCOMPARE(sign.is_negated, is_negative);
  }

  void signOfAPlane_isAssumed_data() {
    QTest::addColumn<float>("factor");
    QTest::newRow("as it should be") << 1.0F;
    QTest::newRow("negative") << -1.0F;
  }
  /// The truth fits the views, but nothing hides anything.
  void signOfAPlane_isAssumed() {
    QFETCH(float, factor);
    const QTemporaryDir folder;
    const fs::path path = folder.path().toStdString();
    const Scene scene = plane_scene();
    const ViewStack<std::uint8_t>& views = bytes_of(scene);
    for (int i = 0; i < views.grid().count(); ++i) {
      const ViewIndex view = views.view_at(i);
      const std::string name = std::to_string(view.v) + "_" + std::to_string(view.u) + ".png";
      io::write_png(path / name, views.view(view));
    }
    const auto map = scene.truth->field.disparity.view({2, 2});
    std::vector<float> values(map.data, map.data + map.size());
    std::ranges::transform(values, values.begin(), [=](float value) { return factor * value; });
    io::write_npy<float>(
        path / "disparity.npy",
        {static_cast<std::size_t>(views.height()), static_cast<std::size_t>(views.width())},
        values);

    const Scene read = io::open_scene(path, {}, Progress(2));

    QVERIFY2(read.convention.sign.empty(), describe(read.convention).c_str());
    QVERIFY2(read.convention.sign_check.find("nothing tells") != std::string::npos,
             read.convention.sign_check.c_str());
    QVERIFY(has_same_samples(scene, read));
    QVERIFY(read.truth->field.disparity.view({2, 2}).at(40, 70) * map.at(40, 70) > 0);
  }
};

}  // namespace episcope::in_truth_sign_test

EPISCOPE_TEST(truth_sign_test, TruthSignTest)

#include "truth_sign_test.moc"
