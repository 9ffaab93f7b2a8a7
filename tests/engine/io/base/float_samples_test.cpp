// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/sample_range.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace episcope::in_float_samples_test {

namespace {

using Value = std::function<float(std::mt19937&)>;

LightField::Samples samples_of(const Value& value) {
  std::mt19937 random(3);
  ViewStack<float> stack({3, 3}, 40, 50, 3);
  std::generate_n(stack.data(), stack.size(), [&] { return value(random); });
  return stack;
}

float uniform(std::mt19937& random, float low, float high) {
  return std::uniform_real_distribution<float>(low, high)(random);
}

// What a sample was divided by.
double divisor_of(const Value& value, ConventionReport& report) {
  LightField::Samples samples = samples_of(value);
  const LightField::Samples before = samples_of(value);
  io::scale_float_samples(samples, report);
  const auto& a = std::get<ViewStack<float>>(before);
  const auto& b = std::get<ViewStack<float>>(samples);
  const std::size_t i = std::max_element(a.data(), a.data() + a.size()) - a.data();
  // A float has seven places.
  return std::round(100 * a.data()[i] / b.data()[i]) / 100.0;
}

}  // namespace

class FloatSamplesTest : public QObject {
  Q_OBJECT

 private slots:
  void unitSamples_stay() {
    ConventionReport report;
    QCOMPARE(divisor_of([](auto& r) { return uniform(r, 0, 1.2F); }, report), 1.0);
    QVERIFY(report.warnings.empty());
  }

  void nonfiniteSamples_makeTheirPixelsInvalid() {
    LightField::Samples samples = samples_of([](auto& r) { return uniform(r, 0, 1); });
    auto& stack = std::get<ViewStack<float>>(samples);
    stack.view({1, 2}).at(3, 4, 1) = std::nanf("");
    stack.view({2, 0}).at(39, 49, 0) = INFINITY;
    ViewStack<std::uint8_t> valid;
    ConventionReport report;

    io::drop_nonfinite_samples(samples, valid, report);

    QCOMPARE(std::count(valid.data(), valid.data() + valid.size(), std::uint8_t{0}), 2);
    QVERIFY(valid.view({1, 2}).at(3, 4) == 0 && valid.view({2, 0}).at(39, 49) == 0);
    QCOMPARE(stack.view({1, 2}).at(3, 4, 1), 0.0F);
    QCOMPARE(report.warnings.size(), 1U);
  }

  void wholeNumbers_areSamplesOfBytesOrWords() {
    ConventionReport bytes, dark, words;
    QCOMPARE(divisor_of([](auto& r) { return std::floor(uniform(r, 0, 256)); }, bytes), 255.0);
    // However dark they are.
    QCOMPARE(divisor_of([](auto& r) { return std::floor(uniform(r, 0, 5)); }, dark), 255.0);
    QCOMPARE(divisor_of([](auto& r) { return std::floor(uniform(r, 0, 60000)); }, words), 65535.0);
    QVERIFY(words.samples.find("16 bits") != std::string::npos);
  }

  void resampledBytes_areSamplesOfBytes() {
    ConventionReport report;
    QCOMPARE(divisor_of([](auto& r) { return uniform(r, 0, 250); }, report), 255.0);
    QVERIFY(report.samples.find("8 bits") != std::string::npos);
  }

  void linearSamplesWithHighlights_areScaledByTheirBulk() {
    // Log-normal, as the radiance of scenes; the brightest reach 100.
    const Value radiance = [](auto& r) {
      return std::min(100.0F, 0.3F * std::exp(1.2F * std::normal_distribution<float>()(r)));
    };
    ConventionReport report;

    const double divisor = divisor_of(radiance, report);

    // The quantile of 99.9 % is 0.3·exp(1.2·3.09); known to some percent from 18,000 samples.
    QVERIFY2(std::abs(divisor / (0.3 * std::exp(1.2 * 3.09)) - 1) < 0.25,
             qPrintable(QString::number(divisor)));
    QVERIFY2(report.samples.find("taken as linear") != std::string::npos, report.samples.c_str());
    QCOMPARE(report.warnings.size(), std::size_t{1});
  }

  void fewHighlights_changeNothing() {
    const Value glint = [](auto& r) {
      return uniform(r, 0, 1) < 2e-4F ? 10.0F : uniform(r, 0, 0.8F);
    };
    ConventionReport report;

    const double divisor = divisor_of(glint, report);

    QCOMPARE(divisor, 1.0);
    QVERIFY2(report.samples.find("up to 10") != std::string::npos, report.samples.c_str());
  }

  void noiseAroundBlack_isNoRangeAroundZero_data() {
    QTest::addColumn<float>("white");
    QTest::newRow("to 1") << 1.0F;
    QTest::newRow("highlights to 1.3") << 1.3F;
  }
  void noiseAroundBlack_isNoRangeAroundZero() {
    QFETCH(float, white);
    // A third is black, as by a dark frame that was taken from all, with read noise.
    const Value dark = [=](auto& r) {
      const float noise = 0.04F * std::normal_distribution<float>()(r);
      const float light = uniform(r, 0, 3) < 1 ? 0 : uniform(r, 0, white);
      return std::min(white, light + noise);
    };
    ConventionReport report;

    const double divisor = divisor_of(dark, report);

    QCOMPARE(divisor, 1.0);
    QVERIFY2(report.warnings.front().find("noise around black") != std::string::npos,
             report.warnings.front().c_str());
  }

  void brightViewsAroundZero_areNotTakenForNoise() {
    // Of -1 … 1, with a smooth shadow that reaches -0.3.
    ViewStack<float> stack({3, 3}, 40, 50, 3);
    for (std::size_t i = 0; i < stack.size(); ++i) {
      const double x = static_cast<double>(i / 3 % 50) / 49;
      stack.data()[i] = static_cast<float>(1.3 * x * x - 0.3);
    }
    LightField::Samples samples = std::move(stack);
    ConventionReport report;

    io::scale_float_samples(samples, report);

    QVERIFY2(report.samples.find("around 0") != std::string::npos, report.samples.c_str());
  }

  void integers_stay() {
    ViewStack<std::uint16_t> stack({1, 1}, 4, 4, 1);
    std::fill_n(stack.data(), stack.size(), std::uint16_t{4000});
    LightField::Samples samples = std::move(stack);
    ConventionReport report;

    io::scale_float_samples(samples, report);

    QCOMPARE(int(std::get<ViewStack<std::uint16_t>>(samples).data()[0]), 4000);
    QVERIFY(report.samples.empty());
  }
};

}  // namespace episcope::in_float_samples_test

EPISCOPE_CORE_TEST(float_samples_test, FloatSamplesTest)
#include "float_samples_test.moc"
