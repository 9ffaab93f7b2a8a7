// SPDX-License-Identifier: BSD-3-Clause
#include "tests/engine/evaluation/high_res_maps.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <random>

// Metrics of the high resolution against plain loops over the enlarged map.

namespace episcope::in_plain_loops_test {

using namespace episcope::test;

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

class PlainLoopsTest : public QObject {
  Q_OBJECT
 private slots:
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

}  // namespace episcope::in_plain_loops_test

EPISCOPE_TEST(plain_loops_test, PlainLoopsTest)
#include "plain_loops_test.moc"
