// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/metric_table.h"
#include "tests/window_test_main.h"

#include <QApplication>
#include <QClipboard>
#include <QGuiApplication>
#include <QHeaderView>
#include <QLabel>
#include <QMenu>
#include <QSignalSpy>
#include <QTableWidget>
#include <QToolButton>

#include <limits>

namespace episcope::in_metric_table_test {

namespace {

std::vector<MetricColumn> columns() {
  return {{"result", "Result", "", 0}, {"mse_100", "MSE×100", "px²", 3}, {"note", "Note", "", 0}};
}

std::vector<MetricRow> rows() {
  return {{11, {QString("EPI_L"), 10.5, QString("plain")}},
          {12, {QString("EPI_S"), 9.25, QString("with, comma and \"quote\"")}},
          {13, {QString("foreign"), QVariant(), QString("50 % of it")}},
          {14, {QString("stereo"), 0.1 + 0.2, QString("a_b")}}};
}

QStringList first_column(const MetricTable& table) {
  const auto* inner = table.findChild<QTableWidget*>();
  QStringList names;
  for (int row = 0; row < inner->rowCount(); ++row) names << inner->item(row, 0)->text();
  return names;
}

void click_header(MetricTable& table, int column) {
  auto* header = table.findChild<QTableWidget*>()->horizontalHeader();
  const int x = header->sectionViewportPosition(column) + header->sectionSize(column) / 2;
  QTest::mouseClick(header->viewport(), Qt::LeftButton, {}, {x, header->height() / 2});
}

}  // namespace

class MetricTableTest : public QObject {
  Q_OBJECT

 private slots:
  void sameTable_isNotFilledAnew() {
    MetricTable table;
    table.setTable(columns(), rows());
    const auto* inner = table.findChild<QTableWidget*>("metrics.table");
    const QTableWidgetItem* before = inner->item(0, 0);
    inner->item(0, 0)->setData(Qt::UserRole + 7, "marked");

    table.setTable(columns(), rows());
    QCOMPARE(inner->item(0, 0), before);
    QCOMPARE(inner->item(0, 0)->data(Qt::UserRole + 7).toString(), QString("marked"));

    auto changed = rows();
    changed.front().values.front() = "another name";
    table.setTable(columns(), changed);
    QCOMPARE(inner->item(0, 0)->text(), QString("another name"));
    QVERIFY(inner->item(0, 0)->data(Qt::UserRole + 7).isNull());
  }

  void clickOnAHeader_sortsNumbersAsNumbersAndAbsentLast() {
    MetricTable table;
    table.resize(500, 300);
    table.setTable(columns(), rows());
    table.show();

    click_header(table, 1);
    QCOMPARE(first_column(table), QStringList({"stereo", "EPI_S", "EPI_L", "foreign"}));
    click_header(table, 1);
    QCOMPARE(first_column(table), QStringList({"EPI_L", "EPI_S", "stereo", "foreign"}));
    click_header(table, 0);
    QCOMPARE(first_column(table), QStringList({"EPI_L", "EPI_S", "foreign", "stereo"}));
  }

  void sorting_survivesNewRows() {
    MetricTable table;
    table.resize(500, 300);
    table.setTable(columns(), rows());
    table.show();
    click_header(table, 1);
    auto more = rows();
    more.push_back({15, {QString("new"), 5.0, QString()}});

    table.setTable(columns(), more);

    QCOMPARE(first_column(table), QStringList({"stereo", "new", "EPI_S", "EPI_L", "foreign"}));
  }

  void csv_isExactAndQuoted() {
    MetricTable table;
    table.setTable(columns(), rows());

    const QStringList lines = table.toCsv().split('\n');

    QCOMPARE(lines[0], QString("result,mse_100,note"));
    QCOMPARE(lines[1], QString("EPI_L,10.5,plain"));
    QCOMPARE(lines[2], QString("EPI_S,9.25,\"with, comma and \"\"quote\"\"\""));
    QCOMPARE(lines[3], QString("foreign,,50 % of it"));
    QCOMPARE(lines[4].section(',', 1, 1).toDouble(), 0.1 + 0.2);  // Every digit.
  }

  void latex_isEscaped() {
    MetricTable table;
    table.setTable(columns(), rows());

    const QString latex = table.toLatex();

    QVERIFY(latex.startsWith("\\begin{tabular}{lrr}"));
    QVERIFY(latex.contains("MSE$\\times$100"));
    QVERIFY(latex.contains("EPI\\_L & 10.500 & plain \\\\"));
    QVERIFY(latex.contains("foreign & -- & 50 \\% of it"));
    QVERIFY(latex.trimmed().endsWith("\\end{tabular}"));
  }

  void columnOfTheMenu_isLeftOutOfTableAndLatex() {
    MetricTable table;
    table.setTable(columns(), rows());
    table.show();
    auto* inner = table.findChild<QTableWidget*>();

    emit inner->customContextMenuRequested({});
    const auto* menu = table.findChild<QMenu*>("metrics.columns");
    QVERIFY(menu);
    QCOMPARE(menu->actions().size(), 2);
    menu->actions().at(1)->trigger();

    QVERIFY(inner->isColumnHidden(2) && !inner->isColumnHidden(1));
    QVERIFY(table.toLatex().startsWith("\\begin{tabular}{lr}"));
    QVERIFY(!table.toLatex().contains("plain"));
    QVERIFY(table.toCsv().contains("plain"));
  }

