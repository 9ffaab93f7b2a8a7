// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/evaluation/metrics.h"
#include "tests/engine/evaluation/judged_maps.h"
#include "tests/test_main.h"

#include <cmath>
#include <limits>

namespace episcope::in_metrics_test {

using namespace episcope::test;

class MetricsTest : public QObject {
  Q_OBJECT
 private slots:
  void protocolName_isThatOfTheCommandLine() {
    QCOMPARE(protocol_name(Protocol::Vmv2013), "vmv2013");
    QCOMPARE(protocol_name(Protocol::Benchmark2016), "benchmark2016");
  }

  void truthItself_hasNoError() {
    const auto truth = wavy_truth();
    std::map<std::string, Image<std::uint8_t>> regions;
    for (const char* name :
         {"discontinuities", "planes", "smooth_surfaces", "fine", "fine_surrounding"}) {
      regions.merge(everywhere(name));
    }
    CameraGrid camera;
    camera.baseline = 100;
    camera.focal_length = 1.5;
    camera.shift = 15;
    const EvaluationOptions options{Protocol::Benchmark2016, InvalidEstimates::Bad, camera};

    const auto evaluation = evaluate(whole(truth), whole(truth), regions, options);

    QCOMPARE(evaluation.metrics.size(), std::size_t{13});
    for (const auto& [key, value] : evaluation.metrics) {
      // The arc cosine of a rounded 1 is up to 1e-6 degrees.
      QVERIFY2(std::abs(value - (key == "density" ? 100 : 0)) < 1e-5, key.c_str());
    }
  }

  void vmv2013_countsEveryPixelWithTruth() {
    auto truth = constant(1);
    truth.at(0, 0) = kNan;
    Image<std::uint8_t> valid(kSize, kSize, 1, 1);
    valid.at(0, 1) = 0;
    auto estimate = constant(1);
    estimate.at(0, 0) = estimate.at(0, 1) = 100;
    estimate.at(0, 2) = 3;

    const auto evaluation =
        evaluate(whole(estimate), {truth.view(), valid.view()}, {}, {Protocol::Vmv2013, {}, {}});

    QCOMPARE(metric(evaluation, "mse_100"), 100.0 * 4 / (kSize * kSize - 2));
    QCOMPARE(metric(evaluation, "mse_100_inset15"), 0.0);
    QCOMPARE(metric(evaluation, "density"), 100.0);
    QCOMPARE(evaluation.metrics.size(), std::size_t{3});
    QCOMPARE(int{evaluation.judged.at(0, 0)}, 0);
    QCOMPARE(int{evaluation.judged.at(0, 1)}, 0);
    QCOMPARE(evaluation.signed_error.at(0, 2), -2.0F);
  }

  void benchmark2016_ignoresBorder() {
    auto estimate = constant(1);
    for (int i = 0; i < kSize; ++i) {
      estimate.at(14, i) = estimate.at(kSize - 15, i) = 9;
      estimate.at(i, 14) = estimate.at(i, kSize - 15) = 9;
    }
    const auto untouched = judge(estimate, constant(1), Protocol::Benchmark2016);
    estimate.at(15, 15) = 3;
    const auto touched = judge(estimate, constant(1), Protocol::Benchmark2016);

    QCOMPARE(metric(untouched, "mse_100"), 0.0);
    QCOMPARE(metric(touched, "mse_100"), 100.0 * 4 / 400);
    QCOMPARE(metric(touched, "badpix_0070"), 0.25);
  }

