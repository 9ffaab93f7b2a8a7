// SPDX-License-Identifier: BSD-3-Clause
// What was computed is not lost by mistake.
#include "app/gui/estimate/estimate_controller.h"
#include "app/gui/files/project_controller.h"
#include "app/gui/scene/scene_switcher.h"
#include "app/session/project_file.h"
#include "engine/io/models/result_file.h"
#include "tests/app/gui/held_lane.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/controls/message_bar.h"
#include "widgets/panels/metric_table.h"

#include <QAction>
#include <QApplication>
#include <QFileDialog>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QTreeWidget>

namespace episcope::in_kept_results_test {

namespace {

class Working : public WindowFixture {
 public:
  Working() { openSmall(); }
  Session& session() { return window.bench().session; }
  QMessageBox* question() {
    auto* box = window.findChild<QMessageBox*>("unsaved_results");
    return box && box->isVisible() ? box : nullptr;
  }
  void answer(QMessageBox::StandardButton button) {
    QTRY_VERIFY(question());
    QTest::mouseClick(question()->button(button), Qt::LeftButton);
  }
  void startEndless() {
    window.bench().jobs.start<int>(
        Lane::Estimate, "endless",
        [](const Progress& progress) -> int {
          while (true) progress.check();
        },
        [](int) {});
  }
  /// Through the dialog; waits until it is written, or asked about.
  void exportTo(const QString& file) {
    trigger("file.export");
    auto* dialog = window.findChild<QFileDialog*>("export_result");
    QVERIFY(dialog);
    emit dialog->fileSelected(file);
    dialog->close();
    QTRY_COMPARE_WITH_TIMEOUT(window.bench().jobs.count(), 0, kScenePatience);
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  }
  /// Another program writes a result of its own into a file.
  void changeByOthers(const QString& file) {
    Estimate theirs = io::read_result(file.toStdString(), session().light_field()->grid());
    theirs.method = "st_ch_l";
    io::write_result(file.toStdString(), theirs, Progress());
  }
  QTreeWidget* tree() { return window.findChild<QTreeWidget*>("results.tree"); }
};

}  // namespace

class KeptResultsTest : public QObject {
  Q_OBJECT

