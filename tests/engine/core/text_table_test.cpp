// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/text_table.h"
#include "tests/test_main.h"

namespace episcope::in_text_table_test {

class TextTableTest : public QObject {
  Q_OBJECT
 private slots:
  void text_alignsByLetters() {
    const TextTable table{{"file", "mse"}, {{"Gerät", "1.5"}, {"b", "12.25"}}};
    QCOMPARE(QString::fromStdString(table_to_text(table)), QString("file     mse\n"
                                                                   "Gerät    1.5\n"
                                                                   "b      12.25\n"));
  }

  void csv_quotesWhatItMust() {
    const TextTable table{{"file", "mse"}, {{"a,b", "1"}, {"say \"hi\"", "2"}, {"two\nlines", ""}}};
    QCOMPARE(QString::fromStdString(table_to_csv(table)),
             QString("file,mse\n\"a,b\",1\n\"say \"\"hi\"\"\",2\n\"two\nlines\",\n"));
  }

  void latex_escapesSpecialCharacters() {
    const TextTable table{{"file", "mse_100"}, {{"a_b&c%d#e$f{g}h~i^j\\k", "1"}}};
    const QString text = QString::fromStdString(table_to_latex(table));
    QVERIFY(text.contains("\\begin{tabular}{lr}"));
    QVERIFY(text.contains("file & mse\\_100 \\\\"));
    QVERIFY(text.contains("a\\_b\\&c\\%d\\#e\\$f\\{g\\}h\\~{}i\\^{}j\\textbackslash{}k & 1 \\\\"));
  }

  void latex_stressesCellsInBold() {
    const TextTable table{
        {"file", "mse"}, {{"a_b", "1"}, {"c", "2"}}, {{false, true}, {true, false}}};
    const QString text = QString::fromStdString(table_to_latex(table));
    QVERIFY(text.contains("a\\_b & \\textbf{1} \\\\"));
    QVERIFY(text.contains("\\textbf{c} & 2 \\\\"));
  }

  void latex_writesTimesAndMinus() {
    QVERIFY(QString::fromStdString(table_to_latex({{"MSE×100"}, {}})).contains("MSE$\\times$100"));
    QVERIFY(QString::fromStdString(table_to_latex({{"−1.5"}, {}})).contains("$-$1.5"));
  }

  void transposed_exchangesRowsAndColumns() {
    const TextTable table = transposed({{"file", "a", "b"}, {{"x", "1", "2"}, {"y", "3", "4"}}});
    QCOMPARE(table.header, (std::vector<std::string>{"file", "x", "y"}));
    QCOMPARE(table.rows, (std::vector<std::vector<std::string>>{{"a", "1", "3"}, {"b", "2", "4"}}));
  }

  void latex_writesBracketsAsTheyAre() {
    const QString text = QString::fromStdString(table_to_latex({{"<a|b>"}, {}}));
    QVERIFY(text.contains("\\textless{}a\\textbar{}b\\textgreater{}"));
  }

  void narrowText_isTransposedWhereThatIsShorter() {
    const TextTable few{{"file", "first metric", "second metric"}, {{"x", "1", "2"}}};
    QCOMPARE(table_to_narrow_text(few), table_to_text(transposed(few)));
    TextTable many{{"file", "a"}, {}};
    for (int i = 0; i < 20; ++i) many.rows.push_back({"a file of this name", "1"});
    QCOMPARE(table_to_narrow_text(many), table_to_text(many));
  }

  void fixedText_keepsItsDigits() {
    QCOMPARE(fixed_text(0.25, 3), std::string("0.250"));
    QCOMPARE(fixed_text(1e300, 0).size(), std::size_t{301});
  }
};

}  // namespace episcope::in_text_table_test

EPISCOPE_TEST(text_table_test, TextTableTest)
#include "text_table_test.moc"
