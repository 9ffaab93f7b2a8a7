// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/table.h"
#include "app/cli/progress_bar.h"

#include <QtTest>

using namespace episcope;
using namespace episcope::cli;

class TableTest : public QObject {
  Q_OBJECT
 private slots:
  void text_alignsByLetters() {
    const Table table{{"file", "mse"}, {{"Gerät", "1.5"}, {"b", "12.25"}}};
    QCOMPARE(QString::fromStdString(table_to_text(table)), QString("file     mse\n"
                                                                   "Gerät    1.5\n"
                                                                   "b      12.25\n"));
  }

  void csv_quotesWhatItMust() {
    const Table table{{"file", "mse"}, {{"a,b", "1"}, {"say \"hi\"", "2"}, {"two\nlines", ""}}};
    QCOMPARE(QString::fromStdString(table_to_csv(table)),
             QString("file,mse\n\"a,b\",1\n\"say \"\"hi\"\"\",2\n\"two\nlines\",\n"));
  }

  void latex_escapesSpecialCharacters() {
    const Table table{{"file", "mse_100"}, {{"a_b&c%d#e$f{g}h~i^j\\k", "1"}}};
    const QString text = QString::fromStdString(table_to_latex(table));
    QVERIFY(text.contains("\\begin{tabular}{lr}"));
    QVERIFY(text.contains("file & mse\\_100 \\\\"));
    QVERIFY(text.contains("a\\_b\\&c\\%d\\#e\\$f\\{g\\}h\\~{}i\\^{}j\\textbackslash{}k & 1 \\\\"));
  }

  void progressLine_tellsStageAndTimeLeft() {
    const auto line = [](double fraction, double seconds, int columns) {
      return QString::fromStdString(progress_line({fraction, "vertical EPIs"}, seconds, columns));
    };
    QCOMPARE(line(0.5, 3, 120),
             QString("[############............]  50 %  vertical EPIs, 3 s left"));
    QVERIFY(line(0.25, 60, 120).endsWith(", 3 min 0 s left"));
    QVERIFY(!line(0.5, 0.5, 120).contains("left"));
    QVERIFY(line(1, 3, 120).startsWith("[########################] 100 %"));
    QCOMPARE(line(0.5, 3, 40).size(), 39);
  }
};

QTEST_APPLESS_MAIN(TableTest)
#include "table_test.moc"
