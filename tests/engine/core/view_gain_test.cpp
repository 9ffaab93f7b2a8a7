// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/view_gain.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace episcope::in_view_gain_test {

namespace {

constexpr GridShape kGrid{5, 7};
constexpr ViewIndex kCenter = {2, 3};
constexpr int kHeight = 120;
constexpr int kWidth = 160;

using Gain = std::function<double(ViewIndex, int c)>;

// Two planes of texture, at a disparity of 2.3 px in the left half and of −1.6 px in the right.
double texture(ViewIndex view, int y, int x, int c) {
  const double d = x < kWidth / 2 ? 2.3 : -1.6;
  const double at_x = x + d * (view.u - kCenter.u);
  const double at_y = y + d * (view.v - kCenter.v);
  return 0.35 + 0.05 * c + 0.12 * std::sin(0.37 * at_x + 0.21 * at_y) * std::cos(0.29 * at_y) +
         0.1 * std::sin(0.05 * at_x - 0.07 * at_y);
}

LightField::Samples views(const Gain& gain, double exposure = 1) {
  ViewStack<std::uint8_t> stack(kGrid, kHeight, kWidth, 3);
  for (int i = 0; i < kGrid.count(); ++i) {
    const ViewIndex view = kGrid.view_at(i);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        for (int c = 0; c < 3; ++c) {
          const double value = exposure * gain(view, c) * texture(view, y, x, c);
          stack.view(view).at(y, x, c) =
              static_cast<std::uint8_t>(std::clamp(255 * value + 0.5, 0.0, 255.0));
        }
      }
    }
  }
  return stack;
}

// From 0.8 to 1.2, another in each channel, 1 in the center view.
double some_gain(ViewIndex view, int c) {
  if (view == kCenter) return 1;
  return 0.8 + 0.4 * ((7 * view.v + 3 * view.u + 5 * c) % 11) / 10.0;
}

double no_gain(ViewIndex, int) {
  return 1;
}

double largest_error(const PhotometricCorrection& gains, const Gain& truth) {
  double largest = 0;
  for (int i = 0; i < kGrid.count(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double off = gains.gains[i][c] / truth(kGrid.view_at(i), c) - 1;
      largest = std::isnan(off) ? 1e9 : std::max(largest, std::abs(off));
    }
  }
  return largest;
}

}  // namespace

class ViewGainTest : public QObject {
  Q_OBJECT

 private slots:
  void gains_areRecovered() {
    const PhotometricCorrection gains = measure_view_gains(views(some_gain), {}, Progress(2));

    QVERIFY2(largest_error(gains, some_gain) < 0.01,
             qPrintable(QString::number(largest_error(gains, some_gain))));
    QCOMPARE(gains.of(kCenter), 1.0);
  }

  void gains_areRecoveredFromAQuarterOfTheBlocks() {
    const LightField::Samples samples = views(some_gain);
    const PhotometricCorrection of_all = measure_view_gains(samples, {}, Progress(2));

    const PhotometricCorrection gains =
        measure_view_gains(samples, {}, Progress(2), GainBlocks::OneOfFour);

    QVERIFY2(largest_error(gains, some_gain) < 0.01,
             qPrintable(QString::number(largest_error(gains, some_gain))));
    QVERIFY(gains.gains != of_all.gains);
  }

  void allBlocks_areComparedWhereAQuarterIsTooFew() {
    const LightField::Samples samples = views(some_gain);
    ViewStack<std::uint8_t> valid(kGrid, kHeight, kWidth);
    // Blocks are 12 px large: no pixel of every second row of them is valid.
    for (int y = 0; y < kHeight; ++y) {
      for (int i = 0; i < kGrid.count(); ++i) {
        std::fill_n(valid.view(kGrid.view_at(i)).row(y), kWidth, y / 12 % 2 == 0 ? 0 : 1);
      }
    }

    const PhotometricCorrection gains =
        measure_view_gains(samples, valid, Progress(2), GainBlocks::OneOfFour);

    QVERIFY(largest_error(gains, some_gain) < 0.01);
    QVERIFY(gains.gains == measure_view_gains(samples, valid, Progress(2)).gains);
  }

