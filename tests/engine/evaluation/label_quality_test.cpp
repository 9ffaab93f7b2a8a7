// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/label_quality.h"
#include "tests/test_main.h"

namespace episcope::in_label_quality_test {

namespace {

// Label 1 with a bar of label 2 in columns [begin, end).
Image<std::int32_t> bar(int begin, int end) {
  Image<std::int32_t> labels(24, 32);
  for (int y = 0; y < labels.height(); ++y) {
    for (int x = 0; x < labels.width(); ++x) labels.at(y, x) = x >= begin && x < end ? 2 : 1;
  }
  return labels;
}

}  // namespace

class LabelQualityTest : public QObject {
  Q_OBJECT

 private slots:
  void means_weighLabelsAlike() {
    const auto truth = bar(24, 32);
    const auto given = bar(28, 32);

    const LabelAccuracy accuracy = judge_labels(given.view(), truth.view());

    QCOMPARE(accuracy.mean_share().value(), (1 + 0.5) / 2);
    QCOMPARE(accuracy.overlap(1).value(), 24.0 / 28);
    QCOMPARE(accuracy.overlap(2).value(), 0.5);
    QCOMPARE(accuracy.mean_overlap().value(), (24.0 / 28 + 0.5) / 2);
    QVERIFY(!accuracy.overlap(3));
    QVERIFY(!LabelAccuracy{}.mean_overlap());
  }

  void boundaries_areJudgedAlone() {
    // All wrong pixels lie within 3 px of the edge at column 16: 4 of its 6 columns are right.
    const LabelQuality quality = judge_label_quality(bar(18, 32).view(), bar(16, 32).view());

    QCOMPARE(quality.boundaries.judged(), 24 * 6);
    QCOMPARE(quality.boundaries.share().value(), 4.0 / 6);
    QCOMPARE(quality.all.share().value(), 30.0 / 32);
  }

  void thinLabels_areThoseOfFourPixelsAtMost_data() {
    QTest::addColumn<int>("width");
    QTest::addColumn<bool>("is_thin");
    QTest::newRow("1 px") << 1 << true;
    QTest::newRow("4 px") << 4 << true;
    QTest::newRow("5 px") << 5 << false;
  }
  void thinLabels_areThoseOfFourPixelsAtMost() {
    QFETCH(int, width);
    QFETCH(bool, is_thin);
    const auto truth = bar(10, 10 + width);

    const LabelQuality quality = judge_label_quality(bar(10, 11).view(), truth.view());

    QCOMPARE(quality.thin_overlap().has_value(), is_thin);
    if (is_thin) QCOMPARE(quality.thin_overlap().value(), 1.0 / width);
  }
};

}  // namespace episcope::in_label_quality_test

EPISCOPE_TEST(label_quality_test, LabelQualityTest)
#include "label_quality_test.moc"
