// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/main_window.h"
#include "app/gui/estimate/result_export.h"
#include "app/gui/files/recent_inputs.h"
#include "app/gui/opening/result_opener.h"

#include "app/gui/compare/picture_export.h"
#include "app/gui/frame/commands.h"
#include "app/gui/frame/jobs.h"
#include "app/gui/opening/scene_opener.h"
#include "app/gui/stage/overlay.h"
#include "app/session/session.h"
#include "engine/io/maps/pfm.h"
#include "engine/io/maps/result_file.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/annotate/segment_panel.h"
#include "widgets/browse/epi_pane.h"
#include "widgets/browse/info_panel.h"
#include "widgets/browse/value_bar.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/compare/overlay_bar.h"
#include "widgets/controls/job_panel.h"
#include "widgets/controls/message_bar.h"

#include <QAction>
#include <QClipboard>
#include <QDoubleSpinBox>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QMimeData>
#include <QRegularExpression>
#include <QScrollArea>
#include <QScrollBar>
#include <QTabBar>
#include <QTabWidget>
#include <QTableWidget>
#include <QToolBar>
#include <QTreeWidget>
#include <QUrl>

#include <cmath>
#include <limits>

namespace episcope::in_main_window_test {

namespace {

void click_pixel(ViewCanvas* canvas, PixelIndex pixel, Qt::KeyboardModifiers keys = {}) {
  QTest::mouseClick(canvas, Qt::LeftButton, keys, canvas->positionOf(pixel).toPoint());
}

void click_action(MainWindow& window, const QString& id) {
  QWidget* button =
      window.findChild<QToolBar*>()->widgetForAction(window.bench().commands.find(id));
  QVERIFY2(button && button->isEnabled(), qPrintable(id));
  QTest::mouseClick(button, Qt::LeftButton);
}

}  // namespace

class MainWindowTest : public QObject {
  Q_OBJECT

 private slots:
  void openedFile_isShown();
  void emptyWindow_saysWhatToDo();
  void builtinScene_isEstimatedAtOnce();
  void run_listsItsResultWithItsError();
  void errorOverlay_isOneClickAway();
  void arrows_changeTheView();
  void click_movesTheCrossHairAndTheEpis();
  void shiftClick_focusesAtThePixel();
  void valuesAtTheCursor_areRead();
  void heldTab_flips();
  void exportedResult_readsBack();
  void exportedMap_marksInvalidPixels();
  void hugeTruth_leavesTheLayoutAlone();
  void unknownSuffix_isNotWritten();
  void chosenForm_namesTheFile();
  void savedPicture_isTheShownOne();
  void failedExport_isTold();
  void brokenFile_isToldAndKeepsTheScene();
  void brokenFile_withoutScene_isDrawnAsError();
  void brokenFile_ofTheDialog_isTold();
  void droppedFile_isOpened();
  void openedResult_isListed();
  void resultOfAnotherLightField_isRefused();
  void resultOfOtherSamples_isOpenedWithAWarning();
  void lightField_isNoResult();
  void copiedMetrics_areTold();
  void formOfTheFirstMethod_isSeenWhole();
  void escape_cancelsTheRun();
  void anotherScene_dropsResults();
  void closedScene_leavesTheEmptyWindow();
  void copiedCommand_opensTheSameFile();
  void recentFiles_areRemembered();
  void compareTab_showsTheMainMetricsWithoutScrolling();
  void largerWindow_givesItsRoomToTheView();
  void smallWindow_showsEveryButton();
};

void MainWindowTest::openedFile_isShown() {
  WindowFixture f;
  f.openSmall();

  QCOMPARE(f.window.bench().stage.canvas()->state(), ViewCanvas::State::Picture);
  QVERIFY2(f.window.windowTitle().contains("edge"), qPrintable(f.window.windowTitle()));
}

void MainWindowTest::emptyWindow_saysWhatToDo() {
  WindowFixture f;

  QCOMPARE(f.window.bench().stage.canvas()->state(), ViewCanvas::State::Empty);
  QVERIFY(!f.window.bench().commands.find("estimate.run")->isEnabled());
  QVERIFY(!f.window.bench().commands.find("overlay.error")->isEnabled());
  QVERIFY(f.window.findChild<SegmentPanel*>()->state().isEmpty());  // nothing to segment
}

void MainWindowTest::builtinScene_isEstimatedAtOnce() {
  WindowFixture f;

  f.window.bench().opener.open("demo:fronto");

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.estimates().size(), 1U, kScenePatience);
  QTRY_VERIFY_WITH_TIMEOUT(!f.window.bench().overlay.picture().isNull(), kPatience);
  QVERIFY(f.window.bench().commands.find("overlay.error")->isEnabled());
}

