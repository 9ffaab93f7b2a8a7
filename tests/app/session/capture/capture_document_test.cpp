// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/capture_work.h"
#include "engine/core/error.h"
#include "tests/test_main.h"

#include <nlohmann/json.hpp>

#include <QTest>

#include <array>
#include <cmath>

namespace episcope::in_capture_document_test {

namespace {

CameraGrid camera() {
  CameraGrid grid;
  grid.baseline = 10;
  grid.pinhole = Pinhole{500, 200, 150};
  return grid;
}

// 900 in front of the camera.
capture::PointPair pair_of(const std::string& name, const capture::Point3& p) {
  const double z = p.z + 900;
  return {name, 500 * p.x / z + 200, 500 * p.y / z + 150, p};
}

std::vector<capture::PointPair> pairs() {
  const std::array<capture::Point3, 7> points{{{-100, -80, 0},
                                               {120, -60, 30},
                                               {90, 100, -40},
                                               {-110, 70, 20},
                                               {10, 5, -60},
                                               {50, -90, 45},
                                               {-30, 40, 70}}};
  std::vector<capture::PointPair> all;
  for (const capture::Point3& each : points) all.push_back(pair_of("", each));
  return all;
}

CaptureLens lens(double focal) {
  CaptureLens lens;
  lens.camera = {400, 300, focal, focal + 1, 201, 149, {-0.1, 0.01, 0, 1e-4, 0}, 0.25};
  lens.photographs = {{"01.png", 0.2}, {"02.png", 0, "it is blurred"}};
  return lens;
}

// Every part of the work.
CaptureDocument whole() {
  CaptureDocument document;
  document.set_lens(lens(500), {capture::PatternKind::Circles, 7, 5, 20});
  document.set_rectify({12, true});
  document.add_object("/data/head.ply");
  document.add_pairs(pairs());
  document.lock_pair(2, true);
  document.add_object("/data/box.ply");
  document.add_pairs({pair_of("corner, left", {1, 2, 3})});
  return document;
}

}  // namespace

class CaptureDocumentTest : public QObject {
  Q_OBJECT

 private slots:
  void everyChange_isUndoneAndRedone() {
    CaptureDocument document = whole();
    const CaptureWork last = document.work();
    QCOMPARE(document.history().count(), std::size_t{7});
    std::vector<CaptureWork> states{last};
    while (document.history().next_undo()) {
      document.undo();
      QVERIFY(document.work() != states.back());
      states.push_back(document.work());
    }
    QVERIFY(document.work().empty());

    for (std::size_t i = states.size(); i-- > 0;) {
      QVERIFY(document.work() == states[i]);
      document.redo();
    }
    QVERIFY(document.work() == last);
    QVERIFY(!document.history().next_redo());
  }

  void whatChangesNothing_isNoStep() {
    CaptureDocument document = whole();
    const std::size_t count = document.history().count();
    document.set_lens(*document.work().lens, document.work().pattern);
    document.set_rectify({12, true});
    document.set_mesh("/data/box.ply");
    document.add_pairs({});
    document.rename_object("head");  // taken
    document.rename_object("");
    document.rename_pair(0, "a,b");
    document.choose(0);
    document.choose(7);
    QCOMPARE(document.history().count(), count);
    QCOMPARE(document.work().current, 0);
  }

  void lens_isReplacedWithAllElseKept() {
    CaptureDocument document = whole();
    document.set_lens(lens(480), {});
    QCOMPARE(document.work().lens->camera.focal_x, 480.0);
    QCOMPARE(document.work().objects.size(), std::size_t{2});
    document.undo();
    QCOMPARE(document.work().lens->camera.focal_x, 500.0);
    QCOMPARE(document.work().pattern.columns, 7);
  }

  void objects_areNamedAfterTheirMeshes() {
    CaptureDocument document;
    document.add_object("/data/head.ply");
    document.add_object("/more/head.ply");
    document.rename_object("the other");
    QCOMPARE(document.work().objects[0].name, std::string("head"));
    QCOMPARE(document.work().objects[1].name, std::string("the other"));
    document.remove_object();
    QCOMPARE(document.work().objects.size(), std::size_t{1});
    QCOMPARE(document.work().current, 0);
    document.undo();
    QCOMPARE(document.work().object()->name, std::string("the other"));
  }

