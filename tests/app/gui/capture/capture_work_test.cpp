// SPDX-License-Identifier: BSD-3-Clause
// What is done in the Capture tab is one document: undone, kept in projects, recovered after a
// crash.
#include "app/gui/capture/photographs.h"
#include "app/gui/files/autosave.h"
#include "app/gui/files/project_controller.h"
#include "engine/capture/camera.h"
#include "engine/io/formats/write_scene.h"
#include "engine/io/open.h"
#include "tests/app/gui/capture/capturing.h"
#include "tests/window_test_main.h"
#include "widgets/controls/message_bar.h"

#include <QComboBox>
#include <QDialog>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QLineEdit>
#include <QMessageBox>
#include <QProcess>
#include <QPushButton>
#include <QTableWidget>
#include <QToolButton>

#include <algorithm>
#include <csignal>
#include <memory>
#include <set>

namespace episcope::in_capture_work_test {

namespace {

capture::LensCamera camera() {
  return {96, 96, 120, 121, 47, 48, {-0.1, 0.01, 1e-4, 0, 0}, 0.2};
}

class Working : public Capturing {
 public:
  using Capturing::Capturing;
  void openLens(double focal = 120) {
    capture::LensCamera lens = camera();
    lens.focal_x = focal;
    capture::write_camera(file("lens.yml"), lens);
    capture().photographs().openCamera(path("lens.yml"));
  }
  QComboBox* objects() { return window.findChild<QComboBox*>("capture.objects"); }
  /// The scan in another size, `z` mm away, with exact pairs.
  void addObject(const QString& name, double z, float scale = 1) {
    capture::TriangleMesh scaled = mesh;
    for (capture::Vertex& vertex : scaled.vertices) {
      for (float& each : vertex) each *= scale;
    }
    capture::write_mesh(path(name + ".ply").toStdString(), scaled);
    capture().addObject(path(name + ".ply"));
    awaitMesh(name + ".ply");
    std::vector<capture::PointPair> pairs;
    for (std::size_t i = 0; i < 10; ++i) {
      pairs.push_back(pair_of("", scaled.vertices[(i * 7919) % scaled.vertices.size()], z));
    }
    capture::write_pairs(file("pairs.csv"), pairs);
    capture().importPairs(path("pairs.csv"));
  }
  void choose(int object) {
    objects()->setCurrentIndex(object);
    emit objects()->activated(object);
  }
  bool can(const char* button) { return window.findChild<QAbstractButton*>(button)->isEnabled(); }
};

}  // namespace

class CaptureWorkTest : public QObject {
  Q_OBJECT

 private slots:
  void lens_isUndoneAndRedone() {
    Working f(false);
    QVERIFY(!f.can("capture.undo") && !f.can("capture.rectify"));
    f.openLens();
    QVERIFY(f.can("capture.rectify"));
    f.openLens(110);
    QVERIFY(f.full("capture.camera").contains("110"));
    f.click("capture.undo");
    QVERIFY(f.full("capture.camera").contains("120"));
    f.click("capture.undo");
    QVERIFY(!f.can("capture.rectify") && !f.can("capture.undo"));
    QVERIFY(f.full("capture.camera").contains("No lens"));
    f.click("capture.redo");
    f.click("capture.redo");
    QVERIFY(f.full("capture.camera").contains("110"));
    QVERIFY(!f.can("capture.redo"));
  }

  void settingsOfRectification_areUndone() {
    Working f(false);
    f.openLens();
    f.click("capture.rectify");
    auto* dialog = f.window.findChild<QDialog*>("rectify");
    QVERIFY(dialog);
    auto* step = dialog->findChild<QDoubleSpinBox*>();
    QVERIFY(step);
    step->setValue(12.5);
    QTest::mouseClick(dialog->findChild<QPushButton*>("rectify.accept"), Qt::LeftButton);
    QCOMPARE(f.capture().work().rectify.step, 12.5);
    f.window.findChild<QFileDialog*>("save_rectified")->reject();
    f.click("capture.undo");
    QCOMPARE(f.capture().work().rectify.step, 1.0);
    QVERIFY(f.capture().work().lens);
  }

