// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/estimate/result_export.h"
#include "app/gui/files/file_controller.h"
#include "app/gui/files/project_controller.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/session/load_scene.h"
#include "engine/core/error.h"
#include "engine/io/write.h"
#include "tests/app/gui/held_lane.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/epi_pane.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/labels.h"
#include "widgets/controls/message_bar.h"
#include "widgets/controls/number_spin.h"
#include "widgets/controls/parameter_form.h"
#include "widgets/panels/view_grid.h"

#include <QAction>
#include <QComboBox>
#include <QDir>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMessageBox>
#include <QMimeData>
#include <QPushButton>
#include <QSignalSpy>
#include <QTreeWidget>
#include <QUrl>

namespace episcope::in_opening_test {

namespace {

void drop(MainWindow& window, const QStringList& files) {
  QMimeData data;
  QList<QUrl> urls;
  for (const QString& file : files) urls << QUrl::fromLocalFile(file);
  data.setUrls(urls);
  QDragEnterEvent enter({200, 200}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QDropEvent drop(QPointF(200, 200), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(&window, &enter);
  QCoreApplication::sendEvent(&window, &drop);
}

constexpr int kParametersColumn = 4;

void exportShown(WindowFixture& f, const QString& file) {
  export_result(f.window.bench(), *f.window.bench().session.shown(), file);
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kScenePatience);
  QVERIFY(QFile::exists(file));
}

void choose(WindowFixture& f, const QString& file) {
  f.trigger("file.open");
  auto* dialog = f.window.findChild<QFileDialog*>("open_file");
  emit dialog->fileSelected(file);
  dialog->reject();
  QTRY_VERIFY(!f.window.findChild<QFileDialog*>("open_file"));
}

// Whether any pixel is neither grey nor one of the theme's.
bool is_colored(const QImage& picture) {
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      if (picture.pixelColor(x, y).hsvSaturation() > 80) return true;
    }
  }
  return false;
}

}  // namespace

class OpeningTest : public QObject {
  Q_OBJECT

 private slots:
  void openedFile_isShown();
  void folderOfASingleLightField_opensIt();
  void epis_areDrawnBeforeTheChecksEnd();
  void factsAndViews_areNotThoseOfTheFormerWhileAnotherIsRead();
  void readAgain_showsWhatWasWrittenMeanwhile();
  void builtinScene_isEstimatedAtOnce();
  void builtinScenes_areChosenFromAList();
  void randomScene_hasTheSeedAndKindThatWereTyped();
  void brokenFile_isToldAndKeepsTheScene();
  void brokenFile_leavesWhatIsOpenReversible();
  void brokenFile_isToldUntilItIsRead();
  void brokenResult_isToldUntilItIsRead();
  void patternOfNames_isNamedWithItsOption();
  void ownGroundTruth_isNoResult();
  void groundTruthOfAnother_isNotOfferedToIt();
  void brokenFile_withoutScene_isDrawnAsError();
  void brokenFile_ofTheDialog_isTold();
  void failureOfAnotherJob_isNotThatOfOpening();
  void firstDialog_beginsAtHome();
  void dialog_beginsBesideWhatWasOpened();
  void dialog_remembersItsFolder();
  void folderThatIsTyped_isOpenedByReturn();
  void dialogForFiles_hidesNoForm();
  void dialogForFiles_opensAFolder_data();
  void dialogForFiles_opensAFolder();
  void mapBesideViews_offersItsLightField();
  void failedOpening_namesOptionsAsTheWindowDoes();
  void mapBesideOnePicture_isOfTheLightFieldInFront();
  void mapAboveTheViewsInFront_isTheirs();
  void resultsAlone_openWithTheirLightField();
  void resultsAlone_openBesideABrokenOne();
  void resultOfAnotherLightField_isAddedAtWishAndMarked();
  void resultOfAnotherLightField_opensThatWithTheResult();
  void droppedFile_isOpened();
  void droppedFiles_areAllOpened();
  void droppedFiles_areOpenedBesideABrokenOne();
  void anotherScene_hasItsOwnResults();
  void closedScene_leavesTheEmptyWindow();
  void recentFiles_areRemembered();
};

