// SPDX-License-Identifier: BSD-3-Clause
// What is read and computed for the Capture tab while other light fields are opened and closed.
#include "app/gui/capture/capture_controller.h"
#include "app/gui/capture/photographs.h"
#include "app/session/load_scene.h"
#include "engine/capture/demo_folder.h"
#include "tests/app/gui/capture/capturing.h"
#include "tests/app/gui/held_lane.h"
#include "tests/window_test_main.h"
#include "widgets/controls/message_bar.h"

namespace episcope::in_capture_jobs_test {

namespace {

capture::DemoOptions small_demo() {
  capture::DemoOptions options;
  options.grid = {3, 3};
  options.height = 300;
  options.width = 400;
  options.detail = 50;
  return options;
}

class AtWork : public Capturing {
 public:
  [[nodiscard]] Jobs& jobs() { return window.bench().jobs; }
  [[nodiscard]] Session& session() { return window.bench().session; }
  [[nodiscard]] const CaptureWork& workOf(std::uint64_t scene) {
    return session().find_scene(scene)->place.capture;
  }
  [[nodiscard]] QString message() { return window.findChild<MessageBar*>("messageBar")->text(); }
};

struct Two {
  std::uint64_t left = 0;
  std::uint64_t shown = 0;
};

// A mesh that is still to be read when another light field is shown.
Two open_mesh_and_leave(AtWork& f) {
  Two scenes{.left = f.session().generation()};
  f.openSmall("slant");
  scenes.shown = f.session().generation();
  f.session().choose(scenes.left);
  f.capture().openMesh(f.path("scan.ply"));
  f.session().choose(scenes.shown);
  return scenes;
}

}  // namespace

class CaptureJobsTest : public QObject {
  Q_OBJECT

 private slots:
  void meshIsRead_whileAnotherLightFieldIsOpened() {
    AtWork f;
    HeldLane held(f.jobs(), Lane::Load);
    f.capture().openMesh(f.path("scan.ply"));

    f.openSmall("slant");
    held.release();

    QTRY_VERIFY_WITH_TIMEOUT(find<MeshShelf>(f.window).find(f.file("scan.ply").string()),
                             kPatience);
  }

  void demoIsMade_whileAnotherLightFieldIsOpened() {
    AtWork f;
    HeldLane held(f.jobs(), Lane::Capture);
    f.capture().photographs().makeDemo(f.path(""), small_demo());

    f.openSmall("slant");
    held.release();

    QTRY_COMPARE_WITH_TIMEOUT(f.session().light_field()->grid().v, 3, kScenePatience);
  }

  void cancelledMesh_isReadLater() {
    AtWork f;
    auto& shelf = find<MeshShelf>(f.window);
    const std::string file = f.file("scan.ply").string();
    HeldLane held(f.jobs(), Lane::Load);
    shelf.read(file, [] {});
    f.jobs().cancelLane(Lane::Load);
    held.release();
    QTRY_VERIFY_WITH_TIMEOUT(!shelf.isReading(file), kPatience);
    QVERIFY(!shelf.find(file));

    shelf.keep({file});

    QTRY_VERIFY_WITH_TIMEOUT(shelf.find(file), kPatience);
  }

  void brokenMesh_isReadOnce() {
    AtWork f;
    auto& shelf = find<MeshShelf>(f.window);
    const std::string file = f.file("none.ply").string();
    shelf.read(file, [] {});
    QTRY_VERIFY_WITH_TIMEOUT(!shelf.isReading(file), kPatience);

    shelf.keep({file});

    QVERIFY(!shelf.isReading(file));
  }

  void mesh_isOfTheLightFieldThatWasShown() {
    AtWork f;
    HeldLane held(f.jobs(), Lane::Load);
    const auto [edge, slant] = open_mesh_and_leave(f);
    held.release();

    QTRY_COMPARE_WITH_TIMEOUT(f.jobs().count(Lane::Load), 0, kPatience);
    QCOMPARE(f.workOf(edge).objects.size(), std::size_t{1});
    QVERIFY(f.workOf(slant).objects.empty());
    f.session().choose(edge);
    f.awaitMesh("scan.ply");
  }

  void meshOfAClosedLightField_isToldAndDropped() {
    AtWork f;
    HeldLane held(f.jobs(), Lane::Load);
    const auto [edge, slant] = open_mesh_and_leave(f);
    f.session().remove(edge);
    held.release();

    QTRY_VERIFY2_WITH_TIMEOUT(f.message().contains("scan.ply"), qPrintable(f.message()), kPatience);
    QVERIFY(f.workOf(slant).objects.empty());
  }

  void lens_isOfTheLightFieldThatWasShown() {
    AtWork f;
    const GantryFolder demo{f.file("demo")};
    capture::write_demo_folder(demo.path, small_demo(), Progress());
    QStringList photographs;
    for (const auto& each : demo.pattern()) photographs << QString::fromStdString(each.string());
    const std::uint64_t edge = f.session().generation();
    f.openSmall("slant");
    const std::uint64_t slant = f.session().generation();
    f.session().choose(edge);
    HeldLane held(f.jobs(), Lane::Capture);
    f.capture().photographs().calibrate(photographs, capture::demo_pattern());

    f.session().choose(slant);
    held.release();

    QTRY_COMPARE_WITH_TIMEOUT(f.jobs().count(Lane::Capture), 0, kScenePatience);
    QVERIFY(f.workOf(edge).lens.has_value());
    QVERIFY(!f.workOf(slant).lens.has_value());
  }
};

}  // namespace episcope::in_capture_jobs_test

EPISCOPE_WINDOW_TEST(capture_jobs_test, CaptureJobsTest)
#include "capture_jobs_test.moc"