  // With the mouse on the view one is still at work in the tab.
  void keyOfUndo_isOfTheTab() {
    Working f;
    f.openMesh();
    f.importPairs(8);
    f.key(Qt::Key_Z, Qt::ControlModifier);
    QVERIFY(f.capture().pairs().empty());
    f.key(Qt::Key_Y, Qt::ControlModifier);
    QCOMPARE(f.capture().pairs().size(), std::size_t{8});
    auto* table = f.window.findChild<QTableWidget*>("capture.pairs");
    QTest::keyClick(table, Qt::Key_Z, Qt::ControlModifier);
    QVERIFY(f.capture().pairs().empty());
    f.trigger("tab.compare");
    f.key(Qt::Key_Y, Qt::ControlModifier);
    QVERIFY(f.capture().pairs().empty());
  }

  void objects_haveTheirOwnPairsAndPoses() {
    Working f;
    f.addObject("head", 900);
    QVERIFY(std::abs(f.capture().pose()->pose.translation[2] - 900) < 1e-3);
    f.addObject("box", 700);
    QVERIFY(std::abs(f.capture().pose()->pose.translation[2] - 700) < 1e-3);
    QCOMPARE(f.objects()->count(), 2);
    QCOMPARE(f.objects()->currentText(), QString("box"));

    f.choose(0);
    QVERIFY(std::abs(f.capture().pose()->pose.translation[2] - 900) < 1e-3);
    QVERIFY(f.full("capture.mesh").startsWith("head.ply"));
    f.objects()->lineEdit()->selectAll();
    QTest::keyClicks(f.objects()->lineEdit(), "statue");
    QTest::keyClick(f.objects()->lineEdit(), Qt::Key_Return);
    QCOMPARE(f.capture().work().objects[0].name, std::string("statue"));
    QCOMPARE(f.objects()->itemText(0), QString("statue"));

    f.click("capture.removeObject");
    QCOMPARE(f.objects()->count(), 1);
    QVERIFY(std::abs(f.capture().pose()->pose.translation[2] - 700) < 1e-3);
    f.click("capture.undo");
    QCOMPARE(f.objects()->currentText(), QString("statue"));
    f.awaitMesh("head.ply");  // read again
    QVERIFY(f.capture().pose());
  }

  void truth_isOfAllObjects() {
    Working f;
    f.addObject("far", 900);
    f.addObject("near", 600, 0.3F);
    f.addObject("without", 900);
    f.window.findChild<QTableWidget*>("capture.pairs")->selectAll();
    f.click("capture.remove");
    f.choose(0);
    f.capture().writeTruth(f.path("made.h5"));
    const auto* messages = f.window.findChild<MessageBar*>("messageBar");
    QTRY_VERIFY_WITH_TIMEOUT(messages->text().contains("without"), kPatience);
    QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kPatience);
    const Scene made = io::open_scene(f.path("made.h5").toStdString(), {}, Progress());
    const auto labels = made.truth->labels.view({4, 4});
    std::set<int> seen;
    for (int y = 0; y < labels.height; ++y) {
      for (int x = 0; x < labels.width; ++x) seen.insert(labels.at(y, x));
    }
    QVERIFY(seen.contains(1) && seen.contains(2) && !seen.contains(3));
    // Nearer, where both are: the disparity of f·B/Z − shift.
    const double nearest = 120.0 * 10 / 600 - 10 * 120.0 / 900;
    float most = -10;
    const auto view = made.truth->field.disparity.view({4, 4});
    for (int y = 0; y < 96; ++y) {
      for (int x = 0; x < 96; ++x) {
        if (made.truth->field.valid.view({4, 4}).at(y, x) != 0)
          most = std::max(most, view.at(y, x));
      }
    }
    QVERIFY2(most > nearest - 0.1, qPrintable(QString::number(most)));

