// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/double_orientation.h"

#include "engine/core/error.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace episcope::in_double_orientation_test {

using namespace episcope::test;

namespace {

constexpr int kSize = 72;
constexpr int kInset = 14;

// Four waves of 7 to 15 px.
double texture(double x, double y, int seed) {
  double sum = 0;
  for (int i = 0; i < 4; ++i) {
    const double angle = 0.7 + 1.9 * i + 0.6 * seed;
    const double pitch = 7.0 + 2.6 * i + 0.4 * seed;
    sum += std::sin(6.283185307 * (x * std::cos(angle) + y * std::sin(angle)) / pitch + seed + i);
  }
  return 0.11 * sum;
}

// Layers of disparities a and b, the first with the share `mix`.
LightField sum_of(double a, double b, double mix, GridShape grid = {9, 9}) {
  const ViewIndex center = grid.center();
  return make_light_field(grid, kSize, kSize, 1, [=](ViewIndex view, int y, int x, int) {
    const double u = view.u - center.u, v = view.v - center.v;
    return static_cast<float>(0.5 + mix * texture(x + a * u, y + a * v, 1) +
                              (1 - mix) * texture(x + b * u, y + b * v, 2));
  });
}

// The same with noise, which horizontal and vertical EPIs disagree by.
LightField noisy(const LightField& lf) {
  const ViewStack<float> samples = float_samples(lf);
  std::mt19937 random(6);
  std::normal_distribution<float> noise(0, 0.012F);
  return like(lf, [&](ViewIndex view, int y, int x, int c) {
    return samples.view(view).at(y, x, c) + noise(random);
  });
}

DoubleLayers measure(const LightField& lf, int threads = 0, double view_scale = 1.8) {
  const TensorScales scales{0.8, 2, view_scale, 1, 10, 0.15};
  return measure_double_layers(lf, scales, {{-3.5, 3.5}, 0.15}, {{{}, lf.grid()}, 0, lf.height()},
                               Progress(threads));
}

struct Quality {
  double median_near, median_far, median_confidence;
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

Quality quality(const DoubleLayers& layers, ViewIndex view, double near, double far) {
  std::vector<double> a, b, c;
  for (int y = kInset; y < kSize - kInset; ++y) {
    for (int x = kInset; x < kSize - kInset; ++x) {
      a.push_back(std::fabs(layers.near.view(view).at(y, x) - near));
      b.push_back(std::fabs(layers.far.view(view).at(y, x) - far));
      c.push_back(layers.confidence.view(view).at(y, x) / 255.0);
    }
  }
  return {median(a), median(b), median(c)};
}

}  // namespace

class DoubleOrientationTest : public QObject {
  Q_OBJECT

