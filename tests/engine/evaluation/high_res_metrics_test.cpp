// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/region_metrics.h"
#include "engine/evaluation/resolved_errors.h"
#include "tests/engine/evaluation/high_res_maps.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>

namespace episcope::in_high_res_metrics_test {

using namespace episcope::test;

class HighResMetricsTest : public QObject {
  Q_OBJECT
 private slots:
  // Corners lie on corners: the first and the last pixel of a map get six, all others ten or
  // eleven.
  void enlargedMap_isThatOfTheOfficialZoom() {
    const auto ramp = map_of([](int, int x) { return x; }, 32, 32);
    const Image<float> truth(320, 320);
    std::vector<int> widths(32);

    ResolvedErrors(whole(ramp), truth.view(), 10, {}).visit(nullptr, 0, [&](int y, int, float d) {
      if (y == 0) ++widths[static_cast<std::size_t>(d)];
    });

    QCOMPARE(widths.front(), 6);
    QCOMPARE(widths.back(), 6);
    QVERIFY(std::all_of(widths.begin() + 1, widths.end() - 1,
                        [](int width) { return width == 10 || width == 11; }));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, ResolvedErrors(whole(ramp), truth.view(), 9, {}));
  }

  void stratifiedScene_isScoredInHighResolution_data() {
    QTest::addColumn<StratifiedScene>("scene");
    QTest::addColumn<bool>("is_high");
    QTest::newRow("backgammon") << StratifiedScene::Backgammon << true;
    QTest::newRow("dots") << StratifiedScene::Dots << true;
    QTest::newRow("stripes") << StratifiedScene::Stripes << true;
    QTest::newRow("pyramids") << StratifiedScene::Pyramids << false;
    QTest::newRow("photorealistic") << StratifiedScene::None << false;
  }
  void stratifiedScene_isScoredInHighResolution() {
    QFETCH(StratifiedScene, scene);
    QFETCH(bool, is_high);
    // 200×200 px of the truth are judged; of a row of them 0.5, of the next nothing that counts.
    auto truth = high([](int y, int) { return y == 150 ? 0.5 : y == 149 ? 9 : 0; });
    const MemoryTruth high_res(std::move(truth), {{"discontinuities", everywhere_high()}});

    const auto evaluation = judge_high(constant(0), high_res, scene);

    QVERIFY(evaluation.notes.empty());
    QCOMPARE(metric(evaluation, "mse_100"), is_high ? 100 * 0.25 / 200 : 0.0);
    QCOMPARE(metric(evaluation, "badpix_0070"), is_high ? 0.5 : 0.0);
    QCOMPARE(metric(evaluation, "q_25_100"), 0.0);
    QCOMPARE(has(evaluation, "mse_100_lowres"), is_high);
    QCOMPARE(has(evaluation, "q_25_100_lowres"), is_high);
    if (is_high) QCOMPARE(metric(evaluation, "mse_100_lowres"), 0.0);
    QCOMPARE(metric(evaluation, "discontinuities_0070"), 0.5);
    QCOMPARE(metric(evaluation, "density"), 100.0);
  }

  void missingEstimates_areBadOrAsInTheOfficialTool() {
    auto estimate = constant(0);
    for (int x = 0; x < kSize; ++x) estimate.at(25, x) = kNan;  // ten of 200 rows
    const MemoryTruth truth(high([](int y, int) { return y == 400 ? -1 : 0; }),
                            {{"low_texture", everywhere_high()}});

    const auto bad = judge_high(estimate, truth, StratifiedScene::Stripes);
    const auto compatible =
        judge_high(estimate, truth, StratifiedScene::Stripes, InvalidEstimates::Compatible);

    QCOMPARE(metric(bad, "badpix_0010"), 5.0);
    QCOMPARE(metric(bad, "low_texture_0070"), 5.0);
    QCOMPARE(metric(bad, "mse_100"), 5.0);  // as far as the farthest truth: 1 px
    QCOMPARE(metric(compatible, "badpix_0010"), 0.0);
    QCOMPARE(metric(compatible, "low_texture_0070"), 0.0);
    QCOMPARE(metric(compatible, "mse_100"), 0.0);
  }