 private slots:
  void removedResult_canBeBroughtBack();
  void severalRemovedResults_comeBackInTheirPlaces();
  void renamedResult_keepsItsName();
  void copiedTable_saysWhereNumbersComeFrom();
  void anotherScene_leavesResultsWhereTheyAre();
  void closedScene_asksForUnsavedResults();
  void quit_asksForUnsavedResults();
  void saveAll_writesThemAndGoesOn();
  void exportedResult_isNotAskedFor();
  void changedResultFile_isNotOverwrittenSilently_data();
  void changedResultFile_isNotOverwrittenSilently();
  void ownExport_isNoChangeOnDisk();
  void openedResultFile_isKnown();
  void runningMethod_isAskedFor();
  void fileThatIsBeingWritten_isAskedFor();
  void closedScene_asksForItsOwnJobsAlone();
  void unsavedResult_isNamedWithItsLightField();
};

void KeptResultsTest::removedResult_canBeBroughtBack() {
  Working f;
  f.runAndWait();
  const EstimatePtr estimate = f.session().estimates().front().estimate;

  f.trigger("estimate.remove");
  QCOMPARE(f.session().estimates().size(), 0U);
  auto* bar = f.window.findChild<MessageBar*>("messageBar");
  QTest::mouseClick(bar->findChild<QPushButton*>("message.action"), Qt::LeftButton);

  QCOMPARE(f.session().estimates().size(), 1U);
  QCOMPARE(f.session().shown()->estimate, estimate);
  QCOMPARE(f.session().shown()->name, std::string("EPI_L"));
}

void KeptResultsTest::severalRemovedResults_comeBackInTheirPlaces() {
  Working f;
  for (int i = 0; i < 3; ++i) f.runAndWait();
  const auto names = [&f] {
    QStringList all;
    for (const auto& each : f.session().estimates()) all << QString::fromStdString(each.name);
    return all;
  };
  const QStringList before = names();
  f.session().show_estimate(f.session().estimates().front().id);
  QCoreApplication::processEvents();

  f.trigger("estimate.remove");
  QCoreApplication::processEvents();
  f.trigger("estimate.remove");
  QCoreApplication::processEvents();
  f.trigger("estimate.restore");
  f.trigger("estimate.restore");

  QCOMPARE(names(), before);
  QCoreApplication::processEvents();
  QVERIFY(!f.window.bench().commands.find("estimate.restore")->isEnabled());
}

void KeptResultsTest::renamedResult_keepsItsName() {
  Working f;
  f.runAndWait();
  QTreeWidgetItem* item = f.tree()->topLevelItem(0);
  const QPoint name = f.tree()->visualItemRect(item).center();
  const QPoint at(f.tree()->columnViewportPosition(1) + 8, name.y());

  QTest::mouseClick(f.tree()->viewport(), Qt::LeftButton, {}, at);
  QTest::mouseDClick(f.tree()->viewport(), Qt::LeftButton, {}, at);
  auto* editor = f.tree()->viewport()->findChild<QLineEdit*>();
  QVERIFY(editor);
  editor->selectAll();
  QTest::keyClicks(editor, "with my defaults");
  QTest::keyClick(editor, Qt::Key_Return);
  const auto first = [&f] { return QString::fromStdString(f.session().estimates().front().name); };
  QTRY_COMPARE(first(), QString("with my defaults"));
  f.runAndWait();

  QCOMPARE(first(), QString("with my defaults"));
  QCOMPARE(f.session().estimates().back().name, std::string("EPI_L"));
  QTRY_COMPARE(QApplication::focusWidget() != editor, true);
}

void KeptResultsTest::copiedTable_saysWhereNumbersComeFrom() {
  Working f;
  find<EstimateController>(f.window).run({"epi_l", {{"inner_scale", 1.0}}, {}});
  QTRY_COMPARE_WITH_TIMEOUT(f.session().estimates().size(), 1U, kScenePatience);
  f.session().rename_estimate(f.session().estimates().front().id, "wide");
  const MetricTable& table = find<MetricTable>(f.window);

  QTRY_VERIFY2_WITH_TIMEOUT(table.toCsv().contains("edge,epi_l,\"inner_scale=1 searched=-"),
                            qPrintable(table.toCsv()), kPatience);
  QTRY_VERIFY(table.toCsv().contains("\nwide,"));
}

void KeptResultsTest::anotherScene_leavesResultsWhereTheyAre() {
  Working f;
  f.runAndWait();
  const auto first = f.session().generation();
  const EstimatePtr estimate = f.session().estimates().front().estimate;

  f.openSmall("slant");
  QVERIFY(!f.question());
  QCOMPARE(f.session().estimates().size(), 0U);
  f.window.bench().scenes.show(first);

  QCOMPARE(f.session().estimates().size(), 1U);
  QCOMPARE(f.session().shown()->estimate, estimate);
}

void KeptResultsTest::closedScene_asksForUnsavedResults() {
  Working f;
  f.runAndWait();

  f.trigger("file.close");
  f.answer(QMessageBox::Cancel);
  QCOMPARE(f.session().estimates().size(), 1U);

  f.trigger("file.close");
  f.answer(QMessageBox::Discard);
  QTRY_VERIFY(!f.session().scene());
}

void KeptResultsTest::quit_asksForUnsavedResults() {
  Working f;
  f.runAndWait();

  f.trigger("file.quit");
  QTRY_VERIFY(f.question());
  QVERIFY2(f.question()->text().contains("EPI_L"), qPrintable(f.question()->text()));
  f.answer(QMessageBox::Cancel);
  QVERIFY(f.window.isVisible());

  f.trigger("file.quit");
  f.answer(QMessageBox::Discard);
  QTRY_VERIFY(!f.window.isVisible());
}

void KeptResultsTest::saveAll_writesThemAndGoesOn() {
  Working f;
  f.runAndWait();
  const EstimatePtr estimate = f.session().estimates().front().estimate;

  f.trigger("file.quit");
  f.answer(QMessageBox::SaveAll);
  auto* dialog = f.window.findChild<QFileDialog*>("save_project");
  QVERIFY(dialog);
  emit dialog->fileSelected(f.path("work.episcope"));
  QTRY_VERIFY_WITH_TIMEOUT(!f.window.isVisible(), kScenePatience);

  const Project project = read_project(f.path("work.episcope").toStdString());
  QCOMPARE(project.scenes.size(), 1U);
  const LightField& light_field = *f.session().light_field();
  const Estimate read = io::read_result(project.scenes[0].estimates.at(0).kept, light_field.grid(),
                                        light_field.info().name);
  QCOMPARE(read.method, estimate->method);
}

void KeptResultsTest::exportedResult_isNotAskedFor() {
  Working f;
  f.runAndWait();

  f.trigger("file.export");
  auto* dialog = f.window.findChild<QFileDialog*>("export_result");
  QVERIFY(dialog);
  emit dialog->fileSelected(f.path("kept.h5"));
  dialog->close();
  QTRY_VERIFY_WITH_TIMEOUT(f.session().estimates().front().is_saved, kScenePatience);

  f.trigger("file.quit");
  QTRY_VERIFY(!f.window.isVisible());
}

void KeptResultsTest::changedResultFile_isNotOverwrittenSilently_data() {
  QTest::addColumn<QString>("button");
  QTest::addColumn<QString>("method");  // whose result the file holds then
  QTest::addColumn<int>("results");     // in the list then
  QTest::newRow("cancel") << QString() << "st_ch_l" << 1;
  QTest::newRow("overwrite") << "changed_file.overwrite"
                             << "epi_l" << 1;
  QTest::newRow("reload") << "changed_file.reload"
                          << "st_ch_l" << 2;
}

void KeptResultsTest::changedResultFile_isNotOverwrittenSilently() {
  QFETCH(QString, button);
  QFETCH(QString, method);
  QFETCH(int, results);
  Working f;
  f.runAndWait();
  const QString file = f.path("kept.h5");
  f.exportTo(file);
  f.changeByOthers(file);

  f.exportTo(file);

  auto* box = f.window.findChild<QMessageBox*>("changed_file");
  QVERIFY(box);
  button.isEmpty() ? box->reject() : f.click(button);
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kScenePatience);
  QCOMPARE(f.session().estimates().size(), static_cast<std::size_t>(results));
  QCOMPARE(QString::fromStdString(
               io::read_result(file.toStdString(), f.session().light_field()->grid()).method),
           method);
}

