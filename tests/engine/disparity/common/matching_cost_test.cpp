// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/matching_cost.h"

#include "engine/core/error.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stop_token>
#include <vector>

namespace episcope::in_matching_cost_test {

using namespace episcope::test;

namespace {

constexpr double kNoCap = std::numeric_limits<double>::infinity();

// A different number for every sample, without pattern.
float hashed(ViewIndex view, int y, int x, int c) {
  const double phase = 12.9898 * x + 78.233 * y + 37.719 * view.u + 4.581 * view.v + 9.151 * c;
  const double number = std::sin(phase) * 43758.5453;
  return static_cast<float>(number - std::floor(number));
}

LightField unrelated_views(GridShape grid = {3, 5}, int channels = 3) {
  return make_light_field(grid, 21, 150, channels, hashed);
}

// A plane whose points move by whole pixels at disparity `d`, larger than any view.
LightField plane(int d, GridShape grid = {5, 5}) {
  const ViewIndex center = grid.center();
  return make_light_field(grid, 33, 41, 3, [=](ViewIndex view, int y, int x, int c) {
    return hashed({0, 0}, y + d * (view.v - center.v), x + d * (view.u - center.u), c);
  });
}

double catmull_rom(double x) {
  x = std::fabs(x);
  if (x < 1) return 1 + x * x * (1.5 * x - 2.5);
  return x < 2 ? 2 + x * (-4 + x * (2.5 - 0.5 * x)) : 0;
}

double kernel_of(Interpolation interpolation, double x) {
  return interpolation == Interpolation::Cubic ? catmull_rom(x) : std::max(0.0, 1 - std::fabs(x));
}

double sample(const ImageView<const float>& image, double y, double x, int c,
              Interpolation interpolation) {
  double sum = 0;
  for (int j = static_cast<int>(std::floor(y)) - 1; j <= std::floor(y) + 2; ++j) {
    for (int i = static_cast<int>(std::floor(x)) - 1; i <= std::floor(x) + 2; ++i) {
      const double weight = kernel_of(interpolation, y - j) * kernel_of(interpolation, x - i);
      sum += weight *
             image.at(std::clamp(j, 0, image.height - 1), std::clamp(i, 0, image.width - 1), c);
    }
  }
  return sum;
}

// Equations (3) and (4), literally, in canonical axes.
double defined_cost(const ViewStack<float>& views, ViewIndex reference, const MatchingCost& cost,
                    double label, int y, int x) {
  double sum = 0;
  int count = 0;
  for (int v = 0; v < views.grid().v; ++v) {
    for (int u = 0; u < views.grid().u; ++u) {
      const bool cross = v == reference.v || u == reference.u;
      if (ViewIndex{v, u} == reference) continue;
      if (cost.views == MatchedViews::CrossHair && !cross) continue;
      const double sy = y - label * (v - reference.v);
      const double sx = x - label * (u - reference.u);
      if (sy < 0 || sy > views.height() - 1 || sx < 0 || sx > views.width() - 1) continue;
      double energy = 0;
      for (int c = 0; c < views.channels(); ++c) {
        const double difference = sample(views.view({v, u}), sy, sx, c, cost.interpolation) -
                                  views.view(reference).at(y, x, c);
        energy += difference * difference;
      }
      sum += std::min(cost.cap, std::sqrt(energy));
      ++count;
    }
  }
  return count > 0 ? sum / count : std::min(cost.cap, std::sqrt(views.channels()));
}

Volume<float> costs_of(const LightField& lf, ViewIndex reference, const MatchingCost& cost,
                       const std::vector<float>& labels, int threads = 0) {
  return matching_costs(lf, reference, cost, labels, Progress(threads));
}

double largest_difference(const Volume<float>& a, const Volume<float>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.view().size(); ++i) {
    const double difference = std::fabs(a.view().data[i] - b.view().data[i]);
    if (!(difference <= largest)) largest = difference;
  }
  return largest;
}

int best_label(VolumeView<const float> costs, int y, int x) {
  int best = 0;
  for (int l = 1; l < costs.layers; ++l) {
    if (costs.at(y, l, x) < costs.at(y, best, x)) best = l;
  }
  return best;
}

}  // namespace

