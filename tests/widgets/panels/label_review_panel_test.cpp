// SPDX-License-Identifier: BSD-3-Clause
#include "tests/window_test_main.h"
#include "widgets/panels/label_review_panel.h"

#include <QHeaderView>
#include <QTreeWidget>

namespace episcope::in_label_review_panel_test {
namespace {

LabelInfo label(int id) {
  return {id, "a thing whose name takes sixty letters or so, as a sentence does", {255, 0, 0}};
}

}  // namespace

class LabelReviewPanelTest : public QObject {
  Q_OBJECT

 private slots:
  void longNames_leaveRoomForEachOther();
  void headersOfEmptyTables_areSeenWhole();
  void narrowTable_showsHolesRatherThanTheShare();
};

void LabelReviewPanelTest::headersOfEmptyTables_areSeenWhole() {
  LabelReviewPanel panel;
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

void LabelReviewPanelTest::narrowTable_showsHolesRatherThanTheShare() {
  const LabelReviewPanel::Row row{.label = {1, "label 1", {255, 0, 0}},
                            .pixels = 45091,
                            .share = "30.6 %",
                            .mean = "−0.39",
                            .min = "−1.23",
                            .max = "−0.55",
                            .islands = 12,
                            .holes = 1};
  LabelReviewPanel panel;
  panel.setRows(std::vector(20, row), 1);
  panel.resize(366, 600);
  panel.show();
  QVERIFY(QTest::qWaitForWindowExposed(&panel));
  const auto& labels = *panel.findChild<QTreeWidget*>("check.labels");
  const auto is_whole = [&] { return labels.header()->length() <= labels.viewport()->width(); };

  QVERIFY(is_whole());
  QVERIFY(labels.isColumnHidden(2));
  QCOMPARE(labels.topLevelItem(0)->toolTip(1), QString("30.6 %"));
  panel.resize(500, 600);
  QTRY_VERIFY(!labels.isColumnHidden(2));
  QVERIFY(is_whole());
}

void LabelReviewPanelTest::longNames_leaveRoomForEachOther() {
  LabelReviewPanel panel;
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

}  // namespace episcope::in_label_review_panel_test

EPISCOPE_WINDOW_TEST(label_review_panel_test, LabelReviewPanelTest)
#include "label_review_panel_test.moc"