 private slots:
  void sums_areTakenApart_data();
  void sums_areTakenApart();
  void transposing_changesNothing();
  void integrationAlongTheViews_wearsNoiseDown();
  void wholeShear_shiftsBoth();
  void oneLayer_hasNoConfidence();
  void threads_changeNothing();
  void gridsWithoutThreeViews_areRefused();
};

void DoubleOrientationTest::sums_areTakenApart_data() {
  QTest::addColumn<double>("a");
  QTest::addColumn<double>("b");
  QTest::addColumn<double>("mix");
  QTest::addColumn<double>("limit");
  // Wider filters than ours have been seen to reach 0.005 to 0.05 px.
  QTest::newRow("0.5, -0.5") << 0.5 << -0.5 << 0.5 << 0.01;
  QTest::newRow("swapped") << -0.5 << 0.5 << 0.5 << 0.01;
  QTest::newRow("0.3, -0.2") << 0.3 << -0.2 << 0.5 << 0.01;
  QTest::newRow("0.6, 0.2") << 0.6 << 0.2 << 0.5 << 0.01;
  QTest::newRow("1.0, -0.5") << 1.0 << -0.5 << 0.5 << 0.02;
  QTest::newRow("80 to 20") << 0.5 << -0.5 << 0.8 << 0.02;
  QTest::newRow("20 to 80") << 0.5 << -0.5 << 0.2 << 0.02;
  QTest::newRow("far from upright") << 3.0 << 2.2 << 0.5 << 0.02;
}

void DoubleOrientationTest::sums_areTakenApart() {
  QFETCH(double, a);
  QFETCH(double, b);
  QFETCH(double, mix);
  QFETCH(double, limit);
  const DoubleLayers layers = measure(sum_of(a, b, mix));

  for (const ViewIndex view : {ViewIndex{4, 4}, ViewIndex{0, 0}, ViewIndex{8, 3}}) {
    const Quality found = quality(layers, view, std::max(a, b), std::min(a, b));
    const QString text = QString("view %1,%2: %3 %4, confidence %5")
                             .arg(view.v)
                             .arg(view.u)
                             .arg(found.median_near)
                             .arg(found.median_far)
                             .arg(found.median_confidence);
    QVERIFY2(found.median_near < limit && found.median_far < limit, qPrintable(text));
    QVERIFY2(found.median_confidence > 0.9, qPrintable(text));
  }
}

void DoubleOrientationTest::transposing_changesNothing() {
  const LightField lf = noisy(sum_of(0.5, -0.3, 0.5));
  const DoubleLayers straight = measure(lf);
  const DoubleLayers turned = measure(transposed(lf));
  std::vector<double> offs;
  for (int y = kInset; y < kSize - kInset; ++y) {
    for (int x = kInset; x < kSize - kInset; ++x) {
      const double off = straight.near.view({4, 4}).at(y, x) - turned.near.view({4, 4}).at(x, y);
      offs.push_back(std::fabs(off));
    }
  }
  // Merging weights confidences of 8 bits; directions that all but agree may be taken for agreeing.
  std::sort(offs.begin(), offs.end());
  const double most = offs[offs.size() * 98 / 100];
  QVERIFY2(most < 5e-3, qPrintable(QString::number(most)));
}

void DoubleOrientationTest::integrationAlongTheViews_wearsNoiseDown() {
  const LightField lf = noisy(sum_of(0.5, -0.3, 0.5));
  const Quality with = quality(measure(lf), {4, 4}, 0.5, -0.3);
  const Quality without = quality(measure(lf, 0, 0), {4, 4}, 0.5, -0.3);
  const QString text = QString("%1 %2, without %3 %4")
                           .arg(with.median_near)
                           .arg(with.median_far)
                           .arg(without.median_near)
                           .arg(without.median_far);
  QVERIFY2(with.median_near < 0.8 * without.median_near, qPrintable(text));
  QVERIFY2(with.median_far < 0.8 * without.median_far, qPrintable(text));
}

void DoubleOrientationTest::wholeShear_shiftsBoth() {
  const LightField lf = sum_of(0.4, -0.4, 0.5);
  const DoubleLayers upright = measure(lf);
  const DoubleLayers shifted = measure(sheared(lf, 2));
  const int inset = 30;
  for (int y = inset; y < kSize - inset; ++y) {
    for (int x = inset; x < kSize - inset; ++x) {
      const double near = shifted.near.view({4, 4}).at(y, x) - upright.near.view({4, 4}).at(y, x);
      const double far = shifted.far.view({4, 4}).at(y, x) - upright.far.view({4, 4}).at(y, x);
      QVERIFY(std::fabs(near - 2) < 1e-3 && std::fabs(far - 2) < 1e-3);
    }
  }
}

void DoubleOrientationTest::oneLayer_hasNoConfidence() {
  const Scene scene = render("fronto", kSize, kSize, {9, 9}, 1, 2);
  const DoubleLayers layers = measure(*scene.light_field);
  QVERIFY(quality(layers, {4, 4}, 0, 0).median_confidence < 0.5);
}

void DoubleOrientationTest::threads_changeNothing() {
  const LightField lf = sum_of(0.5, -0.5, 0.5, {5, 4});
  const DoubleLayers one = measure(lf, 1);
  const DoubleLayers many = measure(lf, 5);
  QVERIFY(same_bytes(one.near, many.near) && same_bytes(one.far, many.far));
}

void DoubleOrientationTest::gridsWithoutThreeViews_areRefused() {
  QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)measure(sum_of(0.5, -0.5, 0.5, {2, 2})));
  const DoubleLayers row = measure(sum_of(0.5, -0.5, 0.5, {1, 9}));
  QVERIFY(quality(row, {0, 4}, 0.5, -0.5).median_near < 0.02);
}

}  // namespace episcope::in_double_orientation_test

EPISCOPE_TEST(double_orientation_test, DoubleOrientationTest)
#include "double_orientation_test.moc"
