// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/npy.h"
#include "engine/io/models/external_result.h"
#include "engine/io/models/map_padding.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <algorithm>
#include <limits>
#include <numeric>

namespace episcope::in_padding_test {

namespace {

/// A ramp of 6×7 px at a place of a map of 10×11 px.
DisparityField padded(int top, int left, float around) {
  DisparityField field;
  field.disparity = ViewStack<float>({1, 1}, 10, 11);
  std::fill_n(field.disparity.data(), field.disparity.size(), around);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 7; ++x) {
      field.disparity.view({0, 0}).at(top + y, left + x) = static_cast<float>(10 * y + x) + 1;
    }
  }
  io::mark_invalid(field);
  return field;
}

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

/// 40×48 px without two neighbors alike within a frame.
DisparityField ramp_in_frame(int frame, float value) {
  DisparityField field;
  field.disparity = ViewStack<float>({1, 1}, 40, 48);
  std::fill_n(field.disparity.data(), field.disparity.size(), value);
  for (int y = frame; y < 40 - frame; ++y) {
    for (int x = frame; x < 48 - frame; ++x) {
      field.disparity.view({0, 0}).at(y, x) = static_cast<float>(48 * y + x + 1);
    }
  }
  return field;
}

}  // namespace

class PaddingTest : public QObject {
  Q_OBJECT

 private slots:
  void evidentPadding_isRemoved_data() {
    QTest::addColumn<int>("top");
    QTest::addColumn<int>("left");
    QTest::addColumn<float>("around");
    QTest::newRow("zero on all sides") << 2 << 2 << 0.0F;
    QTest::newRow("NaN on all sides") << 2 << 2 << std::numeric_limits<float>::quiet_NaN();
    QTest::newRow("constant right and below") << 0 << 0 << 7.5F;
  }
  void evidentPadding_isRemoved() {
    QFETCH(int, top);
    QFETCH(int, left);
    QFETCH(float, around);
    DisparityField field = padded(top, left, around);

    const std::string note = io::remove_padding(field, 6, 7);

    QVERIFY(!note.empty());
    QCOMPARE(field.disparity.height(), 6);
    QCOMPARE(field.disparity.width(), 7);
    QCOMPARE(field.disparity.view({0, 0}).at(0, 0), 1.0F);
    QCOMPARE(field.disparity.view({0, 0}).at(5, 6), 57.0F);
  }