class MatchingCostTest : public QObject {
  Q_OBJECT

 private slots:
  void costs_areThoseOfTheDefinition_data();
  void costs_areThoseOfTheDefinition();
  void plane_costsNothingAtItsLabel_data();
  void plane_costsNothingAtItsLabel();
  void crossHair_hasSixteenNeighbours();
  void cap_ignoresOneViewTurnedWhite();
  void noise_favoursNoLabel();
  void bothKinds_agreeOnOneRowOfViews();
  void rows_areThoseOfTheWholeVolume();
  void threads_changeNothing();
  void storedType_changesNothing();
  void badRequests_areRefused();
  void stop_isHonoured();
  void labels_spanTheRange();
};

void MatchingCostTest::costs_areThoseOfTheDefinition_data() {
  QTest::addColumn<int>("views");
  QTest::addColumn<int>("interpolation");
  QTest::addColumn<double>("cap");
  QTest::addColumn<int>("v");
  QTest::addColumn<int>("u");
  QTest::addColumn<int>("channels");
  QTest::newRow("all bilinear") << 0 << 0 << kNoCap << 1 << 2 << 3;
  QTest::newRow("all cubic capped") << 0 << 1 << 0.3 << 1 << 2 << 3;
  QTest::newRow("cross bilinear capped") << 1 << 0 << 0.3 << 1 << 2 << 3;
  QTest::newRow("cross cubic, corner view") << 1 << 1 << kNoCap << 0 << 4 << 3;
  QTest::newRow("all cubic, edge view, grey") << 0 << 1 << 0.2 << 2 << 0 << 1;
}

void MatchingCostTest::costs_areThoseOfTheDefinition() {
  QFETCH(int, views);
  QFETCH(int, interpolation);
  QFETCH(double, cap);
  QFETCH(int, v);
  QFETCH(int, u);
  QFETCH(int, channels);
  const LightField lf = unrelated_views({3, 5}, channels);
  const MatchingCost cost{static_cast<MatchedViews>(views),
                          static_cast<Interpolation>(interpolation), cap};
  // Not sorted, whole and broken, some so far that few views or none see the point.
  const std::vector<float> labels{0, 0.37F, -1, 2.5F, -7.25F, 30, 13.1F, -200, 1.999F};
  const Volume<float> costs = costs_of(lf, {v, u}, cost, labels);
  const ViewStack<float> samples = float_samples(lf);
  for (int y = 0; y < lf.height(); y += 2) {
    for (int l = 0; l < costs.layers(); ++l) {
      for (int x = 0; x < lf.width(); ++x) {
        const double expected = defined_cost(samples, {v, u}, cost, labels[l], y, x);
        const double found = costs.view().at(y, l, x);
        QVERIFY2(std::fabs(found - expected) < 1e-4, qPrintable(QString("%1 instead of %2 at %3,%4 "
                                                                        "label %5")
                                                                    .arg(found)
                                                                    .arg(expected)
                                                                    .arg(y)
                                                                    .arg(x)
                                                                    .arg(labels[l])));
      }
    }
  }
}

void MatchingCostTest::plane_costsNothingAtItsLabel_data() {
  QTest::addColumn<int>("d");
  for (const int d : {-2, -1, 0, 1, 2}) QTest::addRow("%d", d) << d;
}