void OpeningTest::openedFile_isShown() {
  WindowFixture f;
  f.openSmall();

  QCOMPARE(f.window.bench().viewer_area.canvas()->state(), ViewCanvas::State::Picture);
  QVERIFY2(f.window.windowTitle().contains("edge"), qPrintable(f.window.windowTitle()));
}

// As on the command line; one of several is chosen from a list (collection_window_test).
void OpeningTest::epis_areDrawnBeforeTheChecksEnd() {
  WindowFixture f;
  const QString file = f.writeScene("edge", WindowFixture::smallOptions());
  const Workbench& bench = f.window.bench();
  const auto is_drawn = [&bench](const EpiPane& pane) { return pane.isVisible() && pane.hasEpi(); };
  bool was_drawn = false;
  connect(&bench.jobs, &Jobs::removed, this, [&] {
    was_drawn |= bench.viewer_area.isPreviewing() && is_drawn(*bench.viewer_area.horizontalEpi()) &&
                 is_drawn(*bench.viewer_area.verticalEpi());
  });

  bench.opener.open(file);

  QTRY_VERIFY_WITH_TIMEOUT(bench.session.scene(), kScenePatience);
  QVERIFY(was_drawn);
}

void OpeningTest::factsAndViews_areNotThoseOfTheFormerWhileAnotherIsRead() {
  WindowFixture f;
  f.openSmall();
  ViewerArea& area = f.window.bench().viewer_area;
  const auto* title = f.window.findChild<ElidedLabel*>("info.title");
  auto& cells = *find<ViewGrid>(f.window).cells();
  const auto* position = f.window.findChild<QLabel*>("viewGrid.position");
  const QString former = title->fullText();
  QTRY_VERIFY_WITH_TIMEOUT(is_colored(cells.grab().toImage()), kPatience);

  area.showPreview(QImage(8, 8, QImage::Format_RGB32), "another");

  QCOMPARE(title->fullText(), QString("Opening …"));
  QVERIFY(!f.window.findChild<QLabel*>("info.source"));
  QVERIFY(!is_colored(cells.grab().toImage()));
  QVERIFY(!position->isVisible());

  area.endPreview();

  QCOMPARE(title->fullText(), former);
  QVERIFY(is_colored(cells.grab().toImage()));
  QVERIFY(position->isVisible());
}

void OpeningTest::folderOfASingleLightField_opensIt() {
  WindowFixture f;
  const QString file = f.path("deeper/down/lf.h5");
  QDir().mkpath(f.path("deeper/down"));
  QVERIFY(QFile::rename(f.writeScene("edge", WindowFixture::smallOptions()), file));

  f.window.bench().opener.open(f.path("deeper"));

  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().session.scene() != nullptr, kScenePatience);
  QCOMPARE(QString::fromStdString(f.window.bench().session.light_field()->info().source), file);
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().viewer_area.canvas()->state(),
                            ViewCanvas::State::Picture, kPatience);
}

void OpeningTest::readAgain_showsWhatWasWrittenMeanwhile() {
  WindowFixture f;
  f.openSmall();
  scenes::RenderOptions options = WindowFixture::smallOptions();
  options.width = 64;
  f.writeScene("edge", options);
  QCOMPARE(f.window.bench().session.light_field()->width(), 96);

  f.trigger("file.read_again");

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.light_field()->width(), 64, kScenePatience);
}

void OpeningTest::builtinScene_isEstimatedAtOnce() {
  WindowFixture f;

  f.window.bench().opener.open("demo:fronto");

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.estimates().size(), 1U, kScenePatience);
  QTRY_VERIFY_WITH_TIMEOUT(!f.window.bench().overlay.picture().isNull(), kPatience);
  QVERIFY(f.window.bench().commands.find("overlay.error")->isEnabled());
  // Nobody asked for it, so that nobody is asked to save it.
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().guards.may_leave(Leaving::Session), kPatience);
}

