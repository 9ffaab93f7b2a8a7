// SPDX-License-Identifier: BSD-3-Clause
#include "tests/window_test_main.h"
#include "widgets/controls/labels.h"

namespace episcope::in_elided_label_test {

class ElidedLabelTest : public QObject {
  Q_OBJECT

 private slots:
  void text_isShownWholeWhereThereIsRoom() {
    ElidedLabel label;
    label.setFullText("a name of some length");
    label.resize(label.sizeHint());
    label.show();
    QCOMPARE(label.text(), QString("a name of some length"));
    QVERIFY(label.toolTip().isEmpty());

    label.resize(40, 20);

    QVERIFY(label.text() != label.fullText());
    QCOMPARE(label.toolTip(), label.fullText());
  }

  void parts_areLeftOutWholeAndListedInTheTip() {
    PartsLabel label;
    label.setParts({"EPI_L 1.25 px", "EPI_S 1.31 px", "ST_CH_L 1.30 px"});
    label.resize(label.sizeHint());
    label.show();
    QCOMPARE(label.text(), QStringLiteral("EPI_L 1.25 px · EPI_S 1.31 px · ST_CH_L 1.30 px"));
    QVERIFY(label.toolTip().isEmpty());

    label.resize(label.fontMetrics().horizontalAdvance("EPI_L 1.25 px · +2 more") + 8, 20);

    QCOMPARE(label.text(), QStringLiteral("EPI_L 1.25 px · +2 more"));
    QCOMPARE(label.toolTip(), QString("EPI_L 1.25 px\nEPI_S 1.31 px\nST_CH_L 1.30 px"));
  }
};

}  // namespace episcope::in_elided_label_test

EPISCOPE_WINDOW_TEST(elided_label_test, ElidedLabelTest)
#include "elided_label_test.moc"
