// SPDX-License-Identifier: BSD-3-Clause
#include "tests/window_test_main.h"
#include "widgets/controls/labels.h"
#include "widgets/controls/message_bar.h"
#include "widgets/panels/info_panel.h"
#include "widgets/panels/value_bar.h"

#include <QAction>
#include <QClipboard>
#include <QGuiApplication>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QRegularExpression>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalSpy>
#include <QToolButton>

#include <algorithm>

namespace episcope::in_side_panels_test {

class SidePanelsTest : public QObject {
  Q_OBJECT

 private slots:
  void message_mayHaveTwoActions() {
    MessageBar bar;
    int recovered = 0;
    int discarded = 0;
    bar.showMessage(Severity::Warning, "It died.", {"Recover", [&] { ++recovered; }},
                    {"Discard", [&] { ++discarded; }});

    auto* other = bar.findChild<QPushButton*>("message.other");
    QVERIFY(!other->isHidden());
    other->click();

    QCOMPARE(recovered, 0);
    QCOMPARE(discarded, 1);
    QVERIFY(bar.isHidden());
    bar.showMessage(Severity::Warning, "One only.", {"Retry", [] {}});
    QVERIFY(other->isHidden());
  }

  void messageBar_showsActsAndCloses() {
    MessageBar bar;
    QVERIFY(bar.isHidden());
    bool ran = false;

    bar.showMessage(Severity::Error, "lf.h5 is truncated.", {"Open another", [&] { ran = true; }});
    QVERIFY(!bar.isHidden());
    QCOMPARE(bar.text(), QString("lf.h5 is truncated."));
    auto* action = bar.findChild<QPushButton*>("message.action");
    QCOMPARE(action->text(), QString("Open another"));
    action->click();
    QVERIFY(ran);
    QVERIFY(bar.isHidden());

    bar.showMessage(Severity::Info, "Saved.");
    QVERIFY(action->isHidden());
    bar.findChild<QToolButton*>("message.close")->click();
    QVERIFY(bar.isHidden());
  }

  void messageBar_anActionMayShowTheNextMessage() {
    MessageBar bar;

    bar.showMessage(Severity::Warning, "first",
                    {"Retry", [&] { bar.showMessage(Severity::Error, "second"); }});
    bar.findChild<QPushButton*>("message.action")->click();

    QVERIFY(!bar.isHidden());
    QCOMPARE(bar.text(), QString("second"));
  }

  void longPath_doesNotWidenTheMessage() {
    MessageBar bar;
    const QString path =
        "/data/" + QString("long_folder_").repeated(30) + "/" + QString(300, QChar('x')) + "/lf.h5";

    bar.showMessage(Severity::Error, path + ": this is not an HDF5 file");
    bar.resize(600, 100);
    bar.show();
    QVERIFY(QTest::qWaitForWindowExposed(&bar));

    QVERIFY2(bar.minimumSizeHint().width() < 300,
             qPrintable(QString::number(bar.minimumSizeHint().width())));
    QVERIFY(bar.findChild<QLabel*>("message.text")->heightForWidth(500) > 60);
    bar.findChild<QAction*>("message.copy")->trigger();
    QCOMPARE(QGuiApplication::clipboard()->text(), path + ": this is not an HDF5 file");
  }

  void iterativeJob_canEndEarly() {
    JobPanel panel;
    QSignalSpy finish(&panel, &JobPanel::finishRequested);
    panel.addJob(7, "ST_CH_G");
    auto* button = panel.findChild<QToolButton*>("job.7.finish");
    QVERIFY(button->isHidden());

    panel.setIterative(7);
    QVERIFY(button->isHidden());  // what waits has no result so far
    panel.setProgress(7, 0.2, "labeling");
    button->click();
    panel.setFinishing(7);
    panel.setProgress(7, 0.3, "labeling");

    QCOMPARE(finish.size(), 1);
    QCOMPARE(finish[0][0].toULongLong(), quint64(7));
    QVERIFY(!button->isEnabled());
    QVERIFY(panel.findChild<QToolButton*>("job.7.cancel")->isEnabled());
    QCOMPARE(panel.findChild<ElidedLabel*>("job.7.stage")->fullText(), QString("finishing"));
  }

