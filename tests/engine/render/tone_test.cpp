// SPDX-License-Identifier: BSD-3-Clause

#include "engine/render/shade.h"
#include "tests/test_main.h"

#include <cmath>
#include <limits>

namespace episcope::in_tone_test {

using namespace render;

namespace {

// Grey ramp from 0 to `brightest` along the columns; one view of 10×101 pixels.
LightField ramp(float brightest) {
  ViewStack<float> samples({1, 1}, 10, 101, 1);
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 101; ++x) {
      samples.data()[y * 101 + x] = brightest * static_cast<float>(x) / 100;
    }
  }
  return {std::move(samples), LightFieldInfo()};
}

}  // namespace

class ToneTest : public QObject {
  Q_OBJECT

 private slots:
  void plainTone_changesNothing();
  void eachStop_doublesTheBrightness();
  void gamma_keepsBlackAndWhite();
  void blackPoint_isBlackAndWhiteStays();
  void automaticTone_spansBlackToWhite();
  void automaticTone_ofOneBrightnessIsPlain();
  void darkness_isToldByTheMiddle();
  void samplesThatAreNoNumbers_areBlack();
};

void ToneTest::plainTone_changesNothing() {
  const ToneTable table{Tone()};
  for (int i = 0; i < 256; ++i) QCOMPARE(table(static_cast<std::uint8_t>(i)), i);
  const LightField lf = ramp(0.7F);
  QVERIFY(shade_view(lf, {0, 0}).size() == shade_view(lf, {0, 0}, &table).size());
  for (int x = 0; x < 101; ++x) {
    QCOMPARE(shade_view(lf, {0, 0}, &table).at(3, x), shade_view(lf, {0, 0}).at(3, x));
  }
}

void ToneTest::eachStop_doublesTheBrightness() {
  QCOMPARE(ToneTable({.exposure = 1})(std::uint8_t{50}), 100);
  QCOMPARE(ToneTable({.exposure = 3})(std::uint8_t{10}), 80);
  QCOMPARE(ToneTable({.exposure = -1})(std::uint8_t{200}), 100);
  QCOMPARE(ToneTable({.exposure = 1})(std::uint8_t{200}), 255);
}

void ToneTest::gamma_keepsBlackAndWhite() {
  const ToneTable table({.gamma = 2});
  QCOMPARE(table(0.0F), 0);
  QCOMPARE(table(1.0F), 255);
  QCOMPARE(table(0.25F), 128);  // √0.25
}

void ToneTest::blackPoint_isBlackAndWhiteStays() {
  const ToneTable table({.black = 0.2});
  QCOMPARE(table(0.2F), 0);
  QCOMPARE(table(0.1F), 0);
  QVERIFY(std::abs(table(0.6F) - 127.5) <= 0.5);  // halfway, rounded
  QCOMPARE(table(1.0F), 255);
}

void ToneTest::automaticTone_spansBlackToWhite() {
  const LightField lf = ramp(0.125F);
  const Tone tone = automatic_tone(lf, {0, 0});
  const ToneTable table(tone);

  QVERIFY(std::abs(tone.exposure - 3) < 0.05);
  QVERIFY(table(0.125F) == 255 && table(0.0F) == 0);
  const Image<std::uint8_t> picture = shade_view(lf, {0, 0}, &table);
  QVERIFY(picture.at(5, 50) > 85);
}

void ToneTest::automaticTone_ofOneBrightnessIsPlain() {
  ViewStack<float> samples({1, 1}, 4, 4, 1);
  std::fill_n(samples.data(), samples.size(), 0.3F);
  QVERIFY(automatic_tone({std::move(samples), LightFieldInfo()}, {0, 0}).is_plain());
}

void ToneTest::darkness_isToldByTheMiddle() {
  QVERIFY(is_dark(ramp(0.2F), {0, 0}));
  QVERIFY(!is_dark(ramp(0.5F), {0, 0}));
}

void ToneTest::samplesThatAreNoNumbers_areBlack() {
  QCOMPARE(ToneTable({.exposure = 2})(std::numeric_limits<float>::quiet_NaN()), 0);
  QCOMPARE(ToneTable({.exposure = 2})(-1.0F), 0);
  QCOMPARE(ToneTable({.exposure = -1})(7.0F), 128);
}

}  // namespace episcope::in_tone_test

EPISCOPE_TEST(tone_test, ToneTest)
#include "tone_test.moc"
