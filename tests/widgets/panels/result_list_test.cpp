// SPDX-License-Identifier: BSD-3-Clause
#include "tests/window_test_main.h"
#include "widgets/panels/result_list.h"

#include <QHeaderView>
#include <QMenu>
#include <QSignalSpy>
#include <QToolButton>
#include <QTreeWidget>

namespace episcope::in_result_list_test {

class ResultListTest : public QObject {
  Q_OBJECT

 private slots:
  void rows_areSelectedAndActedOn() {
    ResultList list;
    list.resize(320, 200);
    list.setResults({{1, "EPI_L", "inner 0.8", 1.23, 0.78, ""}, {2, "EPI_S", "", 2.1, {}, ""}});
    list.show();
    auto* tree = list.findChild<QTreeWidget*>("results.tree");
    QSignalSpy selected(&list, &ResultList::selected);
    QSignalSpy removed(&list, &ResultList::removeRequested);
    QSignalSpy exported(&list, &ResultList::exportRequested);
    auto* remove = list.findChild<QToolButton*>("results.remove");
    QVERIFY(!remove->isEnabled());
    list.setShown(1);
    remove->click();
    QCOMPARE(removed[0][0].toULongLong(), quint64(1));
    removed.clear();

    const QRect row = tree->visualItemRect(tree->topLevelItem(1));
    QTest::mouseClick(tree->viewport(), Qt::LeftButton, {}, {60, row.center().y()});
    QCOMPARE(selected.size(), 1);
    QCOMPARE(selected[0][0].toULongLong(), quint64(2));
    remove->click();
    list.findChild<QToolButton*>("results.export")->click();

    QCOMPARE(removed[0][0].toULongLong(), quint64(2));
    QCOMPARE(exported[0][0].toULongLong(), quint64(2));
    QCOMPARE(tree->topLevelItem(0)->text(2), QString("0.78"));
    QCOMPARE(tree->topLevelItem(1)->text(2), QString("–"));
  }

  void refresh_keepsSelectionAndMark() {
    ResultList list;
    const std::vector<ResultRow> rows{{1, "EPI_L", "", 1, {}, ""}, {2, "EPI_S", "", 2, {}, ""}};
    list.setResults(rows);
    auto* tree = list.findChild<QTreeWidget*>("results.tree");
    tree->setCurrentItem(tree->topLevelItem(1));
    list.setShown(1);
    QSignalSpy selected(&list, &ResultList::selected);

    list.setResults(rows);

    QVERIFY(list.selectedId() == 2);
    QVERIFY(!tree->topLevelItem(0)->icon(0).isNull());
    QVERIFY(tree->topLevelItem(1)->icon(0).isNull());
    QCOMPARE(selected.size(), 0);
  }

  void longNames_leaveTheNumbersInSight() {
    ResultList list;
    list.resize(366, 120);  // the side of a window of 1280 pixels
    std::vector<ResultRow> rows;
    for (quint64 id = 1; id <= 12; ++id) {
      rows.push_back({id, QString("result %1 ").arg(id).repeated(8), "defaults", 1234, 0.78, ""});
    }
    list.setResults(rows);
    list.show();
    QVERIFY(QTest::qWaitForWindowExposed(&list));
    const auto* tree = list.findChild<QTreeWidget*>("results.tree");

    QVERIFY(tree->header()->length() <= tree->viewport()->width());
    for (int column = 0; column < tree->columnCount(); ++column) {
      QVERIFY2(tree->header()->sectionSize(column) >= tree->header()->sectionSizeHint(column),
               qPrintable(tree->headerItem()->text(column)));
    }
  }

  void shownResult_isScrolledTo() {
    ResultList list;
    list.resize(320, 160);
    std::vector<ResultRow> rows;
    for (quint64 id = 1; id <= 20; ++id) rows.push_back({id, "EPI_L", "", 1, {}, ""});
    list.setResults(rows);
    list.show();
    QVERIFY(QTest::qWaitForWindowExposed(&list));
    auto* tree = list.findChild<QTreeWidget*>("results.tree");

    list.setShown(20);

    const auto is_in_sight = [tree](int row) {
      return tree->viewport()->rect().contains(
          tree->visualItemRect(tree->topLevelItem(row)).center());
    };
    QVERIFY(is_in_sight(19));
    // A refresh does not take back what the user scrolled to.
    tree->scrollToTop();
    list.setResults(rows);
    QVERIFY(!is_in_sight(19));
  }

  void menu_offersEveryAction() {
    ResultList list;
    list.resize(320, 200);
    list.setResults({{5, "EPI_L", "", 1, {}, ""}});
    list.show();
    auto* tree = list.findChild<QTreeWidget*>("results.tree");
    QSignalSpy copy(&list, &ResultList::copyCommandRequested);
    QSignalSpy reuse(&list, &ResultList::reuseRequested);

    emit tree->customContextMenuRequested(tree->visualItemRect(tree->topLevelItem(0)).center());

    auto* menu = list.findChild<QMenu*>("results.menu");
    QVERIFY(menu);
    for (auto* action : menu->actions()) action->trigger();
    QCOMPARE(copy.size(), 1);
    QCOMPARE(copy[0][0].toULongLong(), quint64(5));
    QCOMPARE(reuse.size(), 1);
    menu->close();
  }
};

}  // namespace episcope::in_result_list_test

EPISCOPE_WINDOW_TEST(result_list_test, ResultListTest)
#include "result_list_test.moc"