  // Half of one is none, on all sides as on the right and below.
  void paddingOfOne_isRemoved_data() {
    QTest::addColumn<int>("height");
    QTest::addColumn<int>("width");
    QTest::newRow("row and column") << 9 << 10;
    QTest::newRow("row") << 9 << 11;
    QTest::newRow("column") << 10 << 10;
  }
  void paddingOfOne_isRemoved() {
    QFETCH(int, height);
    QFETCH(int, width);
    DisparityField field;
    field.disparity = ViewStack<float>({1, 1}, 10, 11);
    std::fill_n(field.disparity.data(), field.disparity.size(), 0.0F);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        field.disparity.view({0, 0}).at(y, x) = static_cast<float>(10 * y + x + 1);
      }
    }

    const std::string note = io::remove_padding(field, height, width);

    QVERIFY2(note.find("on the right and below") != std::string::npos, note.c_str());
    QCOMPARE(field.disparity.height(), height);
    QCOMPARE(field.disparity.width(), width);
    QCOMPARE(field.disparity.view({0, 0}).at(0, 0), 1.0F);
  }

  void doubtfulPadding_isKept() {
    DisparityField elsewhere = padded(1, 3, 0);
    DisparityField flat = padded(2, 2, 0);
    std::fill_n(flat.disparity.data(), flat.disparity.size(), 1.0F);
    DisparityField smaller = padded(2, 2, 0);

    QVERIFY(io::remove_padding(elsewhere, 6, 7).empty());
    QVERIFY(io::remove_padding(flat, 6, 7).empty());
    QVERIFY(io::remove_padding(smaller, 20, 20).empty());
    QCOMPARE(elsewhere.disparity.height(), 10);
  }

  // As convolutions without padding leave them.
  void smallerMaps_areTheMiddle() {
    DisparityField field;
    field.disparity = ViewStack<float>({1, 2}, 26, 30);
    field.disparity.view({0, 1}).at(0, 29) = 3;
    field.disparity.view({0, 1}).at(25, 0) = kNone;
    io::mark_invalid(field);

    const io::BareBorder border = io::find_bare_border(field, 32, 36);

    QCOMPARE(border.width_px, 3);
    QVERIFY(!border.note.empty());
    QCOMPARE(field.disparity.height(), 32);
    QCOMPARE(field.disparity.width(), 36);
    const DisparityView map = field.view({0, 1});
    QCOMPARE(map.disparity.at(3, 32), 3.0F);
    QVERIFY(map.is_valid(3, 32) && !map.is_valid(2, 32) && !map.is_valid(3, 33));
    QVERIFY(!map.is_valid(28, 3));
  }

  void smallerMapsElsewhere_stay_data() {
    QTest::addColumn<int>("height");
    QTest::addColumn<int>("width");
    QTest::newRow("odd") << 33 << 37;
    QTest::newRow("unequal") << 32 << 34;
    QTest::newRow("far too small") << 52 << 56;
    QTest::newRow("larger") << 24 << 28;
    QTest::newRow("in one direction") << 26 << 34;
  }
  void smallerMapsElsewhere_stay() {
    QFETCH(int, height);
    QFETCH(int, width);
    DisparityField field;
    field.disparity = ViewStack<float>({1, 1}, 26, 30);

    QCOMPARE(io::find_bare_border(field, height, width).width_px, 0);
    QCOMPARE(field.disparity.height(), 26);
  }

  void frameOfOneValue_isPadding_data() {
    QTest::addColumn<float>("value");
    QTest::addColumn<int>("frame");
    QTest::addColumn<int>("expected");
    QTest::newRow("zeros") << 0.0F << 3 << 3;
    QTest::newRow("another value") << -1.5F << 5 << 5;
    QTest::newRow("one pixel") << 0.0F << 1 << 0;
    QTest::newRow("too wide") << 0.0F << 7 << 0;
    QTest::newRow("none") << 0.0F << 0 << 0;
  }
  void frameOfOneValue_isPadding() {
    QFETCH(float, value);
    QFETCH(int, frame);
    QFETCH(int, expected);
    DisparityField field = ramp_in_frame(frame, value);

    const io::BareBorder border = io::find_bare_border(field, 40, 48);

    QCOMPARE(border.width_px, expected);
    QCOMPARE(border.note.empty(), expected == 0);
    const DisparityView map = field.view({0, 0});
    QCOMPARE(map.is_valid(0, 0), expected == 0);
    QVERIFY(map.is_valid(frame, frame) && map.is_valid(20, 20));
    QCOMPARE(map.is_valid(39 - std::max(0, expected - 1), 20), expected == 0);
  }

  // The wall behind an object goes on within.
  void plainBackground_isNoPadding() {
    DisparityField field = ramp_in_frame(3, 0);
    for (int x = 3; x < 10; ++x) field.disparity.view({0, 0}).at(3, x) = 0;
    for (int x = 3; x < 20; ++x) field.disparity.view({0, 0}).at(36, x) = 0;
    DisparityField flat = ramp_in_frame(20, 0);

    QCOMPARE(io::find_bare_border(field, 40, 48).width_px, 0);
    QCOMPARE(io::find_bare_border(flat, 40, 48).width_px, 0);
    QVERIFY(field.valid.empty() && flat.valid.empty());
  }

  void npyResult_isRead() {
    const QTemporaryDir folder;
    const auto path = std::filesystem::path(folder.path().toStdString()) / "disparity.npy";
    std::vector<float> samples(3 * 5 * 4 * 6);
    std::iota(samples.begin(), samples.end(), 0.0F);
    samples[7] = std::numeric_limits<float>::infinity();

    io::write_npy<float>(path, {3, 5, 4, 6}, samples);
    const DisparityField all = io::read_disparity_map(path, {3, 5});
    QVERIFY_THROWS_EXCEPTION(IoError, (void)io::read_disparity_map(path, {5, 3}));
    io::write_npy<float>(path, {4, 6}, std::span(samples).first(24));
    const DisparityField one = io::read_disparity_map(path, {3, 5});

    QCOMPARE(all.disparity.view({2, 4}).at(3, 5), samples.back());
    QVERIFY(!all.view({0, 0}).is_valid(1, 1));
    QCOMPARE(one.disparity.first(), (ViewIndex{1, 2}));
  }
};

}  // namespace episcope::in_padding_test

EPISCOPE_TEST(padding_test, PaddingTest)
#include "padding_test.moc"