  void equalViews_haveGainOne() {
    const PhotometricCorrection gains = measure_view_gains(views(no_gain), {}, Progress(2));

    QVERIFY2(largest_error(gains, no_gain) < 0.01,
             qPrintable(QString::number(largest_error(gains, no_gain))));
  }

  void clippedPixels_doNotCount() {
    // A third of the pixels is cut off in the brightest views.
    const PhotometricCorrection gains = measure_view_gains(views(some_gain, 1.7), {}, Progress(2));

    QVERIFY2(largest_error(gains, some_gain) < 0.01,
             qPrintable(QString::number(largest_error(gains, some_gain))));
  }

  void invalidPixels_doNotCount() {
    LightField::Samples samples = views(some_gain);
    ViewStack<std::uint8_t> valid(kGrid, kHeight, kWidth);
    std::fill_n(valid.data(), valid.size(), std::uint8_t{1});
    for (int i = 0; i < kGrid.count(); ++i) {
      const ViewIndex view = kGrid.view_at(i);
      if (view == kCenter) continue;
      for (int y = 0; y < 10 * (1 + i % 5); ++y) {
        for (int x = 0; x < kWidth; ++x) {
          valid.view(view).at(y, x) = 0;
          std::fill_n(&std::get<ViewStack<std::uint8_t>>(samples).view(view).at(y, x, 0), 3,
                      std::uint8_t{20});
        }
      }
    }

    const PhotometricCorrection gains = measure_view_gains(samples, valid, Progress(2));

    QVERIFY2(largest_error(gains, some_gain) < 0.01,
             qPrintable(QString::number(largest_error(gains, some_gain))));
  }

  void darkView_hasNoGain() {
    const ViewIndex dark{0, 6};

    const PhotometricCorrection gains = measure_view_gains(
        views([&](ViewIndex view, int) { return view == dark ? 0.0 : 1.0; }), {}, Progress(2));

    QVERIFY(std::isnan(gains.of(dark)));
    QVERIFY(std::abs(gains.of(gains.most_different()) - 1) < 0.01);
  }

  void mostDifferentView_isFound() {
    const ViewIndex odd{4, 1};

    const PhotometricCorrection gains = measure_view_gains(
        views([&](ViewIndex view, int) { return view == odd ? 0.9 : 1.0; }), {}, Progress(2));

    QCOMPARE(gains.most_different(), odd);
  }

  void division_bringsTheViewsTogether() {
    LightField::Samples samples = views(some_gain);
    const LightField::Samples even = views(no_gain);
    PhotometricCorrection gains{.grid = kGrid};
    for (int i = 0; i < kGrid.count(); ++i) {
      const ViewIndex view = kGrid.view_at(i);
      gains.gains.push_back({some_gain(view, 0), some_gain(view, 1), some_gain(view, 2)});
    }

    const double clipped = divide_by_gains(samples, gains, Progress(2));

    QCOMPARE(clipped, 0.0);
    const auto& a = std::get<ViewStack<std::uint8_t>>(samples);
    const auto& b = std::get<ViewStack<std::uint8_t>>(even);
    for (std::size_t i = 0; i < a.size(); ++i) QVERIFY(std::abs(a.data()[i] - b.data()[i]) <= 1);
  }

  void division_countsWhatItClips() {
    ViewStack<std::uint8_t> stack({1, 2}, 2, 2, 1);
    std::fill_n(stack.data(), stack.size(), std::uint8_t{200});
    stack.view({0, 0}).at(1, 1) = 100;
    LightField::Samples samples = std::move(stack);

    const PhotometricCorrection gains{.grid = {1, 2}, .gains = {{0.5, 0.5, 0.5}, {1, 1, 1}}};

    const double clipped = divide_by_gains(samples, gains, Progress(1));

    QCOMPARE(clipped, 3.0 / 8);
    const auto& divided = std::get<ViewStack<std::uint8_t>>(samples);
    QCOMPARE(int(divided.view({0, 0}).at(0, 0)), 255);
    QCOMPARE(int(divided.view({0, 0}).at(1, 1)), 200);
    QCOMPARE(int(divided.view({0, 1}).at(0, 0)), 200);
  }
};

}  // namespace episcope::in_view_gain_test

EPISCOPE_CORE_TEST(view_gain_test, ViewGainTest)
#include "view_gain_test.moc"
