// SPDX-License-Identifier: BSD-3-Clause
#include "tests/window_test_main.h"
#include "widgets/panels/method_panel.h"

#include <QListWidget>
#include <QPushButton>
#include <QScrollBar>

namespace episcope::in_batch_dialog_test {
namespace {

const QString kLong = "a light field whose name takes seventy letters or so, as a sentence does";

}  // namespace

class BatchDialogTest : public QObject {
  Q_OBJECT

 private slots:
  void longNames_areShortened_andWholeInTheirTips();
  void button_countsRuns();
};

void BatchDialogTest::longNames_areShortened_andWholeInTheirTips() {
  BatchDialog dialog({{"epi_l", "EPI_L", true}}, {{"1", kLong, true}, {"2", "short", true}},
                     nullptr);
  dialog.show();
  QVERIFY(QTest::qWaitForWindowExposed(&dialog));

  const auto& scenes = *dialog.findChild<QListWidget*>("batch.scenes");
  QVERIFY(!scenes.horizontalScrollBar()->isVisible());
  QCOMPARE(scenes.textElideMode(), Qt::ElideMiddle);
  QCOMPARE(scenes.item(0)->toolTip(), kLong);
  QVERIFY(dialog.width() < 700);
}

void BatchDialogTest::button_countsRuns() {
  BatchDialog dialog({{"epi_l", "EPI_L", true}, {"st_ch_l", "ST_CH_L", false}},
                     {{"1", "one", true}, {"2", "two", true}}, nullptr);
  auto& methods = *dialog.findChild<QListWidget*>("batch.methods");
  const auto& run = *dialog.findChild<QPushButton*>("batch.run");
  QCOMPARE(run.text(), QString("Run (2)"));

  methods.item(1)->setCheckState(Qt::Checked);
  QCOMPARE(run.text(), QString("Run (4)"));
  QCOMPARE(dialog.methods(), (QStringList{"epi_l", "st_ch_l"}));

  for (int i = 0; i < methods.count(); ++i) methods.item(i)->setCheckState(Qt::Unchecked);
  QVERIFY(!run.isEnabled());
}

}  // namespace episcope::in_batch_dialog_test

EPISCOPE_WINDOW_TEST(batch_dialog_test, BatchDialogTest)
#include "batch_dialog_test.moc"
