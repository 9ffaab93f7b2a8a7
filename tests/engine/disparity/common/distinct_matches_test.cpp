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

Image<float> matches_of(const LightField& lf, const std::vector<float>& labels) {
  std::vector<int> rows(lf.height());
  std::iota(rows.begin(), rows.end(), 0);
  return distinct_matches(lf, rows, labels, Progress());
}

// Of the pixels that match distinctly.
double share_of(const Image<float>& matches, float label) {
  const auto all = std::ranges::count_if(matches, [](float m) { return !std::isnan(m); });
  return static_cast<double>(std::ranges::count(matches, label)) / static_cast<double>(all);
}

}  // namespace

class DistinctMatchesTest : public QObject {
  Q_OBJECT

 private slots:
  // Of the two planes, one at −0.5 and one at 0.8 px.
  void labels_areMatchedWhereTheirPixelsAre() {
    const Scene scene = render("edge", 64, 80, {5, 5});

    const Image<float> matches = matches_of(*scene.light_field, {-2, -0.5, 0, 0.8F, 2});

    const double far = share_of(matches, -0.5), near = share_of(matches, 0.8F);
    QVERIFY2(far > 0.4 && near > 0.4, qPrintable(QString("%1, %2").arg(far).arg(near)));
    QCOMPARE(matches.at(32, 10), -0.5F);
    QCOMPARE(matches.at(32, 70), 0.8F);
  }

  void rows_areThoseAskedFor() {
    const Scene scene = render("edge", 64, 80, {5, 5});
    const std::vector<float> labels{-2, -0.5, 0, 0.8F, 2};

    const Image<float> some = distinct_matches(*scene.light_field, {5, 40}, labels, Progress());

    const Image<float> all = matches_of(*scene.light_field, labels);
    QCOMPARE(some.height(), 2);
    const auto is_same = [](float a, float b) {
      return a == b || (std::isnan(a) && std::isnan(b));
    };
    QVERIFY(std::equal(some.row(0), some.row(0) + some.width(), all.row(5), is_same));
    QVERIFY(std::equal(some.row(1), some.row(1) + some.width(), all.row(40), is_same));
  }

  // Stripes 4 px apart suit −3 as well as 1: three views cannot tell which.
  void pixelsThatMatchSeveralLabels_matchNone() {
    const LightField lf =
        make_light_field({3, 3}, 48, 48, 1, [](ViewIndex view, int y, int x, int) {
          const int px = x + view.u - 1, py = y + view.v - 1;
          const bool is_striped = y < 24;
          return is_striped ? static_cast<float>(px % 4) / 4.0F
                            : static_cast<float>((px * 37 + py * 71 + px * py * 13) % 101) / 101.0F;
        });

    const Image<float> matches = matches_of(lf, {-3, -1, 1, 3});

    QVERIFY2(share_of(matches, -3) < 0.05, qPrintable(QString::number(share_of(matches, -3))));
    QVERIFY2(share_of(matches, 1) > 0.9, qPrintable(QString::number(share_of(matches, 1))));
  }

  void pixelsWithoutTexture_matchNone() {
    const LightField lf =
        make_light_field({3, 3}, 16, 16, 1, [](ViewIndex, int, int, int) { return 0.5F; });

    const Image<float> matches = matches_of(lf, {-1, 0, 1});

    QVERIFY(std::ranges::all_of(matches, [](float label) { return std::isnan(label); }));
  }
};

}  // namespace episcope::in_distinct_matches_test

EPISCOPE_TEST(distinct_matches_test, DistinctMatchesTest)
#include "distinct_matches_test.moc"