void MainWindowTest::run_listsItsResultWithItsError() {
  WindowFixture f;
  f.openSmall();

  f.runAndWait();

  const auto* tree = f.window.findChild<QTreeWidget*>("results.tree");
  QCOMPARE(tree->topLevelItemCount(), 1);
  const auto row_text = [tree] {
    QString text;
    for (int i = 0; i < tree->columnCount(); ++i) text += tree->topLevelItem(0)->text(i) + '|';
    return text;
  };
  QTRY_VERIFY2_WITH_TIMEOUT(row_text().contains(QRegularExpression("\\d+\\.\\d\\d\\|.*s\\|")),
                            qPrintable(row_text()), kPatience);
  QCOMPARE(f.window.bench().overlay.quantity(), render::Quantity::Disparity);
}

void MainWindowTest::errorOverlay_isOneClickAway() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  QTRY_VERIFY_WITH_TIMEOUT(!f.window.bench().overlay.picture().isNull(), kPatience);
  const QImage before = f.window.bench().overlay.picture();
  const QImage canvas_before = f.window.bench().stage.canvas()->grab().toImage();

  click_action(f.window, "overlay.error");

  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().overlay.picture() != before, kPatience);
  QVERIFY(f.window.bench().stage.canvas()->grab().toImage() != canvas_before);
  QVERIFY(f.window.bench().commands.find("overlay.error")->isChecked());
}

void MainWindowTest::arrows_changeTheView() {
  WindowFixture f;
  f.openSmall();
  auto* canvas = f.window.bench().stage.canvas();
  const Session& session = f.window.bench().session;
  canvas->setFocus();
  f.window.activateWindow();
  QTRY_VERIFY_WITH_TIMEOUT(canvas->hasFocus(), kPatience);
  const QImage before = canvas->picture();

  QTest::keyClick(canvas, Qt::Key_Right);
  QVERIFY(session.view() == (ViewIndex{4, 5}));
  QTest::keyClick(canvas, Qt::Key_Up);
  QVERIFY(session.view() == (ViewIndex{3, 5}));
  QTRY_VERIFY_WITH_TIMEOUT(canvas->picture() != before, kPatience);
  QTest::keyClick(canvas, Qt::Key_Left, Qt::ShiftModifier);
  QVERIFY(session.view() == (ViewIndex{3, 0}));
  QTest::keyClick(canvas, Qt::Key_Home);

  QVERIFY(session.view() == (ViewIndex{4, 4}));
}

void MainWindowTest::click_movesTheCrossHairAndTheEpis() {
  WindowFixture f;
  f.openSmall();
  auto* epi = f.window.bench().stage.horizontalEpi();
  const QImage before = epi->grab().toImage();

  click_pixel(f.window.bench().stage.canvas(), {20, 33});

  QVERIFY(f.window.bench().session.cross_hair() == (PixelIndex{20, 33}));
  QTRY_VERIFY_WITH_TIMEOUT(epi->grab().toImage() != before, kPatience);
}

void MainWindowTest::shiftClick_focusesAtThePixel() {
  WindowFixture f;
  f.openSmall();
  const double truth =
      f.window.bench().session.scene()->truth->field.view({4, 4}).disparity.at(20, 33);

  click_pixel(f.window.bench().stage.canvas(), {20, 33}, Qt::ShiftModifier);

  QCOMPARE(f.window.bench().session.focus_px(), truth);
}

void MainWindowTest::valuesAtTheCursor_areRead() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  auto* canvas = f.window.bench().stage.canvas();

  QTest::mouseMove(canvas, canvas->positionOf({20, 33}).toPoint());

  const auto text = [&f] { return f.window.findChild<ValueBar*>()->text(); };
  QTRY_VERIFY2_WITH_TIMEOUT(text().contains("x 33 y 20"), qPrintable(text()), kPatience);
  QVERIFY2(text().contains("truth") && text().contains("EPI_L"), qPrintable(text()));
}