  void badPixels_areStrictlyAboveThreshold_data() {
    QTest::addColumn<float>("error");
    QTest::addColumn<double>("badpix_0010");
    QTest::addColumn<double>("badpix_0030");
    QTest::addColumn<double>("badpix_0070");
    const auto above = [](float value) { return std::nextafter(value, 1.0F); };
    QTest::newRow("0.01") << 0.01F << 0.0 << 0.0 << 0.0;
    QTest::newRow("above 0.01") << above(0.01F) << 100.0 << 0.0 << 0.0;
    QTest::newRow("0.03") << 0.03F << 100.0 << 0.0 << 0.0;
    QTest::newRow("above 0.03") << above(0.03F) << 100.0 << 100.0 << 0.0;
    QTest::newRow("0.07") << 0.07F << 100.0 << 100.0 << 0.0;
    QTest::newRow("above 0.07") << above(0.07F) << 100.0 << 100.0 << 100.0;
    QTest::newRow("-0.07") << -0.07F << 100.0 << 100.0 << 0.0;
    QTest::newRow("below -0.07") << -above(0.07F) << 100.0 << 100.0 << 100.0;
  }
  void badPixels_areStrictlyAboveThreshold() {
    QFETCH(float, error);
    QFETCH(double, badpix_0010);
    QFETCH(double, badpix_0030);
    QFETCH(double, badpix_0070);

    // An estimate of 0 keeps truth − estimate exactly `error`.
    const auto evaluation = judge(constant(0), constant(error), Protocol::Benchmark2016);

    QCOMPARE(metric(evaluation, "badpix_0010"), badpix_0010);
    QCOMPARE(metric(evaluation, "badpix_0030"), badpix_0030);
    QCOMPARE(metric(evaluation, "badpix_0070"), badpix_0070);
  }

  void q25_isElementAtQuarterOfCount_data() {
    QTest::addColumn<int>("count");
    QTest::addColumn<int>("index");
    for (const auto& [count, index] : {std::pair{4, 1}, {3, 0}, {5, 1}, {7, 1}, {8, 2}, {1, 0}}) {
      QTest::addRow("%d pixels", count) << count << index;
    }
  }
  void q25_isElementAtQuarterOfCount() {
    QFETCH(int, count);
    QFETCH(int, index);
    auto truth = map_of([](int, int) { return kNan; }, 31, 30 + count);
    auto estimate = map_of([](int, int) { return 0; }, 31, 30 + count);
    for (int i = 0; i < count; ++i) {
      truth.at(15, 15 + i) = static_cast<float>((count - i) * (i % 2 == 0 ? 1 : -1));
    }

    const auto evaluation = judge(estimate, truth, Protocol::Benchmark2016);

    QCOMPARE(metric(evaluation, "q_25_100"), 100.0 * (index + 1));
  }

  void missingValues_followTheirRule() {
    const auto truth = map_of([](int, int x) { return x < 25 ? 1.0 : 3.0; });
    auto estimate = truth;
    for (int x = 25; x < 35; ++x) estimate.at(20, x) = kNan;  // 10 of 400, all near
    estimate.at(20, 15) = kNan;                               // 1 far, at the farthest disparity

    const auto bad = judge(estimate, truth, Protocol::Benchmark2016, InvalidEstimates::Bad);
    const auto compatible =
        judge(estimate, truth, Protocol::Benchmark2016, InvalidEstimates::Compatible);

    QCOMPARE(metric(bad, "badpix_0070"), 11 / 4.0);
    QCOMPARE(metric(bad, "mse_100"), 100.0 * 10 * 4 / 400);
    QCOMPARE(metric(bad, "density"), 100.0 * 389 / 400);
    QCOMPARE(metric(compatible, "badpix_0070"), 0.0);
    QCOMPARE(metric(compatible, "mse_100"), 0.0);
    QCOMPARE(metric(compatible, "density"), 100.0 * 389 / 400);
    QCOMPARE(int{bad.missing.at(20, 30)}, 1);
    QCOMPARE(int{bad.judged.at(20, 30)}, 1);
    QCOMPARE(bad.signed_error.at(20, 30), 2.0F);
    QCOMPARE(compatible.signed_error.at(20, 30), 0.0F);
    QCOMPARE(int{present_mask(bad).at(20, 30)}, 0);
    QCOMPARE(int{present_mask(bad).at(21, 30)}, 1);
  }

