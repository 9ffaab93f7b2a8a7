// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/maps/padding.h"
#include "engine/core/error.h"
#include "engine/io/arrays/npy_file.h"
#include "engine/io/maps/foreign_result.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

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

  void npyResult_isRead() {
    const QTemporaryDir folder;
    const auto path = std::filesystem::path(folder.path().toStdString()) / "disparity.npy";
    std::vector<float> samples(3 * 5 * 4 * 6);
    std::iota(samples.begin(), samples.end(), 0.0F);
    samples[7] = std::numeric_limits<float>::infinity();

    io::write_npy<float>(path, {3, 5, 4, 6}, samples);
    const DisparityField all = io::read_disparity_map(path, {3, 5});
    QVERIFY_EXCEPTION_THROWN((void)io::read_disparity_map(path, {5, 3}), IoError);
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