void MainWindowTest::heldTab_flips() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  auto* canvas = f.window.bench().stage.canvas();
  canvas->setFocus();
  QTRY_VERIFY_WITH_TIMEOUT(!f.window.bench().overlay.picture().isNull(), kPatience);
  const QImage before = f.window.bench().overlay.picture();

  QTest::keyPress(canvas, Qt::Key_Tab);
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().overlay.picture() != before, kPatience);
  QTest::keyRelease(canvas, Qt::Key_Tab);

  QCOMPARE(f.window.bench().overlay.picture(), before);
}

void MainWindowTest::exportedResult_readsBack() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  const EstimateEntry& shown = *f.window.bench().session.shown();
  const QString path = f.path("résult 1.h5");

  export_result(f.window.bench(), shown, path);
  QTRY_VERIFY_WITH_TIMEOUT(f.window.findChild<MessageBar*>("messageBar")->text().contains(path),
                           kPatience);

  const Estimate read = io::read_result(path.toStdString(), {9, 9});
  QCOMPARE(read.method, std::string("epi_l"));
  QCOMPARE(read.source_hash, f.window.bench().session.light_field()->sample_hash());
  const auto& written = shown.estimate->field.disparity;
  QCOMPARE(read.field.disparity.size(), written.size());
  for (std::size_t i = 0; i < written.size(); ++i) {
    const bool is_valid =
        shown.estimate->field.valid.empty() || shown.estimate->field.valid.data()[i] != 0;
    if (is_valid) QCOMPARE(read.field.disparity.data()[i], written.data()[i]);
  }
}

void MainWindowTest::exportedMap_marksInvalidPixels() {
  WindowFixture f;
  f.openSmall();
  const Scene& scene = *f.window.bench().session.scene();
  auto estimate = std::make_shared<Estimate>();
  estimate->method = "theirs";
  estimate->field.disparity = scene.truth->field.disparity.clone();
  estimate->field.disparity.view({4, 4}).at(2, 3) = std::numeric_limits<float>::quiet_NaN();
  const int id = f.window.bench().session.add_estimate(estimate, {-1, 1},
                                                       f.window.bench().session.generation());

  export_result(f.window.bench(), *f.window.bench().session.find_estimate(id), f.path("map.pfm"));
  QTRY_VERIFY_WITH_TIMEOUT(
      f.window.findChild<MessageBar*>("messageBar")->text().contains("map.pfm"), kPatience);

  const Image<float> map = io::read_pfm(f.path("map.pfm").toStdString());
  QVERIFY(std::isnan(map.at(2, 3)));
  QCOMPARE(map.at(9, 9), scene.truth->field.view({4, 4}).disparity.at(9, 9));
}

void MainWindowTest::hugeTruth_leavesTheLayoutAlone() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  const int width = f.window.bench().stage.canvas()->width();
  auto scene = std::make_shared<Scene>(
      scenes::render_builtin("edge", WindowFixture::smallOptions(), Progress()));
  auto truth = std::make_shared<GroundTruth>();
  truth->field.disparity = scene->truth->field.disparity.clone();
  truth->field.disparity.view({4, 4}).at(0, 0) = 1e30F;
  scene->truth = truth;

  f.window.bench().session.open(scene, "edge");
  f.window.bench().overlay.setQuantity(render::Quantity::Truth);
  f.trigger("tab.compare");

  const auto* focus = f.window.findChild<QDoubleSpinBox*>("overlay.focusSpin");
  QVERIFY(focus->maximum() <= 100);
  const auto* max = f.window.findChild<QLabel*>("statistics.max");
  QTRY_VERIFY2_WITH_TIMEOUT(max->text().startsWith("1e"), qPrintable(max->text()), kPatience);
  QCOMPARE(f.window.bench().stage.canvas()->width(), width);
}

void MainWindowTest::unknownSuffix_isNotWritten() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();

  export_result(f.window.bench(), *f.window.bench().session.shown(), f.path("result.jpg"));

  const MessageBar* messages = f.window.findChild<MessageBar*>("messageBar");
  QVERIFY2(messages->text().contains(".pfm"), qPrintable(messages->text()));
  QCOMPARE(messages->severity(), Severity::Warning);
  QCOMPARE(f.window.bench().jobs.count(), 0);
}

