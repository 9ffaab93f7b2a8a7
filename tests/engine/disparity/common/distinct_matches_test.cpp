// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/disparity_range.h"

#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace episcope::in_distinct_matches_test {

using namespace episcope::test;

namespace {

Image<float> matches_of(const LightField& lf, Interval range) {
  std::vector<int> rows(lf.height());
  std::iota(rows.begin(), rows.end(), 0);
  return distinct_matches(lf, rows, range, Progress());
}

// Of the pixels that match distinctly, those that do so within 0.1 px of a disparity.
double share_at(const Image<float>& matches, float disparity) {
  const auto all = std::ranges::count_if(matches, [](float m) { return !std::isnan(m); });
  const auto near =
      std::ranges::count_if(matches, [=](float m) { return std::fabs(m - disparity) < 0.1F; });
  return static_cast<double>(near) / static_cast<double>(all);
}

}  // namespace

class DistinctMatchesTest : public QObject {
  Q_OBJECT

 private slots:
  // Two planes, at −0.5 and 0.8 px.
  void disparities_areMatchedWhereTheyAre() {
    const Scene scene = render("edge", 64, 80, {5, 5});

    const Image<float> matches = matches_of(*scene.light_field, {-2.1, 2.3});

    const double far = share_at(matches, -0.5), near = share_at(matches, 0.8F);
    QVERIFY2(far > 0.4 && near > 0.4, qPrintable(QString("%1, %2").arg(far).arg(near)));
    for (int y = 8; y < 56; ++y) {
      const float left = matches.at(y, 12), right = matches.at(y, 68);
      QVERIFY(std::isnan(left) || std::fabs(left + 0.5F) < 0.1F);
      QVERIFY(std::isnan(right) || std::fabs(right - 0.8F) < 0.1F);
    }
  }

  void rows_areThoseAskedFor() {
    const Scene scene = render("edge", 64, 80, {5, 5});
    const Interval range{-2, 2};

    const Image<float> some = distinct_matches(*scene.light_field, {5, 40}, range, Progress());

    const Image<float> all = matches_of(*scene.light_field, range);
    QCOMPARE(some.height(), 2);
    const auto is_same = [](float a, float b) {
      return a == b || (std::isnan(a) && std::isnan(b));
    };
    QVERIFY(std::equal(some.row(0), some.row(0) + some.width(), all.row(5), is_same));
    QVERIFY(std::equal(some.row(1), some.row(1) + some.width(), all.row(40), is_same));
  }

  // Stripes 4 px apart suit −3 as well as 1: three views cannot tell which.
  void repeatedPatterns_matchNothing() {
    const LightField lf =
        make_light_field({3, 3}, 48, 48, 1, [](ViewIndex view, int y, int x, int) {
          const int px = x + view.u - 1, py = y + view.v - 1;
          const bool is_striped = y < 24;
          return is_striped ? static_cast<float>(px % 4) / 4.0F
                            : static_cast<float>((px * 37 + py * 71 + px * py * 13) % 101) / 101.0F;
        });

    const Image<float> matches = matches_of(lf, {-4, 4});

    QVERIFY2(share_at(matches, -3) < 0.05, qPrintable(QString::number(share_at(matches, -3))));
    QVERIFY2(share_at(matches, 1) > 0.9, qPrintable(QString::number(share_at(matches, 1))));
  }

  void pixelsWithoutTexture_matchNothing() {
    const LightField lf =
        make_light_field({3, 3}, 16, 16, 1, [](ViewIndex, int, int, int) { return 0.5F; });

    const Image<float> matches = matches_of(lf, {-1, 1});

    QVERIFY(std::ranges::all_of(matches, [](float match) { return std::isnan(match); }));
  }
};

}  // namespace episcope::in_distinct_matches_test

EPISCOPE_TEST(distinct_matches_test, DistinctMatchesTest)
#include "distinct_matches_test.moc"
