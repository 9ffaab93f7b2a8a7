// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/ordering_terms.h"
#include "tests/test_main.h"

#include <cmath>
#include <random>

namespace episcope::in_ordering_terms_test {

namespace {

constexpr int kHeight = 13, kWidth = 17;

Image<float> noise(unsigned seed, float scale) {
  Image<float> image(kHeight, kWidth);
  std::mt19937 random(seed);
  std::normal_distribution<float> normal(0, scale);
  for (float& value : image) value = normal(random);
  return image;
}

double dot(const Image<float>& a, const Image<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isfinite(a.data()[i])) sum += static_cast<double>(a.data()[i]) * b.data()[i];
  }
  return sum;
}

// Σ ψ(Du) over all lines that stay within the image.
double ordering_energy(const Image<float>& slopes, const Image<float>& from, const Image<float>& to,
                       LineStep step, const OrderingPenalty& penalty) {
  Image<float> differences(kHeight, kWidth);
  line_differences(slopes, from, to, step, differences.view());
  double sum = 0;
  for (const float a : differences) {
    if (std::isnan(a)) continue;
    const float stiffness = penalty.fall / penalty.softness;
    const float slope = std::clamp(a * stiffness, -penalty.fall, penalty.rise);
    sum += slope * a - 0.5F * slope * slope / stiffness;
  }
  return sum;
}

void add_directions() {
  QTest::addColumn<bool>("vertical");
  QTest::addColumn<float>("step");
  for (const bool vertical : {false, true}) {
    for (const float step : {-2.0F, -1.0F, 1.0F}) {
      QTest::addRow("%s %g", vertical ? "vertical" : "horizontal", static_cast<double>(step))
          << vertical << step;
    }
  }
}

LineStep fetched() {
  QFETCH(bool, vertical);
  QFETCH(float, step);
  return {vertical, step};
}

}  // namespace

class OrderingTermsTest : public QObject {
  Q_OBJECT

 private slots:
  void shiftedImage_hasNoDifference();
  void lineBeyondTheImage_isLeftOut();
  void pull_isTheSlopeOfTheEnergy_data() { add_directions(); }
  void pull_isTheSlopeOfTheEnergy();
  void pull_boundsTheEnergy_data() { add_directions(); }
  void pull_boundsTheEnergy();
  void followingThePull_lowersTheEnergy_data() { add_directions(); }
  void followingThePull_lowersTheEnergy();
};

// A ramp moved by its lines is met by them exactly, also between pixels.
void OrderingTermsTest::shiftedImage_hasNoDifference() {
  Image<float> slopes(kHeight, kWidth, 1, 0.4F), from(kHeight, kWidth), to(kHeight, kWidth);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      from.at(y, x) = 0.1F * static_cast<float>(x);
      to.at(y, x) = 0.1F * (static_cast<float>(x) - 0.4F);
    }
  }
  Image<float> difference(kHeight, kWidth);
  line_differences(slopes, from, to, {false, 1}, difference.view());
  for (int x = 0; x + 1 < kWidth; ++x) QVERIFY(std::fabs(difference.at(5, x)) < 1e-6F);
}

void OrderingTermsTest::lineBeyondTheImage_isLeftOut() {
  const Image<float> slopes(kHeight, kWidth, 1, 1.0F), from(kHeight, kWidth),
      to(kHeight, kWidth, 1, 2.0F);
  Image<float> difference(kHeight, kWidth);
  line_differences(slopes, from, to, {true, 1}, difference.view());
  for (int x = 0; x < kWidth; ++x) {
    QVERIFY(std::isnan(difference.at(kHeight - 1, x)));
    QCOMPARE(difference.at(kHeight - 2, x), 2.0F);
  }
}