void MainWindowTest::chosenForm_namesTheFile() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  f.window.bench().commands.trigger("file.export");
  auto* dialog = f.window.findChild<QFileDialog*>();
  const QStringList forms = dialog->nameFilters();

  emit dialog->filterSelected(forms[1]);

  QVERIFY2(forms[1].contains("*.pfm"), qPrintable(forms[1]));
  QCOMPARE(QFileInfo(dialog->selectedFiles().value(0)).suffix(), QString("pfm"));
  QCOMPARE(dialog->defaultSuffix(), QString("pfm"));
}

void MainWindowTest::savedPicture_isTheShownOne() {
  WindowFixture f;
  f.openSmall();

  save_picture(f.window.bench(), f.path("view.png"));
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(f.path("view.png")), kPatience);
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kPatience);

  const QImage saved = QImage(f.path("view.png")).convertToFormat(QImage::Format_RGB888);
  QCOMPARE(saved,
           f.window.bench().stage.canvas()->picture().convertToFormat(QImage::Format_RGB888));
}

void MainWindowTest::failedExport_isTold() {
  WindowFixture f;
  f.openSmall();
  const QString path = f.path("no/such/folder/view.png");

  save_picture(f.window.bench(), path);

  const MessageBar* messages = f.window.findChild<MessageBar*>("messageBar");
  QTRY_VERIFY2_WITH_TIMEOUT(messages->text().contains(path), qPrintable(messages->text()),
                            kPatience);
  QCOMPARE(messages->severity(), Severity::Error);
}

void MainWindowTest::brokenFile_isToldAndKeepsTheScene() {
  WindowFixture f;
  f.openSmall();
  const auto scene = f.window.bench().session.scene();
  QFile broken(f.path("broken.h5"));
  QVERIFY(broken.open(QIODevice::WriteOnly));
  broken.write("this is no HDF5 file");
  broken.close();

  f.window.bench().opener.open(broken.fileName());

  const MessageBar* messages = f.window.findChild<MessageBar*>("messageBar");
  QTRY_VERIFY2_WITH_TIMEOUT(messages->text().contains("broken.h5"), qPrintable(messages->text()),
                            kPatience);
  QVERIFY(messages->isVisible());
  QCOMPARE(f.window.bench().session.scene(), scene);
  QCOMPARE(f.window.bench().stage.canvas()->state(), ViewCanvas::State::Picture);
}

void MainWindowTest::brokenFile_withoutScene_isDrawnAsError() {
  WindowFixture f;

  f.window.bench().opener.open("/no/such/place");

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().stage.canvas()->state(), ViewCanvas::State::Failed,
                            kPatience);
}

void MainWindowTest::droppedFile_isOpened() {
  WindowFixture f;
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(f.writeScene("slant", WindowFixture::smallOptions()))});
  QDragEnterEvent enter({200, 200}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QDropEvent drop(QPointF(200, 200), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);

  QCoreApplication::sendEvent(&f.window, &enter);
  QVERIFY(enter.isAccepted());
  QCoreApplication::sendEvent(&f.window, &drop);

  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().session.scene() != nullptr, kPatience);
}

void MainWindowTest::openedResult_isListed() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  const QString path = f.path("result.h5");
  export_result(f.window.bench(), *f.window.bench().session.shown(), path);
  QTRY_VERIFY_WITH_TIMEOUT(f.window.findChild<MessageBar*>("messageBar")->text().contains(path),
                           kPatience);

  f.window.bench().results.open(path);

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.estimates().size(), 2U, kPatience);
  QCOMPARE(f.window.bench().session.estimates()[1].name, std::string("EPI_L 2"));
}

// It has the signature of HDF5, and ends there.
void MainWindowTest::brokenFile_ofTheDialog_isTold() {
  WindowFixture f;
  f.openSmall();
  QFile file(f.path("broken.h5"));
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write(QByteArray("\x89HDF\r\n\x1a\n").append(QByteArray(200, '\0')));
  file.close();
  f.trigger("file.open");
  auto* dialog = f.window.findChild<QFileDialog*>();

  emit dialog->fileSelected(file.fileName());

  const MessageBar* messages = f.window.findChild<MessageBar*>("messageBar");
  QTRY_VERIFY2_WITH_TIMEOUT(messages->text().contains("broken.h5"), qPrintable(messages->text()),
                            kPatience);
  QCOMPARE(messages->severity(), Severity::Error);
}

