// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/annotate/check_panel.h"
#include "tests/window_test_main.h"

#include <QHeaderView>
#include <QTreeWidget>

namespace episcope::in_check_panel_test {
namespace {

LabelInfo label(int id) {
  return {id, "a thing whose name takes sixty letters or so, as a sentence does", {255, 0, 0}};
}

}  // namespace

class CheckPanelTest : public QObject {
  Q_OBJECT

 private slots:
  void longNames_leaveRoomForEachOther();
  void headersOfEmptyTables_areSeenWhole();
};

void CheckPanelTest::headersOfEmptyTables_areSeenWhole() {
  CheckPanel panel;
  panel.resize(366, 600);  // the side of a window of 1280 pixels
  panel.show();
  QVERIFY(QTest::qWaitForWindowExposed(&panel));

  for (const char* name : {"check.doubts", "check.labels", "check.pieces"}) {
    const auto& header = *panel.findChild<QTreeWidget*>(name)->header();
    QVERIFY2(header.length() <= header.width(), name);
    for (int column = 0; column < header.count(); ++column) {
      QVERIFY2(header.sectionSize(column) >= header.sectionSizeHint(column), name);
    }
  }
}

void CheckPanelTest::longNames_leaveRoomForEachOther() {
  CheckPanel panel;
  panel.resize(366, 600);
  panel.setDoubts({{label(1), label(2), 900}});
  panel.setPieces("Islands", {{"island", label(1), 20}});
  panel.show();
  QVERIFY(QTest::qWaitForWindowExposed(&panel));

  const auto& doubts = *panel.findChild<QTreeWidget*>("check.doubts")->header();
  const auto& pieces = *panel.findChild<QTreeWidget*>("check.pieces")->header();

  QVERIFY(std::abs(doubts.sectionSize(0) - doubts.sectionSize(1)) <= 1);
  for (const QHeaderView* header : {&doubts, &pieces}) {
    QVERIFY(header->length() <= header->width());
  }
}

}  // namespace episcope::in_check_panel_test

EPISCOPE_WINDOW_TEST(check_panel_test, CheckPanelTest)
#include "check_panel_test.moc"
