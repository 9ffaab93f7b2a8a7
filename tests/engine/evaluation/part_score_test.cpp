// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/resolved_errors.h"
#include "tests/engine/evaluation/judged_maps.h"
#include "tests/test_main.h"

#include <numeric>

namespace episcope::in_part_score_test {

using namespace episcope::test;

class PartScoreTest : public QObject {
  Q_OBJECT

 private slots:
  void everywhere_isTheWholeEvaluation() {
    for (const Protocol protocol : {Protocol::Vmv2013, Protocol::Benchmark2016}) {
      const Evaluation evaluation = judge(rough_estimate(), wavy_truth(), protocol);
      const PartScore score = score_part(evaluation, nullptr, protocol);
      QVERIFY(score.metrics.size() >= 2);
      for (const auto& [key, value] : score.metrics) {
        const auto whole = find_metric(evaluation.metrics, key);
        QVERIFY2(whole && std::abs(*whole - value) < 1e-4 * (1 + *whole), key.c_str());
      }
    }
  }

  void part_isScoredAsItsPixelsAre() {
    Image<float> estimate = constant(1);
    for (int x = 20; x < 25; ++x) estimate.at(30, x) = 1.5F;
    const Evaluation evaluation = judge(estimate, constant(1), Protocol::Benchmark2016);
    Image<std::uint8_t> part(kSize, kSize);
    for (int x = 20; x < 30; ++x) part.at(30, x) = 1;
    const PartScore score = score_part(evaluation, &part, Protocol::Benchmark2016);
    QCOMPARE(score.pixels, 10U);
    QCOMPARE(find_metric(score.metrics, "mse_100"), 12.5);
    QCOMPARE(find_metric(score.metrics, "badpix_0070"), 50.0);
    QCOMPARE(find_metric(score.metrics, "q_25_100"), 0.0);
  }

  void missing_isBad() {
    Image<float> estimate = constant(1);
    estimate.at(20, 20) = kNan;
    const Evaluation evaluation = judge(estimate, constant(1), Protocol::Benchmark2016);
    Image<std::uint8_t> part(kSize, kSize);
    part.at(20, 20) = part.at(20, 21) = 1;
    const PartScore score = score_part(evaluation, &part, Protocol::Benchmark2016);
    QCOMPARE(find_metric(score.metrics, "badpix_0010"), 50.0);
    QCOMPARE(find_metric(score.metrics, "density"), 50.0);
  }

  void partWithoutJudgedPixels_hasNoMetrics() {
    const Evaluation evaluation = judge(constant(1), constant(1), Protocol::Benchmark2016);
    Image<std::uint8_t> border(kSize, kSize);
    border.at(0, 0) = 1;
    const PartScore score = score_part(evaluation, &border, Protocol::Benchmark2016);
    QCOMPARE(score.pixels, 0U);
    QVERIFY(score.metrics.empty());
    QVERIFY(errors_by_disparity(evaluation, whole(constant(1)), &border, 8, 0.07).empty());
  }

  void bins_holdTheErrorsOfTheirDisparities() {
    const Image<float> truth = map_of([](int, int x) { return x < 25 ? -1.0 : 1.0; });
    const Image<float> estimate = map_of([](int, int x) { return x < 25 ? -1.0 : 1.5; });
    const Evaluation evaluation = judge(estimate, truth, Protocol::Vmv2013);
    const auto bins = errors_by_disparity(evaluation, whole(truth), nullptr, 4, 0.07);
    QCOMPARE(bins.size(), 2U);
    QCOMPARE(bins[0].disparity.min, -1.0);
    QCOMPARE(bins[0].mse_100, 0.0);
    QCOMPARE(bins[0].bad_percent, 0.0);
    QCOMPARE(bins[1].disparity.max, 1.0);
    QCOMPARE(bins[1].mse_100, 25.0);
    QCOMPARE(bins[1].bad_percent, 100.0);
  }

  void bins_addUpToTheWhole() {
    const Image<float> truth = wavy_truth();
    const Evaluation evaluation = judge(rough_estimate(), truth, Protocol::Vmv2013);
    double squares = 0, pixels = 0;
    for (const ErrorBin& bin : errors_by_disparity(evaluation, whole(truth), nullptr, 12, 0.07)) {
      squares += bin.mse_100 * static_cast<double>(bin.pixels);
      pixels += static_cast<double>(bin.pixels);
    }
    QCOMPARE(pixels, double{kSize * kSize});
    QVERIFY(std::abs(squares / pixels - metric(evaluation, "mse_100")) < 1e-3);
  }
};

}  // namespace episcope::in_part_score_test

EPISCOPE_TEST(part_score_test, PartScoreTest)
#include "part_score_test.moc"