  void missingValues_areToldWithBothNumbers_data() {
    QTest::addColumn<int>("protocol");
    for (const Protocol protocol : {Protocol::Vmv2013, Protocol::Benchmark2016}) {
      QTest::newRow(protocol_name(protocol)) << static_cast<int>(protocol);
    }
  }
  void missingValues_areToldWithBothNumbers() {
    QFETCH(int, protocol);
    const auto by = static_cast<Protocol>(protocol);
    const auto truth = map_of([](int, int x) { return x < 25 ? 1.0 : 3.0; });
    auto estimate = map_of([&](int y, int x) { return truth.at(y, x) + 0.1; });
    const auto whole_map = judge(estimate, truth, by);
    for (int x = 25; x < 35; ++x) estimate.at(20, x) = kNan;

    const auto bad = judge(estimate, truth, by);
    const auto compatible = judge(estimate, truth, by, InvalidEstimates::Compatible);

    QVERIFY(whole_map.notes.empty());
    QVERIFY(!find_metric(whole_map.metrics, "mse_100_present"));
    QVERIFY(std::abs(metric(bad, "mse_100_present") - 1) < 1e-4);
    QVERIFY(metric(bad, "mse_100") > 1.1);
    QCOMPARE(find_metric(bad.metrics, "badpix_0070_present").value_or(100), 100.0);
    QCOMPARE(bad.notes.size(), std::size_t{1});
    for (const char* words : {"have no value", "farthest true disparity, 1 px", "and 1 without"}) {
      QVERIFY2(QString::fromStdString(bad.notes[0]).contains(words), bad.notes[0].c_str());
    }
    QVERIFY(QString::fromStdString(compatible.notes.at(0)).contains("means leave them out"));
    QVERIFY(!find_metric(compatible.metrics, "mse_100_present"));
  }

  /// One of a thousand is no more than a few.
  void fewMissingValues_areNotTold() {
    const auto truth = constant(1);
    auto estimate = constant(1.1);
    estimate.at(20, 20) = kNan;

    const auto evaluation = judge(estimate, truth, Protocol::Vmv2013);

    QVERIFY(evaluation.notes.empty());
    QVERIFY(find_metric(evaluation.metrics, "mse_100_present").has_value());
  }

  // However small the error of the farthest disparity is.
  void q25_countsMissingValuesBehindAllOthers() {
    const auto truth = map_of([](int, int x) { return x < 25 ? 1.0 : 3.0; });
    const auto estimate = map_of([](int, int x) { return x < 25 ? kNan : 3.5; });

    const auto bad = judge(estimate, truth, Protocol::Benchmark2016);

    QCOMPARE(metric(bad, "q_25_100"), 50.0);
  }

  void estimateWithoutAnyValue_isWorst() {
    const auto evaluation = judge(constant(kNan), wavy_truth(), Protocol::Benchmark2016);

    QCOMPARE(metric(evaluation, "density"), 0.0);
    QCOMPARE(metric(evaluation, "badpix_0010"), 100.0);
    QVERIFY(metric(evaluation, "q_25_100") > 0);
    const auto compatible =
        judge(constant(kNan), wavy_truth(), Protocol::Benchmark2016, InvalidEstimates::Compatible);
    QVERIFY(!find_metric(compatible.metrics, "mse_100"));
  }

  void missingValue_neverImprovesAMetric() {
    std::map<std::string, Image<std::uint8_t>> regions;
    for (const char* name :
         {"discontinuities", "planes", "smooth_surfaces", "fine", "fine_surrounding"}) {
      regions.merge(everywhere(name));
    }
    auto truth = wavy_truth();
    auto estimate = map_of([&](int y, int x) { return truth.at(y, x) + 0.004 * ((x + y) % 3); });
    const auto before = judge(estimate, truth, Protocol::Benchmark2016, {}, regions);
    for (int i = 15; i < 35; ++i) estimate.at(i, 15 + (i * 7) % 20) = kNan;
    const auto after = judge(estimate, truth, Protocol::Benchmark2016, {}, regions);

    for (const auto& [key, value] : before.metrics) {
      const double now = metric(after, key.c_str());
      QVERIFY2(key == "density" ? now < value : now >= value, key.c_str());
    }
  }

