// SPDX-License-Identifier: BSD-3-Clause
// What a sweep says where there is nothing to plot.
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/controls/line_plot.h"

#include <QComboBox>
#include <QFontMetrics>
#include <QLineEdit>

namespace episcope::in_sweep_texts_test {

class SweepTextsTest : public QObject {
  Q_OBJECT

 private slots:
  void emptyPlot_saysWhatIsToBeDone();
};

void SweepTextsTest::emptyPlot_saysWhatIsToBeDone() {
  WindowFixture f;
  f.key(Qt::Key_F5, Qt::ControlModifier | Qt::ShiftModifier);
  const LinePlot* plot = f.window.findChild<LinePlot*>("sweep.upper");
  QVERIFY(plot);
  QCOMPARE(plot->emptyText(), QString("Open a light field first."));

  f.openSmall();
  QTRY_VERIFY2(plot->emptyText().startsWith("Press Run"), qPrintable(plot->emptyText()));
  const QRect needed =
      QFontMetrics(plot->font())
          .boundingRect(plot->rect(), Qt::AlignCenter | Qt::TextWordWrap, plot->emptyText());
  QVERIFY(plot->rect().contains(needed));

  auto* parameter = f.window.findChild<QComboBox*>("sweep.first");
  const int place = parameter->findData(QString("inner_scale"));
  parameter->setCurrentIndex(place);
  emit parameter->activated(place);
  auto* values = f.window.findChild<QLineEdit*>("sweep.first.values");
  values->selectAll();
  QTest::keyClicks(values, "0.6 0.9");
  f.click("sweep.run");
  QCOMPARE(plot->emptyText(), QString("The first point is being computed."));
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kScenePatience);
}

}  // namespace episcope::in_sweep_texts_test

EPISCOPE_WINDOW_TEST(sweep_texts_test, SweepTextsTest)
#include "sweep_texts_test.moc"
