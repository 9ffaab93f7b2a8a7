// SPDX-License-Identifier: BSD-3-Clause
#include "tests/window_test_main.h"
#include "widgets/controls/number_spin.h"

#include "widgets/controls/text.h"

#include <QLineEdit>
#include <QSignalSpy>

namespace episcope::in_number_spin_test {

class NumberSpinTest : public QObject {
  Q_OBJECT

 private slots:
  void negativeNumber_hasATrueMinus() {
    NumberSpin spin;
    spin.setRange(-5, 5);
    spin.setSuffix(" px");

    spin.setValue(-1.25);

    QCOMPARE(spin.text(), QStringLiteral("−1.25 px"));
  }

  void negativeNumber_canBeTyped_data() {
    QTest::addColumn<QString>("typed");
    QTest::addColumn<double>("value");
    QTest::newRow("hyphen") << "-2.5" << -2.5;
    QTest::newRow("minus") << QStringLiteral("−0.75") << -0.75;
    QTest::newRow("none") << "3" << 3.0;
  }

  void negativeNumber_canBeTyped() {
    QFETCH(QString, typed);
    QFETCH(double, value);
    NumberSpin spin;
    spin.setRange(-5, 5);
    spin.setSuffix(" px");
    auto* edit = spin.findChild<QLineEdit*>();

    edit->setText(typed);
    spin.interpretText();

    QCOMPARE(spin.value(), value);
  }

  void typedComma_isAPoint_whereTheLanguageHasOne() {
    const QLocale before;
    QLocale::setDefault(QLocale("de"));
    NumberSpin spin;
    spin.setRange(-5, 5);
    auto* edit = spin.findChild<QLineEdit*>();

    edit->setText("-2,25");
    spin.interpretText();

    QLocale::setDefault(before);
    QCOMPARE(spin.value(), -2.25);
    QCOMPARE(spin.text(), QStringLiteral("−2.25"));
  }

  void numberBeyondTheRange_becomesTheLimit_data() {
    QTest::addColumn<QString>("typed");
    QTest::addColumn<double>("value");
    QTest::newRow("far above") << "250" << 5.0;
    QTest::newRow("far below") << "-99.5" << -5.0;
    QTest::newRow("within") << "4.75" << 4.75;
  }

  void numberBeyondTheRange_becomesTheLimit() {
    QFETCH(QString, typed);
    QFETCH(double, value);
    NumberSpin spin;
    spin.setRange(-5, 5);
    spin.setSuffix(" px");
    spin.show();
    auto* edit = spin.findChild<QLineEdit*>();
    edit->selectAll();

    QTest::keyClicks(edit, typed);
    QTest::keyClick(edit, Qt::Key_Return);

    QCOMPARE(spin.value(), value);
  }

  void stepsDown_throughZero() {
    NumberSpin spin;
    spin.setRange(-5, 5);
    spin.setSingleStep(1);

    spin.stepBy(-2);
    spin.stepBy(-1);

    QCOMPARE(spin.value(), -3.0);
  }

  void zerosAtTheEnd_areLeftOut() {
    NumberSpin spin;
    spin.setDecimals(7);
    spin.setRange(0, 100);
    spin.setLeastDecimals(2);

    spin.setValue(0.0001);
    QCOMPARE(spin.text(), QString("0.0001"));
    spin.setValue(30);
    QCOMPARE(spin.text(), QString("30.00"));
  }

  void hugeNumber_staysShort() {
    QCOMPARE(number_text(-1e30), QStringLiteral("−1e+30"));
    QCOMPARE(number_text(123456.789, 2), QString("123456.79"));
  }

  void sentence_keepsHyphensThatAreNoMinus() {
    QCOMPARE(with_minus("-1.2 … 1.5 px (-3)"), QStringLiteral("−1.2 … 1.5 px (−3)"));
    for (const char* kept : {"gap 1.3e-02", "out_00-12.png", "epi-2", "2021-05-06", "a/-1.png"}) {
      QCOMPARE(with_minus(kept), QString(kept));
    }
  }
};

}  // namespace episcope::in_number_spin_test

EPISCOPE_WINDOW_TEST(number_spin_test, NumberSpinTest)
#include "number_spin_test.moc"