void OpeningTest::builtinScenes_areChosenFromAList() {
  WindowFixture f;
  f.trigger("file.builtin");
  auto* dialog = f.window.findChild<QDialog*>("builtin");
  QVERIFY(dialog && QTest::qWaitForWindowExposed(dialog));
  auto* scenes = dialog->findChild<QListWidget*>("builtin.scenes");
  QCOMPARE(scenes->count(), static_cast<int>(builtin_inputs().size()));
  QVERIFY(!find<ParameterForm>(*dialog).isEnabled());
  const QRect row = scenes->visualItemRect(scenes->item(1));

  QTest::mouseClick(scenes->viewport(), Qt::LeftButton, {}, row.center());
  f.click("builtin.open");

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.input(), std::string("demo:fronto"),
                            kScenePatience);
}

void OpeningTest::randomScene_hasTheSeedAndKindThatWereTyped() {
  WindowFixture f;
  f.trigger("file.builtin");
  auto* dialog = f.window.findChild<QDialog*>("builtin");
  QVERIFY(dialog && QTest::qWaitForWindowExposed(dialog));
  auto* scenes = dialog->findChild<QListWidget*>("builtin.scenes");
  QTest::keyClick(scenes, Qt::Key_End);
  auto& form = find<ParameterForm>(*dialog);
  QVERIFY(form.isEnabled());

  auto* seed = form.findChild<NumberSpin*>();
  QTest::mouseDClick(seed->findChild<QLineEdit*>(), Qt::LeftButton);  // selects the number
  QVERIFY(seed->hasFocus());
  QTest::keyClicks(seed, "27");
  QTest::keyClick(seed, Qt::Key_Tab);
  QTest::keyClicks(form.findChild<QComboBox*>(), "thin");
  const auto* written = dialog->findChild<QLabel*>("builtin.written");
  QVERIFY2(written->text().endsWith("demo:random?seed=27&kind=thin"), qPrintable(written->text()));
  f.click("builtin.open");

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.input(),
                            std::string("demo:random?seed=27&kind=thin"), kScenePatience);
  QTRY_VERIFY2(f.window.windowTitle().contains("random_thin_27"),
               qPrintable(f.window.windowTitle()));
}

void OpeningTest::brokenFile_isToldAndKeepsTheScene() {
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
  QCOMPARE(f.window.bench().viewer_area.canvas()->state(), ViewCanvas::State::Picture);
}

void OpeningTest::brokenFile_isToldUntilItIsRead() {
  WindowFixture f;
  const Workbench& bench = f.window.bench();
  const QString scene = f.writeScene("edge", WindowFixture::smallOptions());
  const QString other = f.path("other.h5");
  const MessageBar* messages = f.window.findChild<MessageBar*>("messageBar");
  bench.opener.open(other);
  QTRY_COMPARE_WITH_TIMEOUT(f.canvas()->state(), ViewCanvas::State::Failed, kPatience);
  QVERIFY(!messages->isVisible());  // once is enough

  bench.opener.open(scene);

  QTRY_VERIFY_WITH_TIMEOUT(bench.session.scene(), kScenePatience);
  QVERIFY(!messages->isVisible());

  bench.opener.open(other);
  QTRY_VERIFY_WITH_TIMEOUT(messages->isVisible(), kPatience);
  bench.opener.open(scene);
  QTRY_VERIFY(!bench.opener.hasFailed());
  QVERIFY2(messages->isVisible() && messages->text().contains("other.h5"),
           qPrintable(messages->text()));

  QVERIFY(QFile::copy(scene, other));
  bench.opener.open(other);

  QTRY_COMPARE_WITH_TIMEOUT(bench.session.scenes().size(), 2U, kScenePatience);
  QTRY_VERIFY(!messages->isVisible());
}

void OpeningTest::brokenFile_leavesWhatIsOpenReversible() {
  WindowFixture f;
  const Workbench& bench = f.window.bench();
  f.openSmall();
  const std::string input = bench.session.input();
  const bool was_reversed = bench.session.scene()->convention.reversed_u;
  bench.opener.open("/no/such/place");
  QTRY_VERIFY_WITH_TIMEOUT(bench.opener.hasFailed(), kPatience);

  QVERIFY(bench.commands.find("file.reverse_sign")->isEnabled());
  f.click("info.more.sign");
  f.click("info.action");

  QTRY_VERIFY_WITH_TIMEOUT(bench.session.scene()->convention.reversed_u != was_reversed,
                           kScenePatience);
  QCOMPARE(bench.session.input(), input);
  QCOMPARE(bench.session.scenes().size(), std::size_t{1});
}