  void jobs_showStageAndAskToCancel() {
    JobPanel panel;
    QSignalSpy cancel(&panel, &JobPanel::cancelRequested);
    panel.addJob(7, "EPI_L");
    panel.addJob(8, "EPI_S");

    panel.setProgress(7, 0.41, "vertical EPIs");

    auto* stage = panel.findChild<ElidedLabel*>("job.7.stage");
    QVERIFY(stage->fullText().startsWith("vertical EPIs · 41 %"));
    QCOMPARE(panel.findChild<QProgressBar*>("job.7.bar")->value(), 410);
    QCOMPARE(panel.findChild<ElidedLabel*>("job.8.stage")->fullText(), QString("waiting"));
    panel.findChild<QToolButton*>("job.7.cancel")->click();
    QCOMPARE(cancel.size(), 1);
    QCOMPARE(cancel[0][0].toULongLong(), quint64(7));
    panel.setCancelling(7);
    panel.setProgress(7, 0.5, "vertical EPIs");
    QCOMPARE(stage->fullText(), QString("cancelling"));
    panel.removeJob(7);
    panel.removeJob(8);
    QCOMPARE(panel.jobCount(), 0);
    QVERIFY(!panel.findChild<QLabel*>("jobPanel.idle")->isHidden());
  }

  void runningJob_isNeverAtTheEnd() {
    JobPanel panel;
    panel.addJob(7, "EPI_L");

    panel.setProgress(7, 1, "vertical EPIs");

    auto* stage = panel.findChild<ElidedLabel*>("job.7.stage");
    QVERIFY2(stage->fullText().contains("99 %"), qPrintable(stage->fullText()));
    const auto* bar = panel.findChild<QProgressBar*>("job.7.bar");
    QVERIFY(bar->value() < bar->maximum());
  }

  void manyJobs_areScrolledTo() {
    JobPanel panel;
    panel.resize(300, panel.sizeHint().height());
    panel.show();
    QVERIFY(QTest::qWaitForWindowExposed(&panel));
    const int empty = panel.height();
    for (quint64 id = 1; id <= 12; ++id) panel.addJob(id, "EPI_L");

    QTest::qWait(20);
    QCOMPARE(panel.height(), empty);
    const auto* scroll = panel.findChild<QScrollArea*>("jobPanel.scroll");
    QTRY_VERIFY(scroll->verticalScrollBar()->maximum() > 0);
    const auto* first = panel.findChild<QToolButton*>("job.1.cancel");
    QVERIFY(!first->visibleRegion().isEmpty());
    for (quint64 id = 3; id <= 12; ++id) panel.removeJob(id);
    QTest::qWait(20);
    QCOMPARE(panel.height(), empty);
  }

  void timeLeft_isTold_data() {
    QTest::addColumn<double>("fraction");
    QTest::addColumn<double>("seconds");
    QTest::addColumn<QString>("text");
    QTest::newRow("too early") << 0.001 << 10.0 << "";
    QTest::newRow("too soon") << 0.11 << 0.6 << "";
    QTest::newRow("seconds") << 0.25 << 4.0 << "about 12 s left";
    QTest::newRow("minutes") << 0.1 << 60.0 << "about 9 min left";
    QTest::newRow("hours") << 0.1 << 3600.0 << "about 9 h 0 min left";
    QTest::newRow("nearly") << 0.9 << 4.0 << "less than 1 s left";
    QTest::newRow("done") << 1.0 << 2.0 << "";
  }

  void timeLeft_isTold() {
    QFETCH(double, fraction);
    QFETCH(double, seconds);
    QFETCH(QString, text);

    QCOMPARE(time_left_text(fraction, seconds), text);
  }

  void values_areWrittenInOneLine() {
    ValueBar bar;

    bar.setReading(PixelReading{{417, 301},
                                "120 88 40",
                                QColor(120, 88, 40),
                                true,
                                0.312,
                                {{"EPI_S", 0.318}, {"EPI_L", 0.3}, {"ST", std::nullopt}}});

    QCOMPARE(bar.text(),
             QString::fromUtf8("x 301 y 417 · rgb 120 88 40 · ground truth 0.312 · EPI_S 0.318 "
                               "(+0.006) · EPI_L 0.300 (−0.012) · ST invalid"));
    const auto* swatch = bar.findChild<QLabel*>("valueBar.swatch");
    QCOMPARE(swatch->pixmap().toImage().pixelColor(5, 5), QColor(120, 88, 40));
  }

