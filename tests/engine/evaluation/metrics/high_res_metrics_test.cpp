// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/evaluation/metrics/benchmark_metrics.h"
#include "engine/evaluation/metrics/resolved_errors.h"
#include "tests/engine/evaluation/judged_maps.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace episcope::in_high_res_metrics_test {

using namespace episcope::test;

using Mask = Image<std::uint8_t>;
using Masks = std::map<std::string, Mask>;

constexpr int kHigh = 10 * kSize;

/// High resolution in memory; a mask that is empty cannot be read.
class MemoryTruth : public HighResTruth {
 public:
  MemoryTruth(Image<float> disparity, Masks masks)
      : disparity_(std::move(disparity)), masks_(std::move(masks)) {}

  [[nodiscard]] Image<float> read_disparity() const override {
    if (disparity_.empty()) throw IoError("gt.pfm", "is damaged");
    return disparity_;
  }
  [[nodiscard]] std::vector<std::string> regions() const override {
    std::vector<std::string> names;
    for (const auto& [name, mask] : masks_) names.push_back(name);
    return names;
  }
  [[nodiscard]] Mask read_region(const std::string& name) const override {
    if (masks_.at(name).empty()) throw IoError(name, "is damaged");
    return masks_.at(name);
  }
  [[nodiscard]] std::string identity() const override { return "memory"; }

 private:
  Image<float> disparity_;
  Masks masks_;
};

Image<float> high(const PixelFunction& value) {
  return map_of(value, kHigh, kHigh);
}

Mask mask_of(const std::function<int(int y, int x)>& value, int size = kHigh) {
  Mask mask(size, size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) mask.at(y, x) = static_cast<std::uint8_t>(value(y, x));
  }
  return mask;
}

Mask everywhere_high() {
  return Mask(kHigh, kHigh, 1, 255);
}

Evaluation judge_high(const Image<float>& estimate, const HighResTruth& truth,
                      StratifiedScene scene, InvalidEstimates invalid = InvalidEstimates::Bad,
                      const Masks& low = {}) {
  EvaluationOptions options{Protocol::Benchmark2016, invalid, {}};
  options.high_res = &truth;
  options.stratified = scene;
  return evaluate(whole(estimate), whole(constant(0)), low, options);
}

bool has(const Evaluation& evaluation, const char* key) {
  return find_metric(evaluation.metrics, key).has_value();
}

/// All by plain loops over the enlarged map, as the official tool goes about it.
class Reference {
 public:
  Reference(const Image<float>& estimate, Image<float> truth, Masks masks)
      : truth_(std::move(truth)), masks_(std::move(masks)), map_(kHigh, kHigh) {
    for (int y = 0; y < kHigh; ++y) {
      for (int x = 0; x < kHigh; ++x) map_.at(y, x) = estimate.at(nearest(y), nearest(x));
    }
  }

  [[nodiscard]] static int nearest(int k) {
    return static_cast<int>(std::floor(k * (kSize - 1.0) / (kHigh - 1.0) + 0.5));
  }

  template <class IsBad>
  [[nodiscard]] double percentage(const char* region, IsBad is_bad) const {
    double all = 0, bad = 0;
    for (int y = 150; y < kHigh - 150; ++y) {
      for (int x = 150; x < kHigh - 150; ++x) {
        if (region && masks_.at(region).at(y, x) == 0) continue;
        all += 1;
        bad += is_bad(y, x, map_.at(y, x), truth_.at(y, x)) ? 1 : 0;
      }
    }
    return 100 * bad / all;
  }

  [[nodiscard]] double bad_pixels(const char* region, float limit) const {
    return percentage(region, [&](int, int, float d, float t) { return std::abs(d - t) > limit; });
  }

  [[nodiscard]] std::vector<double> errors(const char* region) const {
    std::vector<double> all;
    for (int y = 150; y < kHigh - 150; ++y) {
      for (int x = 150; x < kHigh - 150; ++x) {
        if (region && masks_.at(region).at(y, x) == 0) continue;
        const float error = std::abs(map_.at(y, x) - truth_.at(y, x));
        if (std::isfinite(error)) all.push_back(error);
      }
    }
    return all;
  }

  [[nodiscard]] double mse(const char* region) const {
    double sum = 0;
    for (const double error : errors(region)) sum += error * error;
    return 100 * sum / static_cast<double>(errors(region).size());
  }

  [[nodiscard]] double q25() const {
    std::vector<double> all = errors(nullptr);
    std::sort(all.begin(), all.end());
    return 100 * all[all.size() / 4];
  }

  [[nodiscard]] double missed_dots() const {
    const Mask &boxes = masks_.at("boxes"), &dots = masks_.at("dots_by_size");
    double all = 0, missed = 0;
    for (int box = 1; box <= 255; ++box) {
      if (std::count(boxes.begin(), boxes.end(), box) == 0) continue;
      for (int size = 1; size <= 8; ++size) {
        double count = 0, off = 0;
        for (int y = 0; y < kHigh; ++y) {
          for (int x = 0; x < kHigh; ++x) {
            if (boxes.at(y, x) != box || dots.at(y, x) != size) continue;
            count += 1;
            off += std::abs(map_.at(y, x) - truth_.at(y, x)) > 0.4F ? 1 : 0;
          }
        }
        all += 1;
        missed += 100 * off / count < 50 ? 0 : 1;
      }
    }
    return 100 * missed / all;
  }

  [[nodiscard]] float truth(int y, int x) const { return truth_.at(y, x); }