  void columns_areChosenWhereTheTableIsSaved() {
    MetricTable table;
    table.setTable(columns(), rows());
    table.show();

    table.findChild<QToolButton*>("metrics.save")->click();
    auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    QVERIFY(menu);
    QMenu* chosen = menu->actions().back()->menu();
    QVERIFY(chosen);
    emit chosen->aboutToShow();
    chosen->actions().at(1)->trigger();
    menu->close();

    QVERIFY(table.toLatex().startsWith("\\begin{tabular}{lr}"));
  }

  void minorColumn_isShownOnceItIsChosen() {
    auto few = columns();
    few[1].is_minor = true;
    MetricTable table;
    table.setTable(few, rows());
    table.show();
    auto* inner = table.findChild<QTableWidget*>();
    QVERIFY(inner->isColumnHidden(1) && !inner->isColumnHidden(2));

    emit inner->customContextMenuRequested({});
    table.findChild<QMenu*>("metrics.columns")->actions().at(0)->trigger();

    QVERIFY(!inner->isColumnHidden(1));
  }

  void nan_isSortedLastAndShownAsAbsent() {
    MetricTable table;
    table.resize(500, 300);
    auto values = rows();
    values.push_back({16, {QString("broken"), std::numeric_limits<double>::quiet_NaN()}});
    table.setTable(columns(), values);
    table.show();

    for (int clicks = 0; clicks < 2; ++clicks) {
      click_header(table, 1);
      const QStringList order = first_column(table);
      const QStringList last = {order[order.size() - 2], order.back()};
      QVERIFY2(last.contains("broken") && last.contains("foreign"), qPrintable(order.join(' ')));
    }
    QVERIFY(table.toCsv().contains("broken,,\n"));
    QVERIFY(table.toLatex().contains("broken & -- & --"));
  }

  void bestOfAColumn_isStressed() {
    MetricTable table;
    auto names = columns();
    names[1].best = BestValue::Least;

    table.setTable(names, rows());

    const auto* inner = table.findChild<QTableWidget*>();
    QStringList bold;
    for (int row = 0; row < inner->rowCount(); ++row) {
      if (inner->item(row, 1)->font().bold()) bold << inner->item(row, 0)->text();
    }
    QCOMPARE(bold, QStringList("stereo"));
    QVERIFY(table.toLatex().contains("stereo & \\textbf{0.300} & "));
    QCOMPARE(table.toLatex().count("\\textbf"), 1);
  }

  void columnOfTextsOnly_isCopiedButNotShown() {
    MetricTable table;
    auto names = columns();
    names[2].is_shown = false;

    table.setTable(names, rows());

    const auto* inner = table.findChild<QTableWidget*>();
    QVERIFY(inner->isColumnHidden(2) && !inner->isColumnHidden(1));
    QVERIFY(table.toCsv().contains("EPI_L,10.5,plain"));
    QVERIFY(table.toLatex().contains("& plain"));
  }

  void sides_areMarked() {
    MetricTable table;
    table.setTable(columns(), rows());

    table.setSides(12, 11);

    const auto* inner = table.findChild<QTableWidget*>();
    int marked = 0;
    for (int row = 0; row < inner->rowCount(); ++row) {
      marked += inner->item(row, 0)->icon().isNull() ? 0 : 1;
    }
    QCOMPARE(marked, 2);
    table.setSides(12, 0);  // nothing to compare with: no marks
    QVERIFY(inner->item(1, 0)->icon().isNull());
  }

  void copyButton_fillsTheClipboard() {
    MetricTable table;
    table.setTable(columns(), rows());

    table.findChild<QToolButton*>("metrics.copyCsv")->click();

    QCOMPARE(QGuiApplication::clipboard()->text(), table.toCsv());
  }

  void clickOnARow_givesItsIdAfterSorting() {
    MetricTable table;
    table.resize(500, 300);
    table.setTable(columns(), rows());
    table.show();
    click_header(table, 1);
    auto* inner = table.findChild<QTableWidget*>();
    QSignalSpy clicked(&table, &MetricTable::rowClicked);

    const QRect cell = inner->visualItemRect(inner->item(1, 1));
    QTest::mouseClick(inner->viewport(), Qt::LeftButton, {}, cell.center());

    QCOMPARE(clicked.size(), 1);
    QCOMPARE(clicked[0][0].toULongLong(), quint64(12));
  }

  void emptyTable_saysWhy() {
    MetricTable table;
    table.setEmptyText("This scene has no ground truth.");
    table.setTable(columns(), {});

    auto* label = table.findChild<QLabel*>("metrics.empty");
    QCOMPARE(label->text(), QString("This scene has no ground truth."));
    QVERIFY(!label->isHidden());
    QVERIFY(!table.findChild<QToolButton*>("metrics.copyCsv")->isEnabled());
  }
};

}  // namespace episcope::in_metric_table_test

EPISCOPE_WINDOW_TEST(metric_table_test, MetricTableTest)
#include "metric_table_test.moc"