  void values_thatDoNotFitAreLeftOutWhole() {
    ValueBar bar;
    std::vector<EstimateReading> seven;
    for (int i = 1; i <= 7; ++i) seven.push_back({QString("EPI_L %1").arg(i), 0.1 * i});
    bar.setReading(PixelReading{{417, 301}, "120 88 40", QColor(), true, 0.312, seven});
    bar.resize(640, 24);
    bar.show();
    QVERIFY(QTest::qWaitForWindowExposed(&bar));

    const auto* line = bar.findChild<QLabel*>("valueBar.values");
    QVERIFY2(line->fontMetrics().horizontalAdvance(line->text()) <= line->width(),
             qPrintable(line->text()));
    static const QRegularExpression whole("^x 301 .*EPI_L 1 [^…]*\\) · \\+\\d more$");
    QVERIFY2(whole.match(line->text()).hasMatch(), qPrintable(line->text()));
    QVERIFY(line->toolTip().contains("EPI_L 7"));
    QVERIFY(bar.text().contains("EPI_L 7"));

    bar.resize(2000, 24);
    QVERIFY(line->text().contains("EPI_L 7") && line->toolTip().isEmpty());
  }

  void values_withoutTruthHaveNoError() {
    ValueBar bar;

    bar.setReading(PixelReading{{1, 2}, "77", Qt::gray, false, {}, {{"EPI_S", -0.5}}});

    QCOMPARE(bar.text(), QString::fromUtf8("x 2 y 1 · grey 77 · EPI_S −0.500"));
  }

  void values_roundedToZeroHaveNoMinus() {
    ValueBar bar;

    bar.setReading(PixelReading{{1, 2}, "77", Qt::gray, true, -0.0004, {{"EPI_S", -0.0006}}});

    QCOMPARE(bar.text(),
             QString::fromUtf8("x 2 y 1 · grey 77 · ground truth 0.000 · EPI_S −0.001 (0.000)"));
  }

  void info_givesEveryFactOneLine() {
    InfoPanel panel;
    panel.resize(180, 300);
    const QString path = "/a/very/long/path/to/a/light/field/in/some/folder/lf.h5";
    const QString formula = "depth in mm, from the parameters of the cfg file";
    panel.setInfo("scene",
                  {{"source", path, "", "source"}, {"units", formula, "as it is stated", "units"}},
                  {{"The order could not be checked."}});
    panel.show();
    QVERIFY(QTest::qWaitForWindowExposed(&panel));

    auto* source = panel.findChild<QLabel*>("info.source");
    QVERIFY(source->text() != path);
    QCOMPARE(source->toolTip(), path);
    auto* units = panel.findChild<FoldedLabel*>("info.units");
    QTRY_VERIFY(units->height() < 1.5 * units->fontMetrics().height());
    QVERIFY(units->text() != formula);
    QVERIFY(units->width() <= panel.width());
    QCOMPARE(panel.findChild<FoldedLabel*>("info.warning")->fullText(),
             QString("The order could not be checked."));
    // All of it is one click away, and stays so when other facts change.
    panel.findChild<QToolButton*>("info.more.units")->click();
    QCOMPARE(panel.findChild<FoldedLabel*>("info.units")->text().simplified(), formula);
    panel.setInfo("scene", {{"units", formula, "as it is stated", "units"}}, {});
    QVERIFY(panel.findChild<FoldedLabel*>("info.units")->isOpen());
  }

  void info_showsWarningsAboveAllElse() {
    InfoPanel panel;
    panel.resize(180, 120);
    std::vector<InfoRow> rows;
    for (int i = 0; i < 20; ++i)
      rows.push_back({"row", "value of it", "", QString("row%1").arg(i)});
    panel.setInfo("scene", rows, {{"A view cannot be used."}});
    panel.show();
    QVERIFY(QTest::qWaitForWindowExposed(&panel));

    const auto* warning = panel.findChild<QLabel*>("info.warning");
    const auto* first = panel.findChild<QLabel*>("info.row0");
    const auto top_of = [&](const QWidget* of) { return of->mapTo(&panel, QPoint(0, 0)).y(); };
    QTRY_VERIFY(!warning->visibleRegion().isEmpty());
    QVERIFY(top_of(warning) < top_of(first));
  }

  void info_showsNotesAsInformation() {
    InfoPanel panel;
    const auto text_color = [&](bool is_note) {
      InfoWarning said{"White picture a.png"};
      said.is_note = is_note;
      panel.setInfo("scene", {}, {said});
      return panel.findChild<QLabel*>("info.warning")->palette().color(QPalette::WindowText);
    };
    QVERIFY(text_color(true) != text_color(false));
    QCOMPARE(text_color(true), panel.palette().color(QPalette::WindowText));
  }