  void errorMap_holdsTheNumbers_data() {
    QTest::addColumn<int>("protocol");
    QTest::addColumn<int>("invalid");
    for (const Protocol protocol : {Protocol::Vmv2013, Protocol::Benchmark2016}) {
      for (const auto invalid : {InvalidEstimates::Bad, InvalidEstimates::Compatible}) {
        QTest::addRow("%s, missing %s", protocol_name(protocol),
                      invalid == InvalidEstimates::Bad ? "bad" : "compatible")
            << static_cast<int>(protocol) << static_cast<int>(invalid);
      }
    }
  }
  void errorMap_holdsTheNumbers() {
    QFETCH(int, protocol);
    QFETCH(int, invalid);
    const auto rule = static_cast<InvalidEstimates>(invalid);
    const auto evaluation =
        judge(rough_estimate(), wavy_truth(), static_cast<Protocol>(protocol), rule);

    double sum = 0;
    int count = 0;
    int bad = 0;
    int judged = 0;
    const auto bad_pixels = bad_pixel_map(evaluation, 0.07);
    const auto absolute = absolute_error_map(evaluation);
    for (std::size_t i = 0; i < evaluation.judged.size(); ++i) {
      const float error = evaluation.signed_error.data()[i];
      QCOMPARE(absolute.data()[i], std::abs(error));
      if (evaluation.judged.data()[i] == 0) {
        QCOMPARE(error, 0.0F);
        continue;
      }
      ++judged;
      if (bad_pixels.data()[i] == 1.0F) ++bad;
      if (evaluation.missing.data()[i] != 0 && rule == InvalidEstimates::Compatible) continue;
      sum += error * error;
      ++count;
    }

    // The map is float, the sum of squares double: 1e-6 relative.
    const double mse = 100 * sum / count;
    QVERIFY(std::abs(metric(evaluation, "mse_100") - mse) < 1e-6 * mse);
    if (static_cast<Protocol>(protocol) == Protocol::Benchmark2016 &&
        rule == InvalidEstimates::Bad) {
      QCOMPARE(metric(evaluation, "badpix_0070"), 100.0 * bad / judged);
    }
  }