// Whole pixels need no interpolation, and samples beyond the image do not count: nothing is left
// but rounding, up to the border.
void MatchingCostTest::plane_costsNothingAtItsLabel() {
  QFETCH(int, d);
  const LightField lf = plane(d);
  const std::vector<float> labels = equidistant_labels({-2, 2}, 9);
  const Volume<float> costs = costs_of(lf, lf.center(), {}, labels);
  for (int y = 0; y < lf.height(); ++y) {
    for (int x = 0; x < lf.width(); ++x) {
      QCOMPARE(best_label(costs.view(), y, x), 2 * d + 4);
      QVERIFY(costs.view().at(y, 2 * d + 4, x) < 1e-6F);
    }
  }
}

// 9×9 views of the same grey, one of them brighter by 0.8: its share in the mean tells how many
// views there are.
void MatchingCostTest::crossHair_hasSixteenNeighbours() {
  const auto brightened = [](ViewIndex bright) {
    return make_light_field({9, 9}, 10, 12, 1, [bright](ViewIndex view, int, int, int) {
      return view == bright ? 0.9F : 0.1F;
    });
  };
  const auto cost_at = [&](ViewIndex bright, MatchedViews views) {
    const MatchingCost cost{views, Interpolation::Cubic, kNoCap};
    return costs_of(brightened(bright), {4, 4}, cost, {0}).view().at(5, 0, 6);
  };
  for (const ViewIndex on_cross : {ViewIndex{4, 0}, ViewIndex{0, 4}, ViewIndex{5, 4}}) {
    QVERIFY(std::fabs(cost_at(on_cross, MatchedViews::CrossHair) - 0.8F / 16) < 1e-6F);
    QVERIFY(std::fabs(cost_at(on_cross, MatchedViews::All) - 0.8F / 80) < 1e-6F);
  }
  QCOMPARE(cost_at({3, 5}, MatchedViews::CrossHair), 0.0F);
  QVERIFY(std::fabs(cost_at({3, 5}, MatchedViews::All) - 0.8F / 80) < 1e-6F);
}

// A view white but for a patch where the wrong label looks: without a cap that one view outvotes
// the seven others.
void MatchingCostTest::cap_ignoresOneViewTurnedWhite() {
  const LightField clean = plane(1, {1, 9});
  const ViewStack<float> samples = float_samples(clean);
  const LightField spoilt = like(clean, [&](ViewIndex view, int y, int x, int c) {
    if (view.u == 8) return x < 20 ? 1.0F : 0.5F;
    return 0.45F + 0.1F * samples.view(view).at(y, x, c);
  });
  const auto right_with = [&](double cap) {
    const MatchingCost cost{MatchedViews::All, Interpolation::Bilinear, cap};
    const Volume<float> costs = costs_of(spoilt, {0, 4}, cost, {1, 0});
    int right = 0;
    // There the spoilt view shows white at label 1, which is right, and the patch at label 0.
    for (int y = 0; y < 33; ++y) {
      for (int x = 20; x < 24; ++x) right += best_label(costs.view(), y, x) == 0;
    }
    return right;
  };
  QCOMPARE(right_with(0.02), 33 * 4);
  QVERIFY(right_with(kNoCap) < 33);
}

// Without the noise term, moving views by half pixels averages the noise away and looks like a
// match.
void MatchingCostTest::noise_favoursNoLabel() {
  const LightField noise = unrelated_views({5, 5});
  const auto ratio_with = [&](std::shared_ptr<const Image<float>> variance) {
    MatchingCost cost;
    cost.noise = std::move(variance);
    const Volume<float> costs = costs_of(noise, noise.center(), cost, {0, 0.5F});
    double whole = 0, half = 0;
    for (int y = 0; y < noise.height(); ++y) {
      for (int x = 0; x < noise.width(); ++x) {
        whole += costs.view().at(y, 0, x);
        half += costs.view().at(y, 1, x);
      }
    }
    return half / whole;
  };
  // Of numbers evenly spread over [0, 1].
  const auto variance = std::make_shared<Image<float>>(noise.height(), noise.width(), 1, 1.0F / 12);

  const double without = ratio_with(nullptr), with = ratio_with(variance);

  QVERIFY2(without < 0.93, qPrintable(QString::number(without)));
  QVERIFY2(std::fabs(with - 1) < 0.02, qPrintable(QString::number(with)));
}

