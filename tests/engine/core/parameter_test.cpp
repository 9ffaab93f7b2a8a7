// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/core/parameter.h"
#include "tests/test_main.h"

namespace episcope::in_parameter_test {

namespace {

ParameterDescription described(ParameterValue default_value, double min = 0, double max = 10) {
  ParameterDescription description;
  description.key = "speed";
  description.default_value = std::move(default_value);
  description.min = min;
  description.max = max;
  return description;
}

ParameterDescription with_choices() {
  ParameterDescription description = described(std::string("fast"));
  description.choices = {"fast", "slow"};
  return description;
}

ParameterDescription description_of(const QString& type) {
  if (type == "flag") return described(true);
  if (type == "integer") return described(3);
  if (type == "real") return described(0.5);
  if (type == "choice") return with_choices();
  if (type == "view") return described(ViewOrAuto{});
  return described(IntervalOrAuto{}, -10, 10);
}

}  // namespace

class ParameterTest : public QObject {
  Q_OBJECT

 private slots:
  void text_roundTrips_data() {
    QTest::addColumn<QString>("type");
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("canonical");
    QTest::newRow("flag") << "flag"
                          << "true"
                          << "true";
    QTest::newRow("flag off") << "flag"
                              << "off"
                              << "false";
    QTest::newRow("flag 1") << "flag"
                            << "1"
                            << "true";
    QTest::newRow("integer") << "integer"
                             << "7"
                             << "7";
    QTest::newRow("integer, plus") << "integer"
                                   << "+7"
                                   << "7";
    QTest::newRow("real") << "real"
                          << "0.25"
                          << "0.25";
    QTest::newRow("real, exponent") << "real"
                                    << "1e-3"
                                    << "0.001";
    QTest::newRow("real, whole") << "real"
                                 << "10"
                                 << "10";
    QTest::newRow("choice") << "choice"
                            << "slow"
                            << "slow";
    QTest::newRow("auto") << "interval"
                          << "auto"
                          << "auto";
    QTest::newRow("found") << "interval"
                           << "found"
                           << "found";
    QTest::newRow("interval") << "interval"
                              << "-1.5,2"
                              << "-1.5,2";
    QTest::newRow("view") << "view"
                          << "4,12"
                          << "4,12";
    QTest::newRow("view, auto") << "view"
                                << "auto"
                                << "auto";
  }
  void text_roundTrips() {
    QFETCH(QString, type);
    QFETCH(QString, text);
    QFETCH(QString, canonical);
    const ParameterDescription description = description_of(type);

    const ParameterValue value = parse_parameter(description, text.toStdString());

    QCOMPARE(QString::fromStdString(to_text(value)), canonical);
    QVERIFY(parse_parameter(description, to_text(value)) == value);
  }

  void badText_isRefusedWithKeyValueAndDomain_data() {
    QTest::addColumn<QString>("type");
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("expected");
    QTest::newRow("flag") << "flag"
                          << "maybe"
                          << "true or false";
    QTest::newRow("integer, real") << "integer"
                                   << "2.5"
                                   << "whole number";
    QTest::newRow("integer, high") << "integer"
                                   << "11"
                                   << "from 0 to 10";
    QTest::newRow("real, word") << "real"
                                << "much"
                                << "from 0 to 10";
    QTest::newRow("real, rest") << "real"
                                << "1px"
                                << "from 0 to 10";
    QTest::newRow("real, empty") << "real"
                                 << ""
                                 << "from 0 to 10";
    QTest::newRow("real, low") << "real"
                               << "-0.1"
                               << "from 0 to 10";
    QTest::newRow("real, NaN") << "real"
                               << "nan"
                               << "from 0 to 10";
    QTest::newRow("choice") << "choice"
                            << "medium"
                            << "one of fast, slow";
    QTest::newRow("interval, one") << "interval"
                                   << "3"
                                   << "A,B";
    QTest::newRow("interval, word") << "interval"
                                    << "1,b"
                                    << "A,B";
    QTest::newRow("interval, order") << "interval"
                                     << "2,1"
                                     << "A < B";
    QTest::newRow("interval, empty") << "interval"
                                     << "1,1"
                                     << "A < B";
    QTest::newRow("interval, far") << "interval"
                                   << "-11,1"
                                   << "from -10 to 10";
    QTest::newRow("view, one") << "view"
                               << "4"
                               << "V,U";
    QTest::newRow("view, broken") << "view"
                                  << "4,1.5"
                                  << "V,U";
    QTest::newRow("view, below") << "view"
                                 << "-1,4"
                                 << "from 0";
  }
  void badText_isRefusedWithKeyValueAndDomain() {
    QFETCH(QString, type);
    QFETCH(QString, text);
    QFETCH(QString, expected);

    QString message;
    try {
      static_cast<void>(parse_parameter(description_of(type), text.toStdString()));
    } catch (const InvalidInput& error) {
      message = QString::fromUtf8(error.what());
    }

    QVERIFY2(message.contains("speed") && message.contains(expected), qPrintable(message));
  }

  void otherType_isRefused() {
    QVERIFY_THROWS_EXCEPTION(InvalidInput, check_parameter(described(3), ParameterValue(2.0)));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, check_parameter(described(3.0), ParameterValue(2)));
    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             check_parameter(described(true), ParameterValue(std::string("true"))));
  }

  void domain_isClosed() {
    check_parameter(described(3), ParameterValue(0));
    check_parameter(described(3), ParameterValue(10));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, check_parameter(described(3), ParameterValue(-1)));
  }

  void nearestName_findsTypos_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<QString>("nearest");
    QTest::newRow("same") << "epi_l"
                          << "epi_l";
    QTest::newRow("letter more") << "epi_ll"
                                 << "epi_l";
    QTest::newRow("letter less") << "ep_s"
                                 << "epi_s";
    QTest::newRow("swapped") << "epi_sl"
                             << "epi_s";
    QTest::newRow("case") << "DEMO"
                          << "";
    QTest::newRow("far") << "something else"
                         << "";
    QTest::newRow("long typo") << "transparant"
                               << "transparent";
  }
  void nearestName_findsTypos() {
    QFETCH(QString, name);
    QFETCH(QString, nearest);

    const std::vector<std::string> names{"epi_s", "epi_l", "demo", "transparent"};

    QCOMPARE(QString::fromStdString(nearest_name(name.toStdString(), names)), nearest);
  }

  void nearestName_ofNothingIsEmpty() { QVERIFY(nearest_name("epi_l", {}).empty()); }
};

}  // namespace episcope::in_parameter_test

EPISCOPE_TEST(parameter_test, ParameterTest)
#include "parameter_test.moc"
