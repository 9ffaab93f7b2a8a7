// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/output.h"
#include "tests/test_main.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace episcope::in_json_test {

using namespace episcope::cli;

class JsonTest : public QObject {
  Q_OBJECT
 private slots:
  void interval_hasNoDigitsBeyondSinglePrecision() {
    const auto end = [](double value) { return interval_json({value, 2}).front().get<double>(); };
    QCOMPARE(end(static_cast<double>(1.2F)), 1.2);
    QCOMPARE(end(static_cast<double>(-0.1F)), -0.1);
    QCOMPARE(end(0.5), 0.5);
    QVERIFY(end(-0.6999999999999993) == -0.7);
    const double third = 1.0 / 3;  // no single: all digits count
    QVERIFY(end(third) == third);
    QVERIFY(std::isinf(end(INFINITY)));
  }

  void findings_areTheSentencesThatAreData() {
    const auto findings = findings_json({"something else", "two layers in 12.5 % of the pixels"});
    QCOMPARE(findings.size(), std::size_t{1});
    QCOMPARE(findings.front().at("code").get<std::string>(), std::string("layers"));
    QCOMPARE(findings.front().at("values").front().get<std::string>(), std::string("12.5"));
  }
};

}  // namespace episcope::in_json_test

EPISCOPE_TEST(json_test, JsonTest)
#include "json_test.moc"
