// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/capture/capture_controller.h"
#include "app/gui/capture/photographs.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/scene/viewer_area.h"
#include "app/session/session.h"
#include "engine/capture/solve_pose.h"
#include "engine/io/open.h"
#include "tests/app/gui/capture/capturing.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/message_bar.h"

#include <QCheckBox>
#include <QDialog>
#include <QFile>
#include <QFileDialog>
#include <QHeaderView>
#include <QPushButton>
#include <QTableWidget>
#include <QToolButton>

#include <array>
#include <cmath>

namespace episcope::in_capture_test {

class CaptureTest : public QObject {
  Q_OBJECT

 private slots:
  void picks_becomePairsAndAPose() {
    Capturing f;
    f.openMesh();
    auto* add = f.window.findChild<QPushButton*>("capture.add");
    auto* table = f.window.findChild<QTableWidget*>("capture.pairs");
    auto* remove = f.window.findChild<QPushButton*>("capture.remove");
    auto* write = f.window.findChild<QPushButton*>("capture.export");
    for (const auto* each : {add, remove, write}) QVERIFY(!each->isEnabled());
    table->setFixedHeight(4 * table->verticalHeader()->defaultSectionSize());  // few fit
    int picked = 0;
    for (std::size_t i = 0; i < f.mesh.vertices.size() && picked < 6; i += 131) {
      const capture::PointPair pair = pair_of("", f.mesh.vertices[i]);
      const PixelIndex pixel{static_cast<int>(std::lround(pair.x_px)),
                             static_cast<int>(std::lround(pair.y_px))};
      if (pixel.x < 2 || pixel.y < 2 || pixel.x > 93 || pixel.y > 93) continue;
      QTest::mouseClick(f.canvas(), Qt::LeftButton, {}, f.at(pixel));
      QCOMPARE(f.window.bench().session.cross_hair(), pixel);
      f.capture().pickVertex(i);
      QVERIFY(add->isEnabled());
      f.click("capture.add");
      QCOMPARE(table->rowCount(), ++picked);
      const QRect row = table->visualItemRect(table->item(picked - 1, 0));
      QVERIFY2(table->viewport()->rect().contains(row), "the new pair is out of sight");
      QVERIFY(!add->isEnabled());  // a pair needs a new point
    }
    QCOMPARE(picked, 6);
    QVERIFY(f.capture().pose());
    QVERIFY(f.capture().pose()->reprojection_error_px < 1);  // whole pixels were picked
    QVERIFY2(f.text("capture.pose").contains("px"), qPrintable(f.text("capture.pose")));

    QVERIFY(write->isEnabled());
    QVERIFY(!remove->isEnabled());
    table->selectRow(0);
    f.click("capture.remove");
    QCOMPARE(table->rowCount(), 5);
    f.click("capture.undo");
    QCOMPARE(table->rowCount(), 6);
  }

  void lockedPair_staysAndIsNoWrongPick() {
    Capturing f;
    f.openMesh();
    f.importPairs(11);
    capture::PointPair wrong = pair_of("wrong", f.mesh.vertices[40]);
    wrong.x_px += 30;
    capture::write_pairs(f.file("wrong.csv"), std::vector{wrong});
    f.capture().importPairs(f.path("wrong.csv"));
    auto* table = f.window.findChild<QTableWidget*>("capture.pairs");
    QVERIFY(f.capture().pose()->pairs[11].is_outlier);

    table->item(11, 1)->setCheckState(Qt::Checked);
    QVERIFY(f.capture().pairs()[11].is_locked);
    QVERIFY(!f.capture().pose()->pairs[11].is_outlier);
    table->selectAll();
    f.click("capture.remove");
    QCOMPARE(table->rowCount(), 1);
    QCOMPARE(table->item(0, 0)->text(), QString("wrong"));
    f.click("capture.undo");
    f.click("capture.undo");
    QCOMPARE(table->rowCount(), 12);
    QCOMPARE(table->item(11, 1)->checkState(), Qt::Unchecked);
  }

