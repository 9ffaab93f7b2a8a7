// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/scene_summary.h"

#include "app/session/load_scene.h"
#include "app/session/run_estimator.h"
#include "engine/disparity/registry.h"
#include "tests/app/session/tiny_scene.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <variant>

namespace episcope::in_scene_range_test {

class SceneRangeTest : public QObject {
  Q_OBJECT

 private slots:
  void opaqueScene_spansItsTruth() {
    const auto scene = tiny_scene("edge");
    const Interval range = known_disparity_range(*scene);

    QCOMPARE(range, extent(scene->truth->field.view(scene->light_field->center())));
    QVERIFY(std::abs(range.min + 0.5) < 1e-5 && std::abs(range.max - 0.8) < 1e-5);
  }

  // Where one surface is seen there is a single disparity: it alone would span nothing.
  void transparentScene_spansBothLayers() {
    const auto scene = tiny_scene("transparent");
    const ViewIndex center = scene->light_field->center();
    const Interval range = known_disparity_range(*scene);

    for (const DisparityField* field :
         {&scene->truth->field, &scene->truth->foreground, &scene->truth->background}) {
      const Interval part = extent(field->view(center));
      QVERIFY(part.min >= range.min && part.max <= range.max);
    }
    QVERIFY(range.length() > 0.5);
  }

  void withoutTruth_whatFilesPromiseCounts() {
    Scene scene = *tiny_scene("edge");
    scene.truth = std::make_shared<const GroundTruth>();
    QCOMPARE(known_disparity_range(scene), Interval{});
    LightFieldInfo info = scene.light_field->info();
    info.disparity_range = Interval{-3, 2};
    scene.light_field = std::make_shared<const LightField>(
        std::get<ViewStack<std::uint8_t>>(scene.light_field->samples()).clone(), info);
    QCOMPARE(known_disparity_range(scene), (Interval{-3, 2}));
  }

  void searchOfLessThanIsStated_isTold() {
    Scene scene = *tiny_scene("edge");
    LightFieldInfo info = scene.light_field->info();
    info.disparity_range = Interval{-0.5, 0.8};
    scene.light_field = with_info(*scene.light_field, info);
    for (const Interval range : {Interval{0, 0.1}, Interval{5, 6}, Interval{-1, 1}}) {
      const EstimatePtr estimate = run_estimator(scene, find_estimator("epi_l"),
                                                 {{"range", IntervalOrAuto(range)}}, {}, Progress())
                                       .estimate;
      const bool is_told = std::ranges::any_of(estimate->notes, [](const std::string& note) {
        return note.ends_with("range that the light field states, -0.50 … 0.80 px");
      });
      QCOMPARE(is_told, range.min != -1);
    }
  }

  void whatIsNotToldApart_isWarnedOf() {
    ConventionReport report;
    report.sign = "checked";
    QVERIFY(order_warnings(report).empty());
    report.sign = "";
    report.are_axes_unclear = true;

    const std::vector<std::string> warnings = order_warnings(report);

    QCOMPARE(warnings.size(), std::size_t{2});
    QVERIFY(warnings[0].starts_with("Rows and columns"));
    QVERIFY(warnings[1].starts_with("Near and far"));
  }
};

}  // namespace episcope::in_scene_range_test

EPISCOPE_TEST(scene_range_test, SceneRangeTest)
#include "scene_range_test.moc"