  void info_hidesEvidenceBehindAnArrow() {
    InfoPanel panel;
    panel.resize(180, 300);
    const QString check =
        "checked by the slopes of horizontal and vertical EPIs: correlation 0.88 at 9468 points";
    QAction action("Reverse near and far");
    panel.setInfo("scene", {{"order", "as stored", check, "order", &action}}, {});
    panel.show();
    QVERIFY(QTest::qWaitForWindowExposed(&panel));
    const auto* label = panel.findChild<QLabel*>("info.check");
    const auto* button = panel.findChild<QToolButton*>("info.action");
    QVERIFY(!label->isVisible() && !button->isVisible());

    auto* arrow = panel.findChild<QToolButton*>("info.more.order");
    QTest::mouseClick(arrow, Qt::LeftButton);
    QVERIFY(label->isVisible() && button->isVisible());
    QVERIFY(label->text().simplified().endsWith("points"));
    QTRY_VERIFY(label->height() > 2.5 * label->fontMetrics().height());
    QVERIFY(label->width() <= panel.width());
    QTest::mouseClick(arrow, Qt::LeftButton);
    QVERIFY(!label->isVisible());
  }

  void info_showsShortWarningsWhole() {
    InfoPanel panel;
    panel.resize(205, 400);
    panel.show();
    const QString brief = "Using the inner 7×7 of 9×9 views; the outer ones are dark.";

    panel.setInfo("edge", {}, {InfoWarning{"The whole of it.", brief}});

    auto* label = panel.findChild<FoldedLabel*>("info.warning");
    QTRY_VERIFY(label->width() > 100);
    QCOMPARE(QString(label->text()).replace('\n', ' '), brief);
  }

  void info_offersAnActionOnce() {
    InfoPanel panel;
    QAction conventions("Conventions…");
    panel.setConventionsAction(&conventions);
    panel.setInfo("scene", {}, {{"One thing.", {}, &conventions}, {"Another.", {}, &conventions}});
    panel.show();
    QVERIFY(QTest::qWaitForWindowExposed(&panel));
    const auto shown = [&panel] {
      const auto buttons = panel.findChildren<QToolButton*>();
      return std::ranges::count_if(buttons, [](const QToolButton* each) {
        return each->isVisible() && each->text() == "Conventions…";
      });
    };
    QCOMPARE(shown(), 1);
    panel.setInfo("scene", {}, {{"Nothing to choose."}});
    QCOMPARE(shown(), 1);
  }

  void info_showsTheActionOfWhatNeedsOne() {
    InfoPanel panel;
    QAction reverse("Reverse near and far");
    QAction conventions("Conventions…");
    InfoRow sign{"sign", "not known", "no texture", "sign", &reverse};
    sign.needs_action = true;
    panel.setInfo("scene", {sign}, {{"The samples are dark.", "", &conventions}, {"Odd."}});
    panel.show();
    QVERIFY(QTest::qWaitForWindowExposed(&panel));

    QStringList shown;
    for (const auto* each : panel.findChildren<QToolButton*>("info.action")) {
      if (each->isVisible()) shown << each->text();
    }
    QCOMPARE(shown, (QStringList{"Conventions…", "Reverse near and far"}));
  }

  void info_opensAWarningThatIsTooLong() {
    InfoPanel panel;
    panel.setInfo("scene", {}, {{"Using the inner 10×10 of 14×14 views, rows 2 to 11.", "10×10"}});
    panel.show();
    QVERIFY(QTest::qWaitForWindowExposed(&panel));
    QCOMPARE(panel.findChild<FoldedLabel*>("info.warning")->fullText(), QString("10×10"));
    const auto* text = panel.findChild<QLabel*>("info.warning.text");
    QVERIFY(!text->isVisible());

    panel.findChild<QToolButton*>("info.more.warning")->click();

    QVERIFY(text->isVisible() && text->text().contains("rows 2 to 11"));
  }

  void info_breaksLongNames() {
    InfoPanel panel;
    panel.resize(120, 300);
    panel.setInfo("scene", {}, {{"GT_DEPTH_BACKGROUND_OF_ALL_VIEWS is empty"}});
    panel.show();
    QVERIFY(QTest::qWaitForWindowExposed(&panel));

    const auto* warning = panel.findChild<QLabel*>("info.warning");
    QVERIFY2(warning->minimumSizeHint().width() <= warning->width(),
             qPrintable(
                 QString("%1 > %2").arg(warning->minimumSizeHint().width()).arg(warning->width())));
    QTRY_VERIFY(warning->height() > 1.5 * warning->fontMetrics().height());
  }
};

}  // namespace episcope::in_side_panels_test

EPISCOPE_WINDOW_TEST(side_panels_test, SidePanelsTest)
#include "side_panels_test.moc"