  void pairs_areMarkedOnTheView() {
    Capturing f;
    f.openMesh();
    f.importPairs(8);
    const ViewCanvas& canvas = *f.window.bench().viewer_area.canvas();
    QCOMPARE(canvas.marks().size(), std::size_t{8});
    const capture::PointPair& third = f.capture().pairs()[2];
    QCOMPARE(canvas.marks()[2].name, QString("p3"));
    QCOMPARE(canvas.marks()[2].at, QPointF(third.x_px + 0.5, third.y_px + 0.5));
    QVERIFY(canvas.marks()[2].wanted);  // exact pairs
    QVERIFY(QLineF(*canvas.marks()[2].wanted, canvas.marks()[2].at).length() < 1e-3);
    QVERIFY(!canvas.marks()[2].is_emphasised);
    f.window.findChild<QTableWidget*>("capture.pairs")->selectRow(2);
    QVERIFY(canvas.marks()[2].is_emphasised && !canvas.marks()[1].is_emphasised);

    f.window.bench().session.set_view({0, 0});
    QTRY_VERIFY(canvas.marks().empty());
    f.window.bench().session.set_view({4, 4});
    QTRY_COMPARE(canvas.marks().size(), std::size_t{8});
    f.trigger("tab.compare");
    QTRY_VERIFY(canvas.marks().empty());
  }

  // The built-in gantry brings its lens, its mesh and its picks.
  void builtinGantry_isReadyToBeRectified() {
    Capturing f;
    f.window.bench().opener.setCacheFolder(f.file("cache"));
    f.window.bench().opener.open("demo:gantry?size=400x300&grid=3x3");
    QTRY_VERIFY_WITH_TIMEOUT(f.full("capture.mesh").startsWith("mesh.ply"), kScenePatience);
    QVERIFY(f.capture().pairs().size() >= 4);
    QTRY_VERIFY_WITH_TIMEOUT(f.full("capture.camera").contains("focal length"), kScenePatience);
    QVERIFY(f.window.findChild<QPushButton*>("capture.rectify")->isEnabled());
    QCOMPARE(f.window.bench().session.estimates().size(), std::size_t{0});
  }

  void snap_takesTheMarkBesideTheCrossHair() {
    Capturing f;
    f.openMesh();
    Session& session = f.window.bench().session;
    PickSnapper snapper;
    std::optional<capture::SnappedPick> mark;
    for (int i = 0; !mark && i < 80 * 80; i += 7) {
      const PixelIndex pixel{8 + i / 80, 8 + i % 80};
      mark = snapper.snap(session.light_field(), pixel);
      if (mark) session.set_cross_hair(pixel);
    }
    QVERIFY(mark);
    QVERIFY(!f.text("capture.next").contains("corner"));
    QTest::mouseClick(f.window.findChild<QCheckBox*>("capture.snap"), Qt::LeftButton);
    const QString kind = mark->kind == capture::MarkKind::Corner ? "corner" : "blob";
    QVERIFY2(f.text("capture.next").contains(kind), qPrintable(f.text("capture.next")));
    f.capture().pickVertex(5);
    f.click("capture.add");
    QCOMPARE(f.capture().pairs().size(), std::size_t{1});
    QCOMPARE(f.capture().pairs()[0].x_px, mark->place.x);
    QCOMPARE(f.capture().pairs()[0].y_px, mark->place.y);
  }

  void exactPairs_giveTheExactDepth() {
    Capturing f;
    f.openMesh();
    f.importPairs(12);
    QVERIFY(f.capture().pose());
    QVERIFY(std::abs(f.capture().pose()->pose.translation[2] - 900) < 1e-4);

    f.click("capture.show");
    const Session& session = f.window.bench().session;
    QTRY_VERIFY_WITH_TIMEOUT(session.shown() != nullptr, kPatience);
    QCOMPARE(QString::fromStdString(session.shown()->estimate->method), QString("mesh"));
    f.click("capture.show");
    QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kPatience);
    QCOMPARE(session.estimates().size(), std::size_t{1});  // in place of the former

