// SPDX-License-Identifier: BSD-3-Clause
#include "tests/accuracy/means.h"
#include "tests/test_main.h"

#include <cmath>

namespace episcope::in_means_test {

namespace {

accuracy::Measurement measured(const char* group, const char* method, double mse, double badpix) {
  accuracy::Measurement measurement;
  measurement.group = group;
  measurement.method = method;
  measurement.mse_100 = mse;
  measurement.mse_100_inset15 = mse / 2;
  measurement.badpix_0070 = badpix;
  return measurement;
}

}  // namespace

class MeansTest : public QObject {
  Q_OBJECT

 private slots:
  void means_areOfEachGroupAndMethod() {
    const std::vector<accuracy::Mean> means =
        accuracy::means_of({measured("a", "x", 1, 10), measured("a", "y", 5, 0),
                            measured("a", "x", 4, 20), measured("b", "x", 0, 0)},
                           "all");

    QCOMPARE(means.size(), std::size_t{5});
    QCOMPARE(means[0].group, std::string("a"));
    QCOMPARE(means[0].scenes, 2);
    QVERIFY(std::abs(means[0].geometric_mse_100 - 2) < 1e-12);
    QVERIFY(std::abs(means[0].geometric_mse_100_inset15 - 1) < 1e-12);
    QCOMPARE(means[0].mse_100, 2.5);
    QCOMPARE(means[0].badpix_0070, 15.0);
    QCOMPARE(means[3].group, std::string("all"));
    QCOMPARE(means[3].scenes, 3);
    // A scene without error counts as one of 0.001.
    QVERIFY(std::abs(means[3].geometric_mse_100 - std::cbrt(0.004)) < 1e-12);
  }
};

}  // namespace episcope::in_means_test

EPISCOPE_TEST(means_test, MeansTest)
#include "means_test.moc"