  void pairs_areThoseOfTheCurrentObject() {
    CaptureDocument document = whole();
    QCOMPARE(document.pairs().size(), std::size_t{1});
    document.choose(0);
    QCOMPARE(document.pairs().size(), std::size_t{7});
    QCOMPARE(document.pairs()[6].name, std::string("7"));
    document.remove_pairs({0, 2, 6});
    QCOMPARE(document.pairs().size(), std::size_t{5});  // one is locked
    QCOMPARE(document.pairs()[1].name, std::string("3"));
  }

  void poses_followFromPairs() {
    CaptureDocument document = whole();
    QVERIFY(document.solve(camera()).empty());
    const CaptureWork& work = document.work();
    QVERIFY(work.objects[0].pose && !work.objects[1].pose);
    QVERIFY(std::abs(work.objects[0].pose->pose.translation[2] - 900) < 1e-6);
    document.choose(0);
    document.remove_pairs({3, 4, 5, 6});
    (void)document.solve(camera());
    QVERIFY(!document.work().object()->pose);
    document.undo();
    (void)document.solve(camera());
    QVERIFY(document.work().object()->pose);
    (void)document.solve({});  // without a pinhole
    QVERIFY(!document.work().object()->pose);
  }

  void project_keepsAllOfIt() {
    CaptureDocument document = whole();
    (void)document.solve(camera());
    CaptureWork work = document.work();
    work.rows = RowAlignment{{0.2, 0.6}, {0.02, 0.07}};
    const std::string json = capture_to_json(work, "/data/work.episcope");
    const CaptureWork read = capture_from_json(json, "/elsewhere/work.episcope");

    CaptureWork moved = work;
    moved.objects[0].mesh = "/elsewhere/head.ply";
    moved.objects[1].mesh = "/elsewhere/box.ply";
    QVERIFY(read == moved);
    const capture::SolvedPose& before = *work.objects[0].pose;
    const capture::SolvedPose& after = *read.objects[0].pose;
    QCOMPARE(after.pose.rotation, before.pose.rotation);
    QCOMPARE(after.pose.translation, before.pose.translation);
    QCOMPARE(after.reprojection_error_px, before.reprojection_error_px);
    QCOMPARE(after.delta_tz, before.delta_tz);
    QCOMPARE(after.pairs.size(), before.pairs.size());
    QCOMPARE(after.pairs[3].residual_px, before.pairs[3].residual_px);
    QVERIFY(!read.objects[1].pose);
  }

  void formerProject_hadOneObject() {
    const CaptureWork read = capture_from_json(
        R"({"pairs": [{"name": "p", "pixel": [1, 2], "point": [3, 4, 5], "locked": true}],
            "mesh": "scans/head.ply"})",
        "/data/work.episcope");
    QCOMPARE(read.objects.size(), std::size_t{1});
    QCOMPARE(read.objects[0].name, std::string("head"));
    QCOMPARE(read.objects[0].mesh, std::string("/data/scans/head.ply"));
    QVERIFY(read.objects[0].pairs[0].is_locked);
    QVERIFY(!read.lens);
  }

  void damagedProject_isRefused() {
    const std::string json = capture_to_json(whole().work(), "/data/work.episcope");
    for (const char* part : {"size_px", "distortion", "pixel", "point", "pattern"}) {
      std::string damaged = json;
      damaged.replace(damaged.find(part), 3, "XXX");
      bool is_refused = false;
      try {
        (void)capture_from_json(damaged, "/data/work.episcope");
      } catch (const nlohmann::json::exception&) {
        is_refused = true;
      }
      QVERIFY2(is_refused, part);
    }
  }
};

}  // namespace episcope::in_capture_document_test

EPISCOPE_TEST(capture_document_test, CaptureDocumentTest)
#include "capture_document_test.moc"
