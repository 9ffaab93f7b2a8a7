// SPDX-License-Identifier: BSD-3-Clause
#include "tests/window_test_main.h"
#include "widgets/controls/text.h"

#include <QCoreApplication>
#include <QTranslator>

namespace episcope::in_finding_words_test {

namespace {

/// A language with other words, in another order.
class OtherLanguage : public QTranslator {
 public:
  [[nodiscard]] bool isEmpty() const override { return false; }
  [[nodiscard]] QString translate(const char* context, const char* source, const char*,
                                  int) const override {
    const QString text = QString::fromUtf8(source);
    if (QByteArray(context) == "episcope::Finding") {
      if (text == "ordering violated by %1 % of the lines, %2 % before") return "%2 → %1";
      if (text == "computed on the CPU: %1") return "CPU: %1";
      if (text == "ended early") return "unfertig";
    }
    return {};
  }
};

}  // namespace

class FindingWordsTest : public QObject {
  Q_OBJECT

 private slots:
  void sentence_staysWithoutATranslation() {
    QCOMPARE(finding_words("disparity range -1.65 … 1.50 px, found from the images"),
             QString("disparity range −1.65 … 1.50 px, found from the images"));
    QCOMPARE(finding_words("a note of another program"), QString("a note of another program"));
  }

  void values_goToTheirPlacesInATranslation() {
    OtherLanguage language;
    QVERIFY(QCoreApplication::installTranslator(&language));
    const QString ordering =
        finding_words("ordering violated by 0.125 % of the lines, 2.500 % before");
    const QString nested = finding_words("computed on the CPU: ended early");
    const QString joined = finding_words("ended early; ended early");
    QCoreApplication::removeTranslator(&language);

    QCOMPARE(ordering, QString("2.500 → 0.125"));
    QCOMPARE(nested, QString("CPU: unfertig"));
    QCOMPARE(joined, QString("unfertig; unfertig"));
  }

  void brief_isOneLine() {
    QCOMPARE(
        finding_brief("Using the inner 10×10 of 14×14 views, rows 2 to 11 and columns 2 to 11 from "
                      "0: 96 outer views are dark (mean 3 % of the center's); --crop all keeps "
                      "them."),
        QString("Using the inner 10×10 of 14×14 views; the outer ones are dark."));
    QVERIFY(finding_brief("a note of another program").isEmpty());
  }
};

}  // namespace episcope::in_finding_words_test

EPISCOPE_WINDOW_TEST(finding_words_test, FindingWordsTest)
#include "finding_words_test.moc"