void OpeningTest::brokenFile_withoutScene_isDrawnAsError() {
  WindowFixture f;

  f.window.bench().opener.open("/no/such/place");

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().viewer_area.canvas()->state(),
                            ViewCanvas::State::Failed, kPatience);
}

void OpeningTest::failureOfAnotherJob_isNotThatOfOpening() {
  WindowFixture f;
  const Workbench& bench = f.window.bench();
  HeldLane held(bench.jobs, Lane::Open);
  bench.opener.open(f.writeScene("edge", WindowFixture::smallOptions()));
  QSignalSpy failures(&bench.jobs, &Jobs::failed);
  bench.jobs.start<bool>(
      Lane::Export, "Writing",
      [](const Progress&) -> bool { throw IoError("/x.png", "the disk is full"); }, [](bool) {});
  QTRY_COMPARE_WITH_TIMEOUT(failures.size(), 1, kPatience);
  held.release();
  QTRY_VERIFY_WITH_TIMEOUT(bench.session.scene(), kScenePatience);
  QTRY_COMPARE_WITH_TIMEOUT(bench.jobs.count(Lane::Open), 0, kPatience);

  QVERIFY(!bench.opener.hasFailed());
}

void OpeningTest::firstDialog_beginsAtHome() {
  WindowFixture f;

  f.trigger("file.open");

  auto* dialog = f.window.findChild<QFileDialog*>("open_file");
  QVERIFY(dialog);
  QCOMPARE(dialog->directory(), QDir::home());
  dialog->reject();
}

void OpeningTest::dialog_beginsBesideWhatWasOpened() {
  WindowFixture f;
  f.openSmall();  // by no dialog

  f.trigger("file.open");

  const auto* dialog = f.window.findChild<QFileDialog*>("open_file");
  QCOMPARE(dialog->directory().path(),
           QFileInfo(QString::fromStdString(f.window.bench().session.input())).path());
}

void OpeningTest::dialog_remembersItsFolder() {
  WindowFixture f;
  const QString scene = f.writeScene("edge", WindowFixture::smallOptions());
  f.trigger("file.open");
  auto* dialog = f.window.findChild<QFileDialog*>();
  emit dialog->fileSelected(scene);
  dialog->close();
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().session.scene(), kPatience);
  QTRY_VERIFY(!f.window.findChild<QFileDialog*>());

  f.trigger("file.open");
  QCOMPARE(f.window.findChild<QFileDialog*>()->directory().path(), QFileInfo(scene).path());
}

// The dialog only looked into it.
void OpeningTest::folderThatIsTyped_isOpenedByReturn() {
  WindowFixture f;
  const QString folder = QFileInfo(f.writeScene("edge", WindowFixture::smallOptions())).path();
  f.trigger("file.open");
  auto* dialog = f.window.findChild<QFileDialog*>("open_file");
  QVERIFY(QTest::qWaitForWindowActive(dialog));
  auto* name = dialog->findChild<QLineEdit*>("fileNameEdit");
  name->setFocus();

  QTest::keyClicks(name, folder);
  QTest::keyClick(name, Qt::Key_Return);

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.input(), folder.toStdString(), kScenePatience);
  QTRY_VERIFY(!f.window.findChild<QFileDialog*>("open_file"));
}

// It once showed HDF5, PFM and TIFF only.
void OpeningTest::dialogForFiles_hidesNoForm() {
  WindowFixture f;
  f.trigger("file.open");

  auto* dialog = f.window.findChild<QFileDialog*>("open_file");
  QVERIFY(dialog);
  QVERIFY2(dialog->selectedNameFilter().contains("(*)"), qPrintable(dialog->selectedNameFilter()));
  dialog->reject();
}

void OpeningTest::dialogForFiles_opensAFolder_data() {
  QTest::addColumn<bool>("is_marked");
  QTest::newRow("the one that is shown") << false;
  QTest::newRow("the one that is typed or marked") << true;
}