    f.click("capture.show");
    QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().session.shown(), kPatience);
    const auto& shown = *f.window.bench().session.shown()->estimate;
    QCOMPARE(shown.field.disparity.view({4, 4}).at(48, 48), view.at(48, 48));
  }

  void lens_goesOnToTheNextPhotographs() {
    Working f(false);
    f.openLens();
    Session& session = f.window.bench().session;
    session.add(session.scene(), "more photographs");
    QTRY_VERIFY(!f.can("capture.undo"));
    QVERIFY(f.can("capture.rectify"));
    QVERIFY(session.place().capture.lens);
  }

  void project_bringsAllBack() {
    Working f;
    io::write_archive(f.file("lf.h5"), posed_scene(true), Progress());
    f.window.bench().opener.open(f.path("lf.h5"));
    QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.input(), f.file("lf.h5").string(),
                              kScenePatience);
    f.openLens();
    f.addObject("head", 900);
    f.addObject("box", 700);
    const CaptureWork work = f.capture().work();
    bool is_saved = false;
    find<ProjectController>(f.window).saveTo(f.path("work.episcope"), [&] { is_saved = true; });
    QTRY_VERIFY_WITH_TIMEOUT(is_saved, kScenePatience);

    Working again;
    again.window.bench().opener.open(f.path("work.episcope"));
    QTRY_COMPARE_WITH_TIMEOUT(again.window.bench().session.input(), f.file("lf.h5").string(),
                              kScenePatience);
    QTRY_VERIFY_WITH_TIMEOUT(again.capture().work() == work, kPatience);
    again.awaitMesh("box.ply");
    QVERIFY(std::abs(again.capture().pose()->pose.translation[2] - 700) < 1e-3);
    QVERIFY(again.full("capture.camera").contains("120"));
    again.choose(0);
    again.awaitMesh("head.ply");
    QVERIFY(again.can("capture.writeTruth"));
    QVERIFY(!again.can("capture.undo"));
  }

  void unsavedPairs_areAskedFor() {
    Working f;
    f.openMesh();
    f.importPairs(4);
    f.trigger("file.quit");
    QTRY_VERIFY(f.window.findChild<QMessageBox*>("unsaved_results"));
    auto* question = f.window.findChild<QMessageBox*>("unsaved_results");
    QVERIFY2(question->text().contains("pairs of points"), qPrintable(question->text()));
    question->button(QMessageBox::Discard)->click();
    QTRY_VERIFY(!f.window.isVisible());
  }

  void killedProgram_losesNothingThatWasKept() {
    for (const int wait_ms : {0, 150, 900}) {
      const QTemporaryDir state;
      Working files;
      io::write_archive(files.file("lf.h5"), posed_scene(true), Progress());
      files.openLens();
      QProcess program;
      program.start(CAPTURING_PROGRAM, {state.path(), files.path("lf.h5"), files.path("lens.yml"),
                                        files.path("scan.ply")});
      QByteArray output;
      while (!output.contains('\n') && program.waitForReadyRead(kScenePatience)) {
        output += program.readAllStandardOutput();
      }
      QTest::qWait(wait_ms);
      ::kill(static_cast<pid_t>(program.processId()), SIGKILL);
      program.waitForFinished();
      output += program.readAllStandardOutput();
      const int kept = output.left(output.lastIndexOf('\n')).split('\n').last().toInt();
      QVERIFY2(kept > 0, output.constData());

      Working f;
      find<Autosave>(f.window).setRoot((state.path() + "/sessions").toStdString());
      f.window.bench().frame.start();
      auto* bar = f.window.findChild<MessageBar*>("sessionRecoveryBar");
      QTRY_VERIFY_WITH_TIMEOUT(bar->isVisible(), kPatience);
      bar->findChild<QPushButton*>("message.action")->click();
      QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.input(), files.file("lf.h5").string(),
                                kScenePatience);
      QTRY_VERIFY_WITH_TIMEOUT(static_cast<int>(f.capture().pairs().size()) >= kept, kPatience);
      const CaptureWork& work = f.capture().work();
      QCOMPARE(work.lens->camera, camera());
      QCOMPARE(work.objects.at(0).name, std::string("found again"));
      f.awaitMesh("scan.ply");
      for (std::size_t i = 0; i < work.objects[0].pairs.size(); ++i) {
        QCOMPARE(work.objects[0].pairs[i].x_px, static_cast<double>(i + 1));
      }
    }
  }
};

}  // namespace episcope::in_capture_work_test

EPISCOPE_WINDOW_TEST(capture_work_test, CaptureWorkTest)
#include "capture_work_test.moc"
