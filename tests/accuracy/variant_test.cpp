// SPDX-License-Identifier: BSD-3-Clause
#include "tests/accuracy/variant.h"

#include "engine/core/error.h"
#include "engine/disparity/registry.h"
#include "tests/test_main.h"

namespace episcope::in_variant_test {

class VariantTest : public QObject {
  Q_OBJECT

 private slots:
  void noMethods_areAll() {
    QCOMPARE(accuracy::variants({}, {}).size(), registered_estimators().size());
  }

  void settings_reachTheMethodsThatHaveThem() {
    const auto variants =
        accuracy::variants({"st_ch_l", "st_ch_g"}, {"profile=paper", "st_ch_g.epsilon=0.3"});

    QCOMPARE(variants.size(), std::size_t{2});
    QCOMPARE(variants[0].values, (ParameterSet{{"profile", std::string("paper")}}));
    QCOMPARE(variants[1].values,
             (ParameterSet{{"profile", std::string("paper")}, {"epsilon", 0.3}}));
  }

  void badSettings_areRefused_data() {
    QTest::addColumn<QString>("setting");
    QTest::newRow("no value") << "lambda";
    QTest::newRow("no such parameter") << "lambada=1";
    QTest::newRow("of another method") << "epi_l.profile=paper";
    QTest::newRow("no such value") << "profile=papyrus";
  }
  void badSettings_areRefused() {
    QFETCH(QString, setting);

    QVERIFY_THROWS_EXCEPTION(
        InvalidInput, std::ignore = accuracy::variants({"st_ch_g"}, {setting.toStdString()}));
  }
};

}  // namespace episcope::in_variant_test

EPISCOPE_TEST(variant_test, VariantTest)
#include "variant_test.moc"