void OpeningTest::dialogForFiles_opensAFolder() {
  QFETCH(bool, is_marked);
  WindowFixture f;
  f.writeScene("edge", WindowFixture::smallOptions());
  f.trigger("file.open");
  auto* dialog = f.window.findChild<QFileDialog*>("open_file");
  dialog->setDirectory(is_marked ? f.path("") : f.path("edge"));
  if (is_marked) dialog->findChild<QLineEdit*>("fileNameEdit")->setText(f.path("edge"));

  QTest::mouseClick(dialog->findChild<QPushButton*>("open_file.folder"), Qt::LeftButton);

  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().session.scene(), kScenePatience);
  QCOMPARE(f.window.bench().session.light_field()->info().name, std::string("edge"));
}

// The only file that the dialog once listed in a folder of the benchmark became a result of the
// demo without a word.
void OpeningTest::mapBesideViews_offersItsLightField() {
  WindowFixture f;
  f.writeScene("edge", WindowFixture::smallOptions());
  f.openSmall("slant");
  f.runAndWait();
  exportShown(f, f.path("edge/map.pfm"));

  choose(f, f.path("edge/map.pfm"));
  QTRY_VERIFY(f.window.findChild<QMessageBox*>("result_owner"));
  QCOMPARE(f.window.bench().session.estimates().size(), 1U);
  f.click("result_owner.open");

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.light_field()->info().name,
                            std::string("edge"), kScenePatience);
  QVERIFY(f.window.bench().session.estimates().empty());
  choose(f, f.path("edge/map.pfm"));  // it belongs to the light field in front now
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.estimates().size(), 1U, kScenePatience);
  QVERIFY(f.window.bench().session.estimates()[0].foreign_file.empty());
}

void OpeningTest::failedOpening_namesOptionsAsTheWindowDoes() {
  WindowFixture f;
  QImage picture(96, 96, QImage::Format_RGB32);
  picture.fill(Qt::gray);
  QVERIFY(picture.save(f.path("picture.png")));

  f.openSmall();
  f.window.bench().opener.open(f.path("picture.png"));

  const auto* messages = f.window.findChild<MessageBar*>("messageBar");
  QTRY_VERIFY_WITH_TIMEOUT(messages->isVisible(), kScenePatience);
  for (const char* words :
       {"“Grid of views: RxC”", "Set this in “Conventions…”.", "page “Raw picture”"}) {
    QVERIFY2(messages->text().contains(words), qPrintable(messages->text()));
  }
  QVERIFY2(!messages->text().contains("--"), qPrintable(messages->text()));
}

void OpeningTest::mapBesideOnePicture_isOfTheLightFieldInFront() {
  WindowFixture f;
  f.openSmall("slant");
  f.runAndWait();
  QDir().mkpath(f.path("new"));
  exportShown(f, f.path("new/mine.pfm"));
  QVERIFY(f.canvas()->picture().save(f.path("new/picture.png")));

  choose(f, f.path("new/mine.pfm"));

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.estimates().size(), 2U, kScenePatience);
  QVERIFY(!f.window.findChild<QMessageBox*>("result_owner"));
}

// Its folder has a light field, too: the one in front, whose views lie one folder deeper.
void OpeningTest::mapAboveTheViewsInFront_isTheirs() {
  WindowFixture f;
  f.openSmall("slant");
  QDir().mkpath(f.path("new"));
  const auto& session = f.window.bench().session;
  io::writer_named("grid")->write(f.path("new/lf").toStdString(), *session.scene(), Progress());
  f.runAndWait();
  exportShown(f, f.path("new/mine.pfm"));
  f.window.bench().opener.open(f.path("new/lf"));
  QTRY_COMPARE_WITH_TIMEOUT(session.input(), f.path("new/lf").toStdString(), kScenePatience);

  choose(f, f.path("new/mine.pfm"));

  QTRY_COMPARE_WITH_TIMEOUT(session.estimates().size(), 1U, kScenePatience);
  QVERIFY(!f.window.findChild<QMessageBox*>("result_owner"));
  QVERIFY(session.estimates()[0].foreign_file.empty());
}

