// SPDX-License-Identifier: BSD-3-Clause
// One channel counts as three equal ones (channel_weight): gray scenes have no color to tell
// surfaces apart, but no threshold is another there.
#include "engine/core/view_gain.h"
#include "engine/disparity/denoise.h"
#include "engine/disparity/plane_labeling.h"
#include "engine/disparity/registry.h"
#include "engine/disparity/visible_costs.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>

namespace episcope::in_one_channel_test {

using namespace episcope::test;

namespace {

struct Pair {
  LightField one, three;
};

Pair pair_of(const LightField& colored) {
  LightField one = grey(colored);
  const ViewStack<float> samples = float_samples(one);
  LightField three = make_light_field(
      one.grid(), one.height(), one.width(), 3,
      [&](ViewIndex view, int y, int x, int) { return samples.view(view).at(y, x); });
  return {std::move(one), std::move(three)};
}

const Pair& bars() {
  static const Pair pair = pair_of(*render("bars", 64, 80, {5, 5}).light_field);
  return pair;
}

// Share of the pixels whose disparity is the same to 0.02 px.
double same_share(const Estimate& a, const Estimate& b) {
  const ViewIndex view = a.field.disparity.first();
  const ImageView<const float> one = a.field.disparity.view(view);
  const ImageView<const float> other = b.field.disparity.view(view);
  int same = 0;
  for (int y = 0; y < one.height; ++y) {
    for (int x = 0; x < one.width; ++x) same += std::abs(one.at(y, x) - other.at(y, x)) < 0.02F;
  }
  return same / static_cast<double>(one.height * one.width);
}

}  // namespace

class OneChannelTest : public QObject {
  Q_OBJECT

 private slots:
  void smoothnessWeights_areThoseOfThree();
  void pairWeights_areThoseOfThree();
  void localCaps_areSmallerByTheNorm();
  void gains_areThoseOfThree();
  void estimate_isThatOfThree_data();
  void estimate_isThatOfThree();
};

void OneChannelTest::smoothnessWeights_areThoseOfThree() {
  const ViewIndex view = bars().one.center();

  const Image<float> one = smoothness_weights(bars().one, view, 20, 1e-4);
  const Image<float> three = smoothness_weights(bars().three, view, 20, 1e-4);

  QVERIFY(*std::ranges::min_element(one) < 0.5F);
  QVERIFY(largest_difference(one.view(), three.view()) < 1e-5);
}

void OneChannelTest::pairWeights_areThoseOfThree() {
  const ViewIndex view = bars().one.center();

  const PairWeights one = pair_weights(bars().one, view, 20, 0.01, Progress());
  const PairWeights three = pair_weights(bars().three, view, 20, 0.01, Progress());

  QVERIFY(*std::ranges::min_element(one.across) < 0.5F);
  QVERIFY(largest_difference(one.across.view(), three.across.view()) < 1e-5);
  QVERIFY(largest_difference(one.down.view(), three.down.view()) < 1e-5);
}

void OneChannelTest::localCaps_areSmallerByTheNorm() {
  const ViewIndex view = bars().one.center();
  const Image<float> noise(bars().one.height(), bars().one.width(), 1, 1e-5F);

  const Image<float> one = local_caps(bars().one, view, noise, {}, Progress());
  Image<float> three = local_caps(bars().three, view, noise, {}, Progress());
  for (float& cap : three) cap /= std::sqrt(3.0F);

  QVERIFY(largest_difference(one.view(), three.view()) < 1e-6);
}

// Gains of 0.7 %: too small if two channels that are not there count as alike.
void OneChannelTest::gains_areThoseOfThree() {
  const ViewStack<float> samples = float_samples(bars().one);
  const LightField uneven = like(bars().one, [&](ViewIndex view, int y, int x, int) {
    const float gain =
        view == bars().one.center() ? 1 : 1 + 0.007F * ((view.u + view.v) % 2 == 0 ? 1 : -1);
    return 0.8F * gain * samples.view(view).at(y, x);
  });
  const Pair pair = pair_of(uneven);

  const PhotometricCorrection one = gains_of_means(pair.one, pair.one.center(), Progress());
  const PhotometricCorrection three = gains_of_means(pair.three, pair.three.center(), Progress());

  QVERIFY(three.is_uneven());
  QVERIFY(one.is_uneven());
  for (std::size_t i = 0; i < one.gains.size(); ++i) {
    for (int c = 0; c < 3; ++c) QVERIFY(std::abs(one.gains[i][c] - three.gains[i][c]) < 1e-9);
  }
}

void OneChannelTest::estimate_isThatOfThree_data() {
  QTest::addColumn<QString>("method");
  for (const char* method : {"epi_s", "epi_g", "st_av_l", "st_ch_s", "st_av_g", "plane_pm", "net"}) {
    QTest::newRow(method) << method;
  }
}

void OneChannelTest::estimate_isThatOfThree() {
  QFETCH(QString, method);
  const Estimator& estimator = find_estimator(method.toStdString());
  const RunOptions options{.views = ViewSelection::Center};

  const Estimate one = estimator.run(bars().one, {}, options, Progress());
  const Estimate three = estimator.run(bars().three, {}, options, Progress());

  // Noise is estimated from independent channels, which three equal ones are not.
  QVERIFY2(same_share(one, three) > 0.97, qPrintable(QString::number(same_share(one, three))));
}

}  // namespace episcope::in_one_channel_test

EPISCOPE_TEST(one_channel_test, OneChannelTest)
#include "one_channel_test.moc"
