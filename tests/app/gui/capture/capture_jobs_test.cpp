// SPDX-License-Identifier: BSD-3-Clause
// What is read and computed for the Capture tab while other light fields are opened and closed.
#include "app/gui/capture/mesh_shelf.h"
#include "app/gui/capture/photographs.h"
#include "tests/app/gui/capture/capturing.h"
#include "tests/app/gui/held_lane.h"
#include "tests/window_test_main.h"

namespace episcope::in_capture_jobs_test {

namespace {

class AtWork : public Capturing {
 public:
  [[nodiscard]] Jobs& jobs() { return window.bench().jobs; }
  [[nodiscard]] Session& session() { return window.bench().session; }
};

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
    capture::DemoOptions small;
    small.grid = {3, 3};
    small.height = 300;
    small.width = 400;
    small.detail = 50;
    HeldLane held(f.jobs(), Lane::Capture);
    f.capture().photographs().makeDemo(f.path(""), small);

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
};

}  // namespace episcope::in_capture_jobs_test

EPISCOPE_WINDOW_TEST(capture_jobs_test, CaptureJobsTest)
#include "capture_jobs_test.moc"
