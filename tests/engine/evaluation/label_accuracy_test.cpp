// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/evaluation/label_quality.h"
#include "tests/test_main.h"

#include <algorithm>

namespace episcope::in_label_accuracy_test {

namespace {

Image<std::int32_t> row(std::initializer_list<std::int32_t> labels) {
  Image<std::int32_t> image(1, static_cast<int>(labels.size()));
  std::copy(labels.begin(), labels.end(), image.data());
  return image;
}

}  // namespace

class LabelAccuracyTest : public QObject {
  Q_OBJECT

 private slots:
  void shares_areThoseOfJudgedPixels();
  void otherSizes_areRefused();
  void viewsThatBothCover_areJudged();
  void labelsOfAnotherNumbering_areMatched();
};

void LabelAccuracyTest::shares_areThoseOfJudgedPixels() {
  const auto truth = row({1, 1, 1, 2, 2, 0, 3});
  const auto given = row({1, 1, 2, 2, 1, 1, 3});

  const LabelAccuracy accuracy = judge_labels(given.view(), truth.view());

  QCOMPARE(accuracy.judged(), 6);  // 0 = no true label
  QCOMPARE(accuracy.share().value(), 4.0 / 6);
  QCOMPARE(accuracy.share(1).value(), 2.0 / 3);
  QCOMPARE(accuracy.share(2).value(), 0.5);
  QVERIFY(!accuracy.share(9));
  QCOMPARE(accuracy.confusion.at({1, 2}), 1);
}

void LabelAccuracyTest::otherSizes_areRefused() {
  const auto truth = row({1, 1});
  const auto given = row({1});

  QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)judge_labels(given.view(), truth.view()));
}

void LabelAccuracyTest::viewsThatBothCover_areJudged() {
  ViewStack<std::int32_t> truth({2, 2}, 1, 3);
  std::fill_n(truth.data(), truth.size(), 5);
  ViewStack<std::int32_t> given({1, 1}, 1, 3, 1, {1, 1});
  std::fill_n(given.data(), given.size(), 5);
  given.view({1, 1}).at(0, 0) = 6;

  const LabelAccuracy accuracy = judge_labels(given, truth);

  QCOMPARE(accuracy.judged(), 3);
  QCOMPARE(accuracy.share().value(), 2.0 / 3);
  QVERIFY(!judge_labels(given, {}).share());
}

void LabelAccuracyTest::labelsOfAnotherNumbering_areMatched() {
  const auto truth = row({5, 5, 5, 5, 2, 2, 2, 1});
  const auto given = row({1, 1, 1, 2, 2, 2, 2, 1});
  const LabelAccuracy accuracy = judge_labels(given.view(), truth.view());

  const LabelMatch by_overlap = match_labels(accuracy, {{1, "a"}, {2, "b"}}, {});
  QCOMPARE(by_overlap.true_of, (std::map<std::int32_t, std::int32_t>{{1, 5}, {2, 2}}));
  QVERIFY(by_overlap.is_by_overlap);
  QCOMPARE(accuracy.matched(by_overlap).share().value(), 6.0 / 8);

  const LabelMatch by_name =
      match_labels(accuracy, {{1, "tree"}, {2, "house"}}, {{2, "tree"}, {5, "house"}});
  QCOMPARE(by_name.true_of, (std::map<std::int32_t, std::int32_t>{{1, 2}, {2, 5}}));
  QVERIFY(!by_name.is_by_overlap);
  QCOMPARE(accuracy.matched(by_name).share().value(), 1.0 / 8);
}

}  // namespace episcope::in_label_accuracy_test

EPISCOPE_TEST(label_accuracy_test, LabelAccuracyTest)
#include "label_accuracy_test.moc"