void KeptResultsTest::ownExport_isNoChangeOnDisk() {
  Working f;
  f.runAndWait();
  for (int i = 0; i < 2; ++i) f.exportTo(f.path("kept.h5"));
  f.exportTo(f.path("other.h5"));
  QVERIFY(!f.window.findChild<QMessageBox*>("changed_file"));
}

void KeptResultsTest::openedResultFile_isKnown() {
  Working f;
  f.runAndWait();
  const QString file = f.path("kept.h5");
  io::write_result(file.toStdString(), *f.session().shown()->estimate, Progress());
  f.window.bench().results.open(file);
  QTRY_COMPARE_WITH_TIMEOUT(f.session().estimates().size(), 2U, kScenePatience);
  f.changeByOthers(file);

  f.exportTo(file);

  QVERIFY(f.window.findChild<QPushButton*>("changed_file.elsewhere"));
}

void KeptResultsTest::unsavedResult_isNamedWithItsLightField() {
  Working f;
  f.runAndWait();

  f.trigger("file.quit");

  QTRY_VERIFY(f.question());
  QVERIFY2(f.question()->text().contains("EPI_L · edge"), qPrintable(f.question()->text()));
  f.answer(QMessageBox::Cancel);
}

void KeptResultsTest::runningMethod_isAskedFor() {
  Working f;
  f.startEndless();

  f.trigger("file.quit");
  QTRY_VERIFY(f.question());
  QVERIFY2(f.question()->text().contains("endless (0 %)"), qPrintable(f.question()->text()));
  f.answer(QMessageBox::Cancel);
  QVERIFY(f.window.isVisible());
  QCOMPARE(f.window.bench().jobs.count(Lane::Estimate), 1);

  f.trigger("file.quit");
  f.answer(QMessageBox::Discard);
  QTRY_VERIFY(!f.window.isVisible());
}

// Saved and quit: the file was cut off.
void KeptResultsTest::fileThatIsBeingWritten_isAskedFor() {
  Working f;
  const HeldLane held(f.window.bench().jobs, Lane::Export);

  f.trigger("file.quit");

  QTRY_VERIFY(f.question());
  QVERIFY2(f.question()->text().contains("held (0 %)"), qPrintable(f.question()->text()));
  f.answer(QMessageBox::Cancel);
  QVERIFY(f.window.isVisible());
}

void KeptResultsTest::closedScene_asksForItsOwnJobsAlone() {
  Working f;
  const HeldLane held(f.window.bench().jobs, Lane::Estimate);
  f.trigger("estimate.run");
  f.openSmall("slant");

  f.trigger("file.close");
  QVERIFY(!f.question());
  QTRY_COMPARE(f.session().scenes().size(), 1U);

  QTRY_VERIFY_WITH_TIMEOUT(f.session().scene(), kScenePatience);
  f.trigger("file.close");
  QTRY_VERIFY(f.question());
  QVERIFY2(f.question()->text().contains("EPI_L · edge (0 %)"), qPrintable(f.question()->text()));
  f.answer(QMessageBox::Cancel);
}

}  // namespace episcope::in_kept_results_test

EPISCOPE_WINDOW_TEST(kept_results_test, KeptResultsTest)
#include "kept_results_test.moc"