  void backgammon_asksWhichSurfaceIsNearer() {
    // Foreground 1 in the column 140, background −1 in the eleventh from the right.
    const auto surfaces = high([](int, int x) { return x == 140 ? 1 : x == kHigh - 11 ? -1 : 0; });
    auto estimate = constant(0);
    for (int x = 0; x < kSize; ++x) {
      estimate.at(20, x) = 0.5F;  // halfway is not nearer
      estimate.at(21, x) = estimate.at(22, x) = 0.51F;
      estimate.at(23, x) = -0.5F;
      estimate.at(24, x) = -0.51F;
    }
    const MemoryTruth truth(surfaces, {{"foreground_fattening", everywhere_high()},
                                       {"foreground_thinning", everywhere_high()}});

    const auto evaluation = judge_high(estimate, truth, StratifiedScene::Backgammon);
    const auto by_masks = judge_high(estimate, truth, StratifiedScene::None);

    // The rows 21 and 22 are 21 of the 200, the row 24 is 10.
    QCOMPARE(metric(evaluation, "backgammon_fattening_0070"), 10.5);
    QCOMPARE(metric(evaluation, "backgammon_thinning_0070"), 5.0);
    QVERIFY(by_masks.metrics == evaluation.metrics);
  }

  // Four boxes with two dots each, one of 100 px and one of 4 px, one of them outside the border.
  void dots_areMissedFromHalfOfTheirPixelsOn() {
    Masks masks;
    masks["boxes"] = mask_of([](int y, int x) { return 10 * (1 + (y >= 250) + 2 * (x >= 250)); });
    masks["dots_by_size"] = mask_of([](int y, int x) {
      const int in_y = y % 250, in_x = x % 250;
      if (in_y < 10 && in_x < 10) return 1;
      if (in_y == 100 && in_x >= 100 && in_x < 104) return 2;
      return in_y == 200 ? 9 : 0;  // too small to count
    });
    masks["background"] = mask_of([](int y, int) { return y >= 150 && y < 160 ? 1 : 0; });
    auto truth = high([](int y, int) { return y == 150 ? 1 : 0; });
    for (int i = 0; i < 49; ++i) truth.at(i / 10, i % 10) = 0.5F;        // seen: 49 of 100 off
    for (int i = 0; i < 50; ++i) truth.at(250 + i / 10, i % 10) = 0.5F;  // missed: half
    for (int i = 0; i < 4; ++i) truth.at(350, 350 + i) = 0.4F;           // seen: not beyond 0.4
    for (int i = 0; i < 2; ++i) truth.at(100, 350 + i) = -0.41F;         // missed: half
    const MemoryTruth high_res(std::move(truth), std::move(masks));

    const auto evaluation = judge_high(constant(0), high_res, StratifiedScene::Dots);

    QCOMPARE(metric(evaluation, "missed_dots_50_0400"), 100.0 * 2 / 8);
    QCOMPARE(metric(evaluation, "background_mse_100"), 10.0);
  }