  void layers_areJudgedByTheirOwnMask() {
    const auto field = [](float value, bool half_valid) {
      DisparityField made{ViewStack<float>({1, 1}, 4, 4), ViewStack<std::uint8_t>({1, 1}, 4, 4)};
      std::fill_n(made.disparity.data(), 16, value);
      std::fill_n(made.valid.data(), 16, std::uint8_t{1});
      if (half_valid) std::fill_n(made.valid.data(), 8, std::uint8_t{0});
      return made;
    };
    GroundTruth truth;
    truth.foreground = field(1, true);
    truth.background = field(-1, false);
    LayeredDisparity estimate{field(1.5, false), field(-1, false),
                              ViewStack<std::uint8_t>({1, 1}, 4, 4)};
    // Two layers in the lower half, found in its last row alone and in one pixel too many.
    std::fill_n(estimate.layers.data(), 16, std::uint8_t{1});
    std::fill_n(estimate.layers.data() + 12, 4, std::uint8_t{2});
    estimate.layers.data()[0] = 2;

    const auto evaluation = evaluate_layers(estimate, truth, {0, 0}, {});

    QCOMPARE(metric(evaluation.foreground, "mse_100"), 25.0);
    QCOMPARE(int{evaluation.foreground.judged.at(0, 0)}, 0);
    QCOMPARE(int{evaluation.foreground.judged.at(3, 0)}, 1);
    QCOMPARE(metric(evaluation.background, "mse_100"), 0.0);
    QCOMPARE(evaluation.layers_right.value(), 100.0 * 11 / 16);
    const Metrics metrics = layered_metrics(evaluation);
    QCOMPARE(find_metric(metrics, "mse_100_foreground").value(), 25.0);
    QCOMPARE(find_metric(metrics, "mse_100_background").value(), 0.0);
    QVERIFY(find_metric(metrics, "layers_right") && !find_metric(metrics, "mse_100"));
    // Where one surface is visible, the foreground is evaluated like any other map.
    truth.field = field(1.2F, true);
    QCOMPARE(metric(evaluate_layers(estimate, truth, {0, 0}, {}).single.value(), "density"), 100.0);
    QVERIFY(std::abs(find_metric(layered_metrics(evaluate_layers(estimate, truth, {0, 0}, {})),
                                 "mse_100")
                         .value() -
                     9) < 1e-3);
    std::fill_n(truth.field.valid.data(), 16, std::uint8_t{0});
    QVERIFY(!evaluate_layers(estimate, truth, {0, 0}, {}).single);
    estimate.layers = {};
    QVERIFY(!find_metric(layered_metrics(evaluate_layers(estimate, truth, {0, 0}, {})),
                         "layers_right"));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)evaluate_layers({}, truth, {0, 0}, {}));
  }

  void pixelsThatAreNotShown_areNotJudged_data() {
    QTest::addColumn<Protocol>("protocol");
    QTest::newRow("2013") << Protocol::Vmv2013;
    QTest::newRow("2016") << Protocol::Benchmark2016;
  }
  void pixelsThatAreNotShown_areNotJudged() {
    QFETCH(Protocol, protocol);
    const auto truth = wavy_truth();
    auto estimate = wavy_truth();
    Image<std::uint8_t> shown(kSize, kSize, 1, 1);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize / 2; ++x) {
        shown.at(y, x) = 0;
        estimate.at(y, x) = y % 2 == 0 ? kNan : 9.0F;
      }
    }
    std::map<std::string, Image<std::uint8_t>> regions = everywhere("planes");
    regions.merge(everywhere("discontinuities"));
    EvaluationOptions options{protocol, InvalidEstimates::Bad, {}};
    options.shown = shown.view();

    const auto evaluation = evaluate(whole(estimate), whole(truth), regions, options);

    QCOMPARE(metric(evaluation, "mse_100"), 0.0);
    QCOMPARE(metric(evaluation, "density"), 100.0);
    QCOMPARE(metric(evaluation, "shown"), 50.0);
    QCOMPARE(int{evaluation.judged.at(25, 20)}, 0);
    if (options.protocol == Protocol::Benchmark2016) {
      QCOMPARE(metric(evaluation, "discontinuities_0070_lowres"), 0.0);
    }
    shown = Image<std::uint8_t>(kSize, kSize);
    options.shown = shown.view();
    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             (void)evaluate(whole(estimate), whole(truth), {}, options));
  }

  void layers_useRegionsInTheCentreViewAlone() {
    const auto field = [] {
      DisparityField made{ViewStack<float>({1, 3}, kSize, kSize),
                          ViewStack<std::uint8_t>({1, 3}, kSize, kSize)};
      std::fill_n(made.disparity.data(), made.disparity.size(), 0.5F);
      std::fill_n(made.valid.data(), made.valid.size(), std::uint8_t{1});
      return made;
    };
    GroundTruth truth;
    truth.foreground = field();
    truth.background = field();
    truth.regions = everywhere("planes");
    const LayeredDisparity estimate{field(), field(), {}};
    const EvaluationOptions options{Protocol::Benchmark2016, {}, {}};
    const auto has_region = [&](ViewIndex view) {
      return find_metric(layered_metrics(evaluate_layers(estimate, truth, view, options)),
                         "bumpiness_planes_100_0050_background")
          .has_value();
    };

    QVERIFY(has_region({0, 1}));
    QVERIFY(!has_region({0, 0}) && !has_region({0, 2}));
  }

  void wrongInput_isRefused() {
    const auto small = map_of([](int, int) { return 0; }, 20, 20);
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)judge(small, constant(0), Protocol::Vmv2013));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)judge(small, small, Protocol::Benchmark2016));
    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             (void)judge(constant(0), constant(kNan), Protocol::Vmv2013));
    std::map<std::string, Image<std::uint8_t>> regions;
    regions["fine"] = Image<std::uint8_t>(5, 5);
    QVERIFY_THROWS_EXCEPTION(
        InvalidInput, (void)judge(constant(0), constant(0), Protocol::Benchmark2016, {}, regions));
  }

  void runtimeClass_changesAt5And60Seconds() {
    QCOMPARE(std::string(runtime_class(4.99)), std::string("fast"));
    QCOMPARE(std::string(runtime_class(5)), std::string("medium"));
    QCOMPARE(std::string(runtime_class(60)), std::string("medium"));
    QCOMPARE(std::string(runtime_class(60.1)), std::string("slow"));
  }
};

}  // namespace episcope::in_metrics_test

EPISCOPE_TEST(metrics_test, MetricsTest)
#include "metrics_test.moc"
