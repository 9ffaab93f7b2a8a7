// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/hash.h"
#include "tests/test_main.h"

namespace episcope::in_fnv1a_test {

class Fnv1aTest : public QObject {
  Q_OBJECT

 private slots:
  // Test vectors of the authors (draft-eastlake-fnv).
  void bytes_giveThePublishedValue_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("digits");
    QTest::newRow("nothing") << ""
                             << "cbf29ce484222325";
    QTest::newRow("a") << "a"
                       << "af63dc4c8601ec8c";
    QTest::newRow("b") << "b"
                       << "af63df4c8601f1a5";
    QTest::newRow("foobar") << "foobar"
                            << "85944171f73967e8";
  }
  void bytes_giveThePublishedValue() {
    QFETCH(QString, text);
    QFETCH(QString, digits);
    Fnv1a hash;

    hash.add(text.toStdString());

    QCOMPARE(QString::fromStdString(hash_digits(hash.value())), digits);
  }

  void parts_giveTheValueOfTheWhole() {
    Fnv1a whole, parts;

    whole.add("foobar");
    parts.add("foo");
    parts.add("bar");

    QCOMPARE(parts.value(), whole.value());
  }

  void digits_comeBack_data() {
    QTest::addColumn<quint64>("hash");
    QTest::addColumn<QString>("digits");
    QTest::newRow("zero") << quint64{0} << "0000000000000000";
    QTest::newRow("leading zero") << quint64{0x0123456789abcdef} << "0123456789abcdef";
    QTest::newRow("largest") << quint64{0xffffffffffffffff} << "ffffffffffffffff";
  }
  void digits_comeBack() {
    QFETCH(quint64, hash);
    QFETCH(QString, digits);

    QCOMPARE(QString::fromStdString(hash_digits(hash)), digits);
    QCOMPARE(quint64{hash_from_digits(digits.toStdString())}, hash);
  }

  void digitsWithoutLeadingZeros_areRead() {
    QCOMPARE(quint64{hash_from_digits("12ab")}, quint64{0x12ab});
    QCOMPARE(quint64{hash_from_digits("")}, quint64{0});
  }
};

}  // namespace episcope::in_fnv1a_test

EPISCOPE_TEST(fnv1a_test, Fnv1aTest)
#include "fnv1a_test.moc"
