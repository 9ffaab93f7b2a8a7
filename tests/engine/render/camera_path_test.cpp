// SPDX-License-Identifier: BSD-3-Clause
#include "engine/render/movie.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <utility>

namespace episcope::in_camera_path_test {

using render::camera_path;
using render::CameraPath;

class CameraPathTest : public QObject {
  Q_OBJECT

 private slots:
  void path_movesToNeighboursAndEndsWhereItBegan_data() {
    QTest::addColumn<int>("v");
    QTest::addColumn<int>("u");
    for (const auto& [v, u] : {std::pair{9, 9}, {5, 8}, {3, 3}, {2, 2}, {1, 9}, {7, 1}, {27, 27}}) {
      QTest::addRow("%dx%d", v, u) << v << u;
    }
  }
  void path_movesToNeighboursAndEndsWhereItBegan() {
    QFETCH(const int, v);
    QFETCH(const int, u);
    for (const CameraPath path : {CameraPath::Circle, CameraPath::Swing, CameraPath::Snake}) {
      const auto views = camera_path({v, u}, path);
      QVERIFY(views.size() > 1);
      for (std::size_t i = 0; i < views.size(); ++i) {
        const ViewIndex here = views[i], next = views[(i + 1) % views.size()];
        QVERIFY((GridShape{v, u}.contains(here)));
        QVERIFY(!(here == next));
        QVERIFY(std::abs(here.v - next.v) <= 1 && std::abs(here.u - next.u) <= 1);
      }
    }
  }

  void circle_reachesTheOutermostViewsAndAvoidsTheCentre() {
    const auto views = camera_path({9, 9}, CameraPath::Circle);
    const auto has = [&](ViewIndex view) { return std::ranges::find(views, view) != views.end(); };
    QVERIFY(has({0, 4}) && has({8, 4}) && has({4, 0}) && has({4, 8}));
    QVERIFY(!has({4, 4}) && !has({0, 0}));
  }

  void snake_seesEveryView() {
    std::set<std::pair<int, int>> seen;
    for (const ViewIndex view : camera_path({4, 5}, CameraPath::Snake)) {
      seen.insert({view.v, view.u});
    }
    QCOMPARE(seen.size(), std::size_t{20});
  }

  void oneView_isAPath() {
    QCOMPARE(camera_path({1, 1}, CameraPath::Circle).size(), std::size_t{1});
  }

  void focus_goesThereAndBack() {
    const auto values = render::there_and_back(-1, 2, 8);
    QCOMPARE(values.size(), std::size_t{8});
    QCOMPARE(values[0], -1.0);
    QCOMPARE(values[4], 2.0);
    for (int i = 1; i < 4; ++i) QVERIFY(std::abs(values[i] - values[8 - i]) < 1e-12);
  }
};

}  // namespace episcope::in_camera_path_test

EPISCOPE_TEST(camera_path_test, CameraPathTest)
#include "camera_path_test.moc"
