// SPDX-License-Identifier: BSD-3-Clause
#include "tests/accuracy/corrections.h"

#include "engine/scenes/builtin.h"
#include "tests/test_main.h"

namespace episcope::in_corrections_test {

namespace {

accuracy::PaintedScene objects() {
  scenes::RenderOptions options;
  options.grid = {3, 3};
  options.height = options.width = 96;
  return accuracy::paint_scene("objects", accuracy::StrokeStyle::Cross,
                               scenes::render_builtin("objects", options, Progress()));
}

}  // namespace

class CorrectionsTest : public QObject {
  Q_OBJECT

 private slots:
  void better_takesMoreStrokes() {
    const accuracy::PaintedScene painted = objects();
    LabelerParameters parameters;
    parameters.features = FeatureSet::ImageTruth;
    parameters.regularizer = Regularizer::View;
    const LabelingDisparity truth = accuracy::disparity_for(painted, FeatureSet::ImageTruth, {});

    const accuracy::CorrectionCounts counts =
        accuracy::count_corrections(painted, parameters, truth);

    QVERIFY(counts[0] && counts[1]);
    // Two labels must be painted before there is a result.
    QVERIFY(*counts[0] >= 2);
    QVERIFY(*counts[0] <= *counts[1]);
    QVERIFY(*counts[1] <= 20);
  }

  void wand_reachesWhatIsWanted() {
    const accuracy::PaintedScene painted = objects();
    LabelerParameters parameters;
    parameters.features = FeatureSet::ImageTruth;
    parameters.regularizer = Regularizer::View;
    const LabelingDisparity truth = accuracy::disparity_for(painted, FeatureSet::ImageTruth, {});
    const RaySuperpixels wand(*painted.scene.light_field, *truth.field, Progress());

    const auto counts = accuracy::count_corrections(painted, parameters, truth, &wand);

    QVERIFY(counts[0] && counts[1]);
    QVERIFY(*counts[1] >= 2 && *counts[1] <= 20);
  }

  void median_countsWhatWasNotReachedAsTheMost() {
    QCOMPARE(accuracy::median_count({5, std::nullopt, 3}), std::optional(5));
    QCOMPARE(accuracy::median_count({std::nullopt, 4, std::nullopt}), std::optional<int>());
    QCOMPARE(accuracy::median_count({}), std::optional<int>());
  }

  void least_isOneForEachLargeLabel() {
    Image<std::int32_t> truth(10, 12);  // 100 pixels that are judged.
    std::fill_n(truth.data(), 60, 7);
    std::fill_n(truth.data() + 60, 34, 2);
    std::fill_n(truth.data() + 94, 3, 5);
    std::fill_n(truth.data() + 97, 3, 4);

    const accuracy::CorrectionCounts counts = accuracy::least_corrections(truth.view());

    QCOMPARE(counts, (accuracy::CorrectionCounts{2, 3, 4}));
  }

  void names_makeFiles() {
    QCOMPARE(accuracy::file_stem("demo:random?seed=1&kind=room"),
             std::string("demo_random_seed_1_kind_room"));
  }
};

}  // namespace episcope::in_corrections_test

EPISCOPE_TEST(corrections_test, CorrectionsTest)
#include "corrections_test.moc"