void MainWindowTest::resultOfOtherSamples_isOpenedWithAWarning() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  Estimate foreign;
  foreign.field.disparity = f.window.bench().session.shown()->estimate->field.disparity.clone();
  foreign.method = "epi_l";
  foreign.source_hash = f.window.bench().session.light_field()->sample_hash() + 1;
  io::write_result(f.path("foreign.h5").toStdString(), foreign, Progress());

  f.window.bench().results.open(f.path("foreign.h5"));

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.estimates().size(), 2U, kPatience);
  const MessageBar* messages = f.window.findChild<MessageBar*>("messageBar");
  QTRY_VERIFY2_WITH_TIMEOUT(messages->text().contains("other samples"),
                            qPrintable(messages->text()), kPatience);
  QCOMPARE(messages->severity(), Severity::Warning);
}

// Its true depth would be taken for disparity.
void MainWindowTest::lightField_isNoResult() {
  WindowFixture f;
  f.openSmall();

  f.window.bench().results.open(f.path("edge/lf.h5"));

  const MessageBar* messages = f.window.findChild<MessageBar*>("messageBar");
  QTRY_VERIFY2_WITH_TIMEOUT(messages->text().contains("no estimated disparity"),
                            qPrintable(messages->text()), kPatience);
  QVERIFY(f.window.bench().session.estimates().empty());
}

void MainWindowTest::copiedMetrics_areTold() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  f.trigger("tab.compare");

  f.click("metrics.copyLatex");

  const QString text = f.window.findChild<MessageBar*>("messageBar")->text();
  QVERIFY2(text.contains("Copied") && text.contains("LaTeX"), qPrintable(text));
  QVERIFY(QGuiApplication::clipboard()->text().startsWith("\\begin{tabular}"));
}

void MainWindowTest::formOfTheFirstMethod_isSeenWhole() {
  WindowFixture f;
  f.openSmall();

  const auto* scroll = f.window.findChild<QScrollArea*>("method.scroll");

  QTRY_COMPARE_WITH_TIMEOUT(scroll->verticalScrollBar()->maximum(), 0, kPatience);
  // Nor is room wasted under it.
  QVERIFY(scroll->viewport()->height() < scroll->widget()->sizeHint().height() + 40);
}

void MainWindowTest::resultOfAnotherLightField_isRefused() {
  WindowFixture f;
  f.openSmall();
  io::write_pfm(f.path("other.pfm").toStdString(), Image<float>(50, 40));

  f.window.bench().results.open(f.path("other.pfm"));

  const MessageBar* messages = f.window.findChild<MessageBar*>("messageBar");
  QTRY_VERIFY2_WITH_TIMEOUT(messages->text().contains("40×50"), qPrintable(messages->text()),
                            kPatience);
  QVERIFY(f.window.bench().session.estimates().empty());
}

void MainWindowTest::escape_cancelsTheRun() {
  WindowFixture f;
  f.openSmall();
  auto* canvas = f.window.bench().stage.canvas();
  canvas->setFocus();
  f.window.activateWindow();
  // However quick the machine is, this one is still running and keeps the next one waiting.
  f.window.bench().jobs.start<int>(
      Lane::Estimate, "endless",
      [](const Progress& progress) -> int {
        while (true) progress.check();
      },
      [](int) {});
  f.window.bench().commands.find("estimate.run")->trigger();
  QCOMPARE(f.window.bench().jobs.count(), 2);

  QTest::keyClick(canvas, Qt::Key_Escape);
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 1, kPatience);
  QTest::keyClick(canvas, Qt::Key_Escape);
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kPatience);

  QVERIFY(f.window.bench().session.estimates().empty());
  QVERIFY(f.window.findChild<MessageBar*>("messageBar")->text().isEmpty());
}

void MainWindowTest::anotherScene_dropsResults() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  const auto former = f.window.bench().session.generation();

  f.window.bench().opener.open(f.writeScene("slant", WindowFixture::smallOptions()));

  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().session.generation() > former, kPatience);
  QVERIFY(f.window.bench().session.estimates().empty());
  QTRY_COMPARE_WITH_TIMEOUT(f.window.findChild<QTreeWidget*>("results.tree")->topLevelItemCount(),
                            0, kPatience);
}