void MatchingCostTest::bothKinds_agreeOnOneRowOfViews() {
  for (const GridShape grid : {GridShape{1, 5}, GridShape{5, 1}}) {
    const LightField lf = unrelated_views(grid);
    const std::vector<float> labels = equidistant_labels({-1.5, 1.5}, 7);
    const MatchingCost all{MatchedViews::All, Interpolation::Cubic, 0.2};
    const MatchingCost cross{MatchedViews::CrossHair, Interpolation::Cubic, 0.2};
    const ViewIndex center = lf.center();
    QCOMPARE(
        largest_difference(costs_of(lf, center, all, labels), costs_of(lf, center, cross, labels)),
        0.0);
  }
}

void MatchingCostTest::rows_areThoseOfTheWholeVolume() {
  const LightField lf = unrelated_views();
  const std::vector<float> labels = equidistant_labels({-1, 2}, 70);
  const MatchingCost cost{MatchedViews::All, Interpolation::Cubic, 0.1};
  const Volume<float> whole = costs_of(lf, {1, 1}, cost, labels);
  Volume<float> banded(lf.height(), static_cast<int>(labels.size()), lf.width());
  MatchingCostRows rows(lf, {1, 1}, cost, labels);
  for (int y = 0; y < lf.height(); y += 5) {
    rows.compute(y, {banded.view().row(y, 0), std::min(5, lf.height() - y), 70, lf.width()},
                 Progress());
  }
  QCOMPARE(largest_difference(whole, banded), 0.0);
}

void MatchingCostTest::threads_changeNothing() {
  const LightField lf = unrelated_views();
  const std::vector<float> labels = equidistant_labels({-3, 3}, 13);
  const MatchingCost cost;
  QCOMPARE(largest_difference(costs_of(lf, lf.center(), cost, labels, 1),
                              costs_of(lf, lf.center(), cost, labels, 4)),
           0.0);
}

// Bytes take another code path; both give the same numbers up to the rounding of the stored ones.
void MatchingCostTest::storedType_changesNothing() {
  const Scene scene = render("edge", 30, 140, {3, 3});
  const std::vector<float> labels = equidistant_labels({-1, 1}, 5);
  const LightField& lf = *scene.light_field;
  QVERIFY(largest_difference(costs_of(lf, lf.center(), {}, labels),
                             costs_of(as_uint16(lf), lf.center(), {}, labels)) < 1e-5);
}

void MatchingCostTest::badRequests_areRefused() {
  const LightField lf = unrelated_views();
  const LightField single = unrelated_views({1, 1});
  MatchingCost no_cost;
  no_cost.cap = 0;
  QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)costs_of(lf, {3, 0}, {}, {0}));
  QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)costs_of(lf, {1, 1}, {}, {}));
  QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)costs_of(lf, {1, 1}, no_cost, {0}));
  QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)costs_of(single, {0, 0}, {}, {0}));
}

void MatchingCostTest::stop_isHonoured() {
  std::stop_source source;
  source.request_stop();
  const Progress progress(source.get_token(), nullptr);
  QVERIFY_THROWS_EXCEPTION(Cancelled,
                           (void)matching_costs(unrelated_views(), {1, 1}, {}, {0, 1}, progress));
}

void MatchingCostTest::labels_spanTheRange() {
  QCOMPARE(equidistant_labels({-1, 2}, 4), (std::vector<float>{-1, 0, 1, 2}));
  QCOMPARE(equidistant_labels({-1, 2}, 1), (std::vector<float>{0.5F}));
}

}  // namespace episcope::in_matching_cost_test

EPISCOPE_TEST(matching_cost_test, MatchingCostTest)
#include "matching_cost_test.moc"
