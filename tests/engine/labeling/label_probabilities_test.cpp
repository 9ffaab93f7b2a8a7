// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/ray_labeling.h"

#include "engine/core/error.h"
#include "tests/test_main.h"

#include <array>

namespace episcope::in_label_probabilities_test {

class LabelProbabilitiesTest : public QObject {
  Q_OBJECT

 private slots:
  void mostProbable_isTheLargest_andTheLowestOfEquals();
  void mostProbable_refusesOtherCountsOfIds();
  void uncertainty_isZeroForOneLabel_andOneForEqualOnes();
  void stack_findsViewsByTheirPlaceInTheGrid();

 private:
  /// One row of three pixels with three layers.
  std::array<std::uint8_t, 9> bytes_{255, 80, 85,  //
                                     0,   80, 85,  //
                                     0,   95, 85};
  VolumeView<const std::uint8_t> row_{bytes_.data(), 1, 3, 3};
};

void LabelProbabilitiesTest::mostProbable_isTheLargest_andTheLowestOfEquals() {
  const auto labels = most_probable_labels(row_, {2, 5, 9});

  QCOMPARE(labels.at(0, 0), 2);
  QCOMPARE(labels.at(0, 1), 9);
  QCOMPARE(labels.at(0, 2), 2);
}

void LabelProbabilitiesTest::mostProbable_refusesOtherCountsOfIds() {
  QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)most_probable_labels(row_, {1, 2}));
}

void LabelProbabilitiesTest::uncertainty_isZeroForOneLabel_andOneForEqualOnes() {
  const auto uncertainty = label_uncertainty(row_);

  QCOMPARE(uncertainty.at(0, 0), 0.F);
  QVERIFY(uncertainty.at(0, 1) > 0.98F && uncertainty.at(0, 1) < 1.F);
  QVERIFY(uncertainty.at(0, 2) > 0.99999F && uncertainty.at(0, 2) <= 1.F);
}

void LabelProbabilitiesTest::stack_findsViewsByTheirPlaceInTheGrid() {
  LabelProbabilities stack{{1}, {1, 2}, {3, 4}, {}};
  stack.views.emplace_back(1, 1, 1);
  stack.views.emplace_back(1, 1, 1);

  QVERIFY(!stack.contains({0, 0}));
  QVERIFY(stack.contains({3, 5}));
  QCOMPARE(&stack.view({3, 5}), &stack.views[1]);
}

}  // namespace episcope::in_label_probabilities_test

EPISCOPE_TEST(label_probabilities_test, LabelProbabilitiesTest)
#include "label_probabilities_test.moc"