 private:
  Image<float> truth_;
  Masks masks_;
  Image<float> map_;
};

/// Steps and ramps that lie on no boundary of the pixels of the map.
Image<float> fine_truth() {
  return high([](int y, int x) { return ((x / 37 + y / 53) % 3) * 0.5 + 0.0007 * x - 0.0004 * y; });
}

/// Follows that truth with errors of all sizes and some holes.
Image<float> loose_estimate() {
  std::minstd_rand random(5);
  std::normal_distribution<double> noise(0, 0.25);
  return map_of([&](int y, int x) {
    if ((7 * x + 5 * y) % 31 == 0) return double{kNan};
    return ((10 * x / 37 + 10 * y / 53) % 3) * 0.5 + 0.007 * x - 0.004 * y + noise(random);
  });
}

/// Numbers of boxes and dots for every pixel, so that each of 3 boxes has dots of 9 sizes.
Masks dot_masks() {
  Masks masks;
  masks["boxes"] = mask_of([](int, int x) { return x < 20 ? 0 : 3 * (1 + x / 200); });
  masks["dots_by_size"] = mask_of([](int y, int x) { return x % 40 < 11 ? y / 55 + 1 : 0; });
  masks["background"] = mask_of([](int, int x) { return x % 40 < 11 ? 0 : 1; });
  return masks;
}

Mask stripes_mask(int period) {
  return mask_of([=](int y, int x) { return (x + 2 * y) % period < 4 ? 255 : 0; });
}

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
    QVERIFY_EXCEPTION_THROWN(ResolvedErrors(whole(ramp), truth.view(), 9, {}), InvalidInput);
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
    const MemoryTruth truth(fine_truth(), {{"fine", everywhere_high()}});
    EvaluationOptions options{Protocol::Benchmark2016, {}, {}};
    options.high_res = &truth;
    std::stop_source stop;
    stop.request_stop();
    options.progress = Progress(stop.get_token(), {});

    QVERIFY_EXCEPTION_THROWN((void)evaluate(whole(constant(0)), whole(constant(0)), {}, options),
                             Cancelled);
  }

  void numbers_areThoseOfPlainLoops() {
    Masks masks = dot_masks();
    for (const char* name :
         {"discontinuities", "fine", "fine_surrounding", "low_texture", "high_contrast",
          "low_contrast", "foreground_fattening", "foreground_thinning"}) {
      masks[name] = stripes_mask(7 + static_cast<int>(masks.size()));
    }
    const auto estimate = loose_estimate();
    const MemoryTruth truth(fine_truth(), masks);
    const Reference loops(estimate, fine_truth(), masks);
    const auto judged = [&](StratifiedScene scene) {
      return judge_high(estimate, truth, scene, InvalidEstimates::Compatible);
    };

    const auto dots = judged(StratifiedScene::Dots), stripes = judged(StratifiedScene::Stripes),
               backgammon = judged(StratifiedScene::Backgammon);

    const auto near = [](const Evaluation& evaluation, const char* key, double expected) {
      const double value = metric(evaluation, key);
      // Errors are float: sums of 40 000 agree to 1e-6 of their size.
      const bool is_near = std::abs(value - expected) <= 1e-6 * std::max(1.0, expected);
      if (!is_near) qWarning() << key << value << expected;
      return is_near && expected > 0;
    };
    QVERIFY(near(dots, "mse_100", loops.mse(nullptr)));
    QVERIFY(near(dots, "badpix_0010", loops.bad_pixels(nullptr, 0.01F)));
    QVERIFY(near(dots, "badpix_0030", loops.bad_pixels(nullptr, 0.03F)));
    QVERIFY(near(dots, "badpix_0070", loops.bad_pixels(nullptr, 0.07F)));
    QVERIFY(near(dots, "q_25_100", loops.q25()));
    QVERIFY(near(dots, "discontinuities_0070", loops.bad_pixels("discontinuities", 0.07F)));
    QVERIFY(near(dots, "fine_fattening_0150",
                 loops.percentage("fine_surrounding",
                                  [](int, int, float d, float t) { return t - d < -0.15F; })));
    QVERIFY(
        near(dots, "fine_thinning_0150",
             loops.percentage("fine", [](int, int, float d, float t) { return t - d > 0.15F; })));
    QVERIFY(near(dots, "background_mse_100", loops.mse("background")));
    QVERIFY(near(dots, "missed_dots_50_0400", loops.missed_dots()));
    QVERIFY(near(stripes, "low_texture_0070", loops.bad_pixels("low_texture", 0.07F)));
    QVERIFY(near(stripes, "dark_stripes_0070", loops.bad_pixels("high_contrast", 0.07F)));
    QVERIFY(near(stripes, "bright_stripes_0070", loops.bad_pixels("low_contrast", 0.07F)));
    QVERIFY(near(backgammon, "backgammon_fattening_0070",
                 loops.percentage("foreground_fattening", [&](int y, int, float d, float t) {
                   return d > 0.5 * (double{loops.truth(y, 140)} + t);
                 })));
    QVERIFY(near(backgammon, "backgammon_thinning_0070",
                 loops.percentage("foreground_thinning", [&](int y, int, float d, float t) {
                   return d < 0.5 * (double{loops.truth(y, kHigh - 11)} + t);
                 })));
  }
};

}  // namespace episcope::in_high_res_metrics_test

EPISCOPE_TEST(high_res_metrics_test, HighResMetricsTest)
#include "high_res_metrics_test.moc"