// As a file manager starts the program.
void OpeningTest::resultsAlone_openWithTheirLightField() {
  WindowFixture f;
  f.openSmall("slant");
  f.runAndWait();
  exportShown(f, f.path("first.h5"));
  exportShown(f, f.path("second.h5"));

  WindowFixture other;
  other.window.start({f.path("first.h5"), f.path("second.h5")});

  QTRY_COMPARE_WITH_TIMEOUT(other.window.bench().session.estimates().size(), 2U, kScenePatience);
  QCOMPARE(other.window.bench().session.light_field()->info().name, std::string("slant"));
  QVERIFY(!other.window.findChild<QMessageBox*>("result_owner"));
}

void OpeningTest::resultsAlone_openBesideABrokenOne() {
  WindowFixture f;
  f.openSmall("slant");
  f.runAndWait();
  exportShown(f, f.path("whole.h5"));
  QFile whole(f.path("whole.h5")), broken(f.path("broken.h5"));
  QVERIFY(whole.open(QIODevice::ReadOnly) && broken.open(QIODevice::WriteOnly));
  broken.write(whole.read(whole.size() / 2));
  broken.close();

  WindowFixture other;
  other.window.start({f.path("broken.h5"), f.path("whole.h5")});

  QTRY_COMPARE_WITH_TIMEOUT(other.window.bench().session.estimates().size(), 1U, kScenePatience);
  const auto* messages = other.window.findChild<MessageBar*>("messageBar");
  QTRY_VERIFY2(messages->isVisible() && messages->text().contains("broken.h5"),
               qPrintable(messages->text()));
}

void OpeningTest::resultOfAnotherLightField_isAddedAtWishAndMarked() {
  WindowFixture f;
  f.writeScene("edge", WindowFixture::smallOptions());
  f.openSmall("slant");
  f.runAndWait();
  exportShown(f, f.path("edge/map.pfm"));
  choose(f, f.path("edge/map.pfm"));
  QTRY_VERIFY(f.window.findChild<QMessageBox*>("result_owner"));

  f.click("result_owner.add");

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.estimates().size(), 2U, kScenePatience);
  const auto* tree = f.window.findChild<QTreeWidget*>("results.tree");
  QTRY_COMPARE(tree->topLevelItemCount(), 2);
  const auto row = [tree](int i) { return tree->topLevelItem(i)->text(kParametersColumn); };
  QTRY_VERIFY2(row(1).startsWith("⚠ map.pfm"), qPrintable(row(1)));
  QVERIFY2(!row(0).contains("⚠"), qPrintable(row(0)));
}

void OpeningTest::resultOfAnotherLightField_opensThatWithTheResult() {
  WindowFixture f;
  f.openSmall("slant");
  f.runAndWait();
  exportShown(f, f.path("result.h5"));
  f.openSmall("edge");
  choose(f, f.path("result.h5"));
  QTRY_VERIFY(f.window.findChild<QMessageBox*>("result_owner"));

  f.click("result_owner.open");

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.estimates().size(), 2U, kScenePatience);
  QCOMPARE(f.window.bench().session.light_field()->info().name, std::string("slant"));
  QVERIFY(f.window.bench().session.estimates()[1].foreign_file.empty());
}

// It has the signature of HDF5, and ends there.
void OpeningTest::brokenFile_ofTheDialog_isTold() {
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

void OpeningTest::droppedFile_isOpened() {
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

void OpeningTest::droppedFiles_areAllOpened() {
  WindowFixture f;
  QStringList files;
  for (const char* id : {"slant", "edge", "fronto"}) {
    files << f.writeScene(id, WindowFixture::smallOptions());
  }

  drop(f.window, files);

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.scenes().size(), 3U, kScenePatience);
}

void OpeningTest::droppedFiles_areOpenedBesideABrokenOne() {
  WindowFixture f;
  const QString slant = f.writeScene("slant", WindowFixture::smallOptions());
  const QString edge = f.writeScene("edge", WindowFixture::smallOptions());

  drop(f.window, {slant, f.path("missing"), f.path("gone"), edge});

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.scenes().size(), 2U, kScenePatience);
  const auto* messages = f.window.findChild<MessageBar*>("messageBar");
  QTRY_VERIFY2(messages->isVisible() && messages->text().contains(f.path("gone")) &&
                   messages->text().contains(f.path("missing")),
               qPrintable(messages->text()));
}