void OrderingTermsTest::pull_isTheSlopeOfTheEnergy() {
  const LineStep step = fetched();
  const OrderingPenalty penalty{0.02F, 0.5F, 0.05F};
  const Image<float> slopes = noise(1, 2), from = noise(2, 0.2F), to = noise(3, 0.2F);
  Image<float> curvature(kHeight, kWidth), of_from(kHeight, kWidth), of_to(kHeight, kWidth);
  add_pull_on_from(slopes, from, to, step, penalty, {curvature.view(), of_from.view()});
  add_pull_on_to(slopes, from, to, step, penalty, {curvature.view(), of_to.view()});
  for (std::size_t i = 0; i < from.size(); i += 3) {
    const auto slope = [&](bool on_from) {
      double energy[2];
      for (const int side : {0, 1}) {
        Image<float> moved = on_from ? from : to;
        moved.data()[i] += side == 0 ? -1e-3F : 1e-3F;
        energy[side] = on_from ? ordering_energy(slopes, moved, to, step, penalty)
                               : ordering_energy(slopes, from, moved, step, penalty);
      }
      return (energy[1] - energy[0]) / 2e-3;
    };
    // The penalty bends within a step: by 10·1e-3 for each line that ends there.
    QVERIFY(std::fabs(slope(true) + of_from.data()[i]) < 0.01);
    QVERIFY(std::fabs(slope(false) + of_to.data()[i]) < 0.02);
  }
}

void OrderingTermsTest::pull_boundsTheEnergy() {
  const LineStep step = fetched();
  const OrderingPenalty penalty{0.02F, 0.5F, 0.05F};
  const Image<float> slopes = noise(1, 2), from = noise(2, 0.2F), to = noise(3, 0.2F);
  const double before = ordering_energy(slopes, from, to, step, penalty);
  for (const bool on_from : {true, false}) {
    Image<float> curvature(kHeight, kWidth), force(kHeight, kWidth);
    const OrderingPull pull{curvature.view(), force.view()};
    if (on_from) {
      add_pull_on_from(slopes, from, to, step, penalty, pull);
    } else {
      add_pull_on_to(slopes, from, to, step, penalty, pull);
    }
    for (unsigned seed = 10; seed < 30; ++seed) {
      const Image<float> change = noise(seed, 0.01F * static_cast<float>(seed));
      Image<float> moved = on_from ? from : to;
      double bound = before - dot(force, change);
      for (std::size_t i = 0; i < moved.size(); ++i) {
        const double d = change.data()[i];
        moved.data()[i] += change.data()[i];
        bound += 0.5 * curvature.data()[i] * d * d;
      }
      const double after = on_from ? ordering_energy(slopes, moved, to, step, penalty)
                                   : ordering_energy(slopes, from, moved, step, penalty);
      QVERIFY2(after <= bound + 1e-4, qPrintable(QString("%1 > %2").arg(after).arg(bound)));
    }
  }
}

void OrderingTermsTest::followingThePull_lowersTheEnergy() {
  const LineStep step = fetched();
  const OrderingPenalty penalty{0.02F, 0.5F, 0.05F};
  const Image<float> slopes = noise(1, 2);
  Image<float> from = noise(2, 0.2F);
  const Image<float> to = noise(3, 0.2F);
  double before = ordering_energy(slopes, from, to, step, penalty);
  const double first = before;
  for (int i = 0; i < 10; ++i) {
    Image<float> curvature(kHeight, kWidth), force(kHeight, kWidth);
    add_pull_on_from(slopes, from, to, step, penalty, {curvature.view(), force.view()});
    for (std::size_t n = 0; n < from.size(); ++n) {
      if (curvature.data()[n] > 0) from.data()[n] += force.data()[n] / curvature.data()[n];
    }
    const double after = ordering_energy(slopes, from, to, step, penalty);
    QVERIFY(after <= before + 1e-6);
    before = after;
  }
  QVERIFY(before < 0.1 * first);
}

}  // namespace episcope::in_ordering_terms_test

EPISCOPE_TEST(ordering_terms_test, OrderingTermsTest)
#include "ordering_terms_test.moc"