    f.capture().writeTruth(f.path("made.h5"));
    QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(f.path("made.h5")), kPatience);
    QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kPatience);
    const Scene made = io::open_scene(f.path("made.h5").toStdString(), {}, Progress());
    QCOMPARE(made.truth->field.disparity.grid().count(), 81);
    const ImageView<const float> shown = session.shown()->estimate->field.disparity.view({4, 4});
    double worst = 0;
    int judged = 0;
    for (int y = 0; y < 96; ++y) {
      for (int x = 0; x < 96; ++x) {
        if (made.truth->field.valid.view({4, 4}).at(y, x) == 0) continue;
        worst = std::max<double>(
            worst, std::abs(made.truth->field.disparity.view({4, 4}).at(y, x) - shown.at(y, x)));
        ++judged;
      }
    }
    QVERIFY(judged > 1000);
    QVERIFY(worst < 1e-4);
  }

  void pairs_waitForTheirLightField() {
    Capturing f;
    f.openMesh();
    f.importPairs(8);
    Session& session = f.window.bench().session;
    const std::uint64_t scene = session.generation();
    session.add(session.scene(), "the same again");
    QTRY_COMPARE(f.capture().pairs().size(), std::size_t{0});
    QVERIFY(!f.capture().pose());
    session.choose(scene);
    QTRY_COMPARE(f.capture().pairs().size(), std::size_t{8});
    QVERIFY(f.capture().pose());
  }

  void pairs_belongToTheProject() {
    Capturing f;
    f.openMesh();
    f.importPairs(8);
    Session& session = f.window.bench().session;
    const CaptureWork kept = session.place().capture;
    QCOMPARE(kept.objects.at(0).mesh, f.file("scan.ply").string());
    QCOMPARE(kept.objects[0].pairs.size(), std::size_t{8});
    f.click("capture.undo");
    QVERIFY(session.place().capture.objects.at(0).pairs.empty());

    // Another light field comes with its work, as when a project is opened.
    session.add(session.scene(), "as it was kept");
    session.set_capture(kept);
    QTRY_COMPARE(f.capture().pairs().size(), std::size_t{8});
    QVERIFY(f.capture().work() == kept);
    QVERIFY(f.capture().pose());
    QVERIFY(!f.window.findChild<QToolButton*>("capture.undo")->isEnabled());
  }

  void wrongPick_isNamed() {
    Capturing f;
    f.openMesh();
    f.importPairs(11);
    capture::PointPair wrong = pair_of("wrong", f.mesh.vertices[40]);
    wrong.x_px += 30;
    capture::write_pairs(f.file("wrong.csv"), std::vector{wrong});
    f.capture().importPairs(f.path("wrong.csv"));

    const auto* table = f.window.findChild<QTableWidget*>("capture.pairs");
    QCOMPARE(table->rowCount(), 12);
    QVERIFY2(table->item(11, 4)->text().contains("wrong?"), qPrintable(table->item(11, 4)->text()));
    QVERIFY(!table->item(0, 4)->text().contains("wrong?"));
  }

  void pose_isSavedWithItsStory() {
    Capturing f;
    f.openMesh();
    f.importPairs(8);
    f.capture().savePose(f.path("pose.json"));
    QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(f.path("pose.json")), kPatience);

    const capture::PoseStory story = capture::read_pose(f.file("pose.json"));
    QFile json(f.path("pose.json"));
    QVERIFY(json.open(QIODevice::ReadOnly) && json.readAll().contains("\"p8\""));
    QVERIFY(std::filesystem::equivalent(story.mesh, f.file("scan.ply")));
    QVERIFY(std::abs(story.solved.pose.translation[2] - 900) < 1e-4);
  }

  void lightFieldWithoutPinhole_isTold() {
    Capturing f(false);
    f.openMesh();
    f.importPairs(8);
    QVERIFY(!f.capture().pose());
    QVERIFY2(f.text("capture.pose").contains("Rectify"), qPrintable(f.text("capture.pose")));
    QVERIFY(!f.window.findChild<QPushButton*>("capture.writeTruth")->isEnabled());
  }

  // From nothing to a pose: the demo, its lens, its photographs, rectified.
  void demo_leadsFromPhotographsToAPose() {
    Capturing f;
    Photographs& photographs = f.capture().photographs();
    auto* rectify = f.window.findChild<QPushButton*>("capture.rectify");
    QVERIFY(!rectify->isEnabled());
    capture::DemoOptions small;
    small.grid = {3, 3};
    small.height = 300;
    small.width = 400;
    small.detail = 50;
    photographs.makeDemo(f.path(""), small);
    QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.light_field()->grid().v, 3, kScenePatience);
    QTRY_VERIFY_WITH_TIMEOUT(f.full("capture.mesh").startsWith("mesh.ply"), kScenePatience);
    QTRY_VERIFY2_WITH_TIMEOUT(f.full("capture.camera").contains("focal length"),
                              qPrintable(f.full("capture.camera")), kScenePatience);
    const std::size_t picked = f.capture().pairs().size();
    QVERIFY(picked >= 4);
    QVERIFY(!f.capture().pose());

    QTRY_VERIFY(rectify->isEnabled());
    QTest::mouseClick(rectify, Qt::LeftButton);
    auto* dialog = f.window.findChild<QDialog*>("rectify");
    QVERIFY(dialog);
    QTest::mouseClick(dialog->findChild<QPushButton*>("rectify.accept"), Qt::LeftButton);
    auto* file = f.window.findChild<QFileDialog*>("save_rectified");
    QVERIFY(file);
    emit file->fileSelected(f.path("rectified.h5"));
    QTRY_VERIFY_WITH_TIMEOUT(f.capture().pose(), kScenePatience);
    QCOMPARE(f.capture().pairs().size(), picked);
    QVERIFY(f.capture().pose()->reprojection_error_px < 1.5);
    QVERIFY(!rectify->isEnabled());
    QVERIFY2(f.full("capture.alignment").contains("aligned"),
             qPrintable(f.full("capture.alignment")));
  }

  void lens_isKeptInAFile() {
    Capturing f(false);
    Photographs& photographs = f.capture().photographs();
    capture::LensCamera camera;
    camera.width = camera.height = 96;
    camera.focal_x = camera.focal_y = 120;
    capture::write_camera(f.file("lens.yml"), camera);
    QVERIFY(!f.window.findChild<QPushButton*>("capture.rectify")->isEnabled());
    photographs.openCamera(f.path("lens.yml"));
    QVERIFY(f.window.findChild<QPushButton*>("capture.rectify")->isEnabled());
    photographs.saveCamera(f.path("again.yml"));
    QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(f.path("again.yml")), kPatience);
    QCOMPARE(capture::read_camera(f.file("again.yml")).focal_x, 120.0);
    photographs.openCamera(f.path("nowhere.yml"));
    const auto* messages = f.window.findChild<MessageBar*>("messageBar");
    QTRY_VERIFY_WITH_TIMEOUT(messages->text().contains("nowhere.yml"), kPatience);
    QCOMPARE(f.capture().work().lens->camera.focal_x, 120.0);
  }

  void brokenFiles_areTold() {
    Capturing f;
    QFile broken(f.path("broken.ply"));
    QVERIFY(broken.open(QIODevice::WriteOnly));
    broken.write("ply\nformat ascii 1.0\n");
    broken.close();
    f.capture().openMesh(f.path("broken.ply"));
    const auto* messages = f.window.findChild<MessageBar*>("messageBar");
    QTRY_VERIFY_WITH_TIMEOUT(messages->text().contains("broken.ply"), kPatience);
    QCOMPARE(f.full("capture.mesh"), QString("No mesh"));
    f.capture().importPairs(f.path("nowhere.csv"));
    QTRY_VERIFY_WITH_TIMEOUT(messages->text().contains("nowhere.csv"), kPatience);
  }
};

}  // namespace episcope::in_capture_test

EPISCOPE_WINDOW_TEST(capture_test, CaptureTest)
#include "capture_test.moc"