void MainWindowTest::closedScene_leavesTheEmptyWindow() {
  WindowFixture f;
  f.openSmall();

  f.window.bench().commands.find("file.close")->trigger();

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().stage.canvas()->state(), ViewCanvas::State::Empty,
                            kPatience);
  QCOMPARE(f.window.windowTitle(), QString("Episcope"));
}

void MainWindowTest::copiedCommand_opensTheSameFile() {
  WindowFixture f;
  f.openSmall();

  f.window.bench().commands.find("estimate.copy_command")->trigger();

  const QString text = QGuiApplication::clipboard()->text();
  QVERIFY2(text.startsWith("episcope-cli estimate epi_l "), qPrintable(text));
  QVERIFY2(text.contains(f.path("edge/lf.h5")), qPrintable(text));
}

void MainWindowTest::recentFiles_areRemembered() {
  WindowFixture f;
  f.openSmall();

  QCOMPARE(recent_inputs(), QStringList(f.path("edge/lf.h5")));
  forget_recent();
  QVERIFY(recent_inputs().isEmpty());
}

void MainWindowTest::compareTab_showsTheMainMetricsWithoutScrolling() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  auto* tabs = f.window.findChild<QTabWidget*>()->tabBar();
  QTest::mouseClick(tabs, Qt::LeftButton, {}, tabs->tabRect(1).center());
  const auto* table = f.window.findChild<QTableWidget*>("metrics.table");
  QTRY_VERIFY_WITH_TIMEOUT(table->isVisible() && table->columnCount() > 7, kPatience);

  const QStringList wanted = {"Result",        "2013\nMSE×100", "2016\nMSE×100", "2016\nbad .07",
                              "2016\nbad .03", "2016\nbad .01", "2016\nQ25"};
  for (int column = 0; column < wanted.size(); ++column) {
    QCOMPARE(table->horizontalHeaderItem(column)->text(), wanted[column]);
    QVERIFY(!table->horizontalHeaderItem(column)->toolTip().isEmpty());
  }
  const int end = table->columnViewportPosition(6) + table->columnWidth(6);
  QVERIFY2(end <= table->viewport()->width(),
           qPrintable(QString("%1 > %2").arg(end).arg(table->viewport()->width())));
}

void MainWindowTest::largerWindow_givesItsRoomToTheView() {
  WindowFixture f;
  f.openSmall();
  const int side = f.window.findChild<InfoPanel*>()->width();
  const int tabs = f.window.findChild<QTabWidget*>()->width();
  const int view = f.window.bench().stage.canvas()->width();

  f.window.resize(2560, 1440);

  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().stage.canvas()->width() > view + 1000, kPatience);
  QCOMPARE(f.window.findChild<InfoPanel*>()->width(), side);
  QCOMPARE(f.window.findChild<QTabWidget*>()->width(), tabs);
}

void MainWindowTest::smallWindow_showsEveryButton() {
  WindowFixture f;
  f.openSmall();
  f.window.bench().stage.overlayBar()->setFocusRange({-30, 30});  // wide numbers
  for (int job = 0; job < 10; ++job) f.window.findChild<JobPanel*>()->addJob(100 + job, "EPI_L");
  f.window.resize(1280, 800);
  QCoreApplication::processEvents();

  QVERIFY2(f.window.minimumSizeHint().height() <= 800,
           qPrintable(QString::number(f.window.minimumSizeHint().height())));
  QVERIFY2(f.window.size() == QSize(1280, 800), qPrintable(QString::number(f.window.width())));
  const QToolBar* bar = f.window.findChild<QToolBar*>();
  for (QAction* action : bar->actions()) {
    const QWidget* button = bar->widgetForAction(action);
    QVERIFY2(button && button->isVisible(), qPrintable(action->objectName()));
    QVERIFY2(bar->rect().contains(button->geometry()), qPrintable(action->objectName()));
  }
}

}  // namespace episcope::in_main_window_test

EPISCOPE_WINDOW_TEST(main_window_test, MainWindowTest)
#include "main_window_test.moc"