void OpeningTest::anotherScene_hasItsOwnResults() {
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

void OpeningTest::closedScene_leavesTheEmptyWindow() {
  WindowFixture f;
  f.openSmall();

  f.window.bench().commands.find("file.close")->trigger();

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().viewer_area.canvas()->state(),
                            ViewCanvas::State::Empty, kPatience);
  QCOMPARE(f.window.windowTitle(), QString("Episcope"));
}

void OpeningTest::recentFiles_areRemembered() {
  WindowFixture f;
  f.openSmall();

  QCOMPARE(recent_inputs(), QStringList(f.path("edge/lf.h5")));
  forget_recent();
  QVERIFY(recent_inputs().isEmpty());
}

void OpeningTest::brokenResult_isToldUntilItIsRead() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  exportShown(f, f.path("whole.pfm"));
  QFile broken(f.path("broken.pfm"));
  QVERIFY(broken.open(QIODevice::WriteOnly));
  broken.write("Pf");
  broken.close();
  const auto* messages = f.window.findChild<MessageBar*>("messageBar");
  choose(f, broken.fileName());
  QTRY_VERIFY2_WITH_TIMEOUT(messages->isVisible() && messages->text().contains("broken.pfm failed"),
                            qPrintable(messages->text()), kPatience);

  choose(f, f.path("whole.pfm"));

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.estimates().size(), 2U, kScenePatience);
  QVERIFY2(messages->isVisible() && messages->text().contains("broken.pfm failed"),
           qPrintable(messages->text()));

  QVERIFY(QFile::remove(broken.fileName()) && QFile::copy(f.path("whole.pfm"), broken.fileName()));
  choose(f, broken.fileName());

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.estimates().size(), 3U, kScenePatience);
  QVERIFY(!messages->isVisible() || !messages->text().contains("broken.pfm failed"));
}

void OpeningTest::patternOfNames_isNamedWithItsOption() {
  QCOMPARE(with_conventions("name them by --pattern, as in --pattern 'view_{row}_{col}.png'"),
           QString("name them by “Image names”, as in “Image names: view_{row}_{col}.png”"));
}

namespace {

// A light field of pictures with its true disparity beside them, in PFM.
QString write_with_truth(const WindowFixture& f, const QString& name) {
  const Scene scene = scenes::render_builtin("edge", WindowFixture::smallOptions(), Progress());
  const QString folder = f.path(name);
  io::writer_named("benchmark")->write(folder.toStdString(), scene, Progress());
  return folder + "/gt_disp_lowres.pfm";
}

}  // namespace

void OpeningTest::ownGroundTruth_isNoResult() {
  WindowFixture f;
  const QString truth = write_with_truth(f, "own");
  f.window.bench().opener.open(f.path("own"));
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().session.scene(), kScenePatience);
  QVERIFY(f.window.bench().session.scene()->truth->has_disparity());

  choose(f, truth);

  const auto* messages = f.window.findChild<MessageBar*>("messageBar");
  QTRY_COMPARE_WITH_TIMEOUT(messages->text(),
                            QString("gt_disp_lowres.pfm is the ground truth of this light field."),
                            kPatience);
  QVERIFY(f.window.bench().session.estimates().empty());
}

void OpeningTest::groundTruthOfAnother_isNotOfferedToIt() {
  WindowFixture f;
  const QString truth = write_with_truth(f, "own");
  f.openSmall("slant");
  choose(f, truth);
  QTRY_VERIFY(f.window.findChild<QMessageBox*>("result_owner"));

  f.click("result_owner.open");

  const auto* messages = f.window.findChild<MessageBar*>("messageBar");
  QTRY_VERIFY2_WITH_TIMEOUT(messages->text().contains("is the ground truth of this light field"),
                            qPrintable(messages->text()), kScenePatience);
}

}  // namespace episcope::in_opening_test

EPISCOPE_WINDOW_TEST(opening_test, OpeningTest)
#include "opening_test.moc"