  void pyramids_areScoredInTheResolutionOfTheViews() {
    // Error 0.5·a·x² in the left half: norm 4a, else none.
    const double gentle = 0.0025;
    const auto estimate = map_of([&](int, int x) { return x < 25 ? 0.5 * gentle * x * x : 0.78; });
    Masks low;
    const auto left = [](int from, int to) {
      return mask_of([=](int y, int x) { return x < 22 && y >= from && y < to ? 1 : 0; }, kSize);
    };
    low["sphere_in"] = left(0, 20);
    low["sphere_out"] = left(20, 30);
    low["pyramids"] = left(30, kSize);
    low["plane"] = mask_of([](int, int x) { return x >= 28 ? 1 : 0; }, kSize);

    const auto evaluation =
        judge(estimate, constant(0), Protocol::Benchmark2016, InvalidEstimates::Bad, low);

    // Float samples below 1 carry errors of 6e-8, times 4·4.
    QVERIFY(std::abs(metric(evaluation, "bumpiness_slanted_100_0050") - 400 * gentle) < 1e-3);
    QCOMPARE(metric(evaluation, "bumpiness_parallel_100_0050"), 0.0);
    low.erase("sphere_in");
    QVERIFY(!has(judge(estimate, constant(0), Protocol::Benchmark2016, {}, low),
                 "bumpiness_slanted_100_0050"));
  }

  void lowResolutionAlone_hasNoOfficialKeys() {
    Masks low;
    for (const char* name : {"foreground_fattening", "foreground_thinning", "fine"}) {
      low.merge(everywhere(name));
    }
    auto truth = constant(0);
    for (int y = 0; y < kSize; ++y) {
      truth.at(y, 14) = 2;  // the foreground; the background is 0
    }

    const auto evaluation = judge(constant(1.5F), truth, Protocol::Benchmark2016, {}, low);

    QCOMPARE(metric(evaluation, "mse_100_lowres"), 225.0);
    QCOMPARE(metric(evaluation, "badpix_0030_lowres"), 100.0);
    QCOMPARE(metric(evaluation, "backgammon_fattening_0070_lowres"), 100.0);
    QCOMPARE(metric(evaluation, "backgammon_thinning_0070_lowres"), 0.0);
    QCOMPARE(metric(evaluation, "fine_thinning_0150_lowres"), 0.0);
    for (const auto& [key, value] : evaluation.metrics) {
      QVERIFY2(key == "density" || key.ends_with("_lowres"), key.c_str());
    }
  }

  void damagedFiles_leaveTheLowResolution() {
    const Masks low = everywhere("discontinuities");
    const MemoryTruth no_truth({}, {{"discontinuities", everywhere_high()}});
    const MemoryTruth no_mask(high([](int, int) { return 0; }),
                              {{"discontinuities", {}}, {"fine", everywhere_high()}});
    const MemoryTruth small_truth(constant(0), {{"discontinuities", everywhere_high()}});

    for (const MemoryTruth* truth : {&no_truth, &no_mask, &small_truth}) {
      const auto evaluation =
          judge_high(constant(0), *truth, StratifiedScene::None, InvalidEstimates::Bad, low);

      QCOMPARE(evaluation.notes.size(), std::size_t{1});
      QVERIFY(!has(evaluation, "discontinuities_0070"));
      QCOMPARE(metric(evaluation, "discontinuities_0070_lowres"), 0.0);
      QCOMPARE(has(evaluation, "fine_thinning_0150"), truth == &no_mask);
    }
  }

  void truthOfOtherProtocols_isNotRead() {
    const MemoryTruth damaged({}, {{"discontinuities", everywhere_high()}});
    EvaluationOptions options;
    options.high_res = &damaged;

    QVERIFY(evaluate(whole(constant(0)), whole(constant(0)), {}, options).notes.empty());
  }

  void cancelled_evaluationEnds() {
    const MemoryTruth truth(high([](int, int) { return 0; }), {{"fine", everywhere_high()}});
    EvaluationOptions options{Protocol::Benchmark2016, {}, {}};
    options.high_res = &truth;
    std::stop_source stop;
    stop.request_stop();
    options.progress = Progress(stop.get_token(), {});

    QVERIFY_THROWS_EXCEPTION(Cancelled,
                             (void)evaluate(whole(constant(0)), whole(constant(0)), {}, options));
  }
};

}  // namespace episcope::in_high_res_metrics_test

EPISCOPE_TEST(high_res_metrics_test, HighResMetricsTest)
#include "high_res_metrics_test.moc"
