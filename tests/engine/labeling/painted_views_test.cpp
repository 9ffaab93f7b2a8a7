// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/correct_views.h"

#include "tests/test_main.h"

#include <algorithm>

namespace episcope::in_painted_views_test {

namespace {

constexpr GridShape kGrid{3, 4};

// `pixels` of the first row have label 1.
ViewScribbles painted(ViewIndex view, int pixels) {
  ViewScribbles scribbles{view, Image<std::int32_t>(8, 20)};
  std::fill_n(scribbles.labels.row(0), pixels, 1);
  return scribbles;
}

// A fill of all views, which shows fewer pixels to the right.
Scribbles filled() {
  Scribbles scribbles;
  for (int i = 0; i < kGrid.count(); ++i) {
    scribbles.views.push_back(painted(kGrid.view_at(i), 15 - kGrid.view_at(i).u));
  }
  return scribbles;
}

}  // namespace

class PaintedViewsTest : public QObject {
  Q_OBJECT

 private slots:
  void fewViews_allTeach_inTheirOrder() {
    const std::vector<ViewScribbles> views{painted({0, 0}, 1), painted({1, 1}, 9)};
    const auto teaching = teaching_views(views);
    QCOMPARE(teaching, (std::vector<const ViewScribbles*>{&views[0], &views[1]}));
  }

  void ofManyViews_thosePaintedMostTeach_andThatWithALabelOfItsOwn() {
    Scribbles scribbles = filled();
    scribbles.views[11].labels.row(5)[0] = 9;

    const auto teaching = teaching_views(scribbles.views);

    QCOMPARE(teaching.size(), kTeachingViews + 1);
    const auto teaches = [&](std::size_t i) {
      return std::ranges::count(teaching, &scribbles.views[i]) == 1;
    };
    QVERIFY(teaches(0) && teaches(4) && teaches(8) && teaches(11));
    QVERIFY(!teaches(3) && !teaches(7) && !teaches(10));
  }

  void newStrokes_areThoseOfTheViewInSight_whereAllHaveSome() {
    Scribbles former = filled();
    const Scribbles now = filled();
    QVERIFY(new_strokes(former, now, {0, 0}).empty());
    for (auto& view : former.views) view.labels.row(0)[0] = 0;
    former.views[5].labels.row(0)[1] = 0;

    const auto in_sight = new_strokes(former, now, {2, 3});
    QCOMPARE(in_sight.size(), std::size_t{1});
    QCOMPARE(in_sight[0].view, (ViewIndex{2, 3}));
    QCOMPARE(std::ranges::count(in_sight[0].pixels, 1), 1);

    // Where the view in sight has none, the one that has most.
    former.views[11] = now.views[11];
    QCOMPARE(new_strokes(former, now, {2, 3})[0].view, kGrid.view_at(5));
  }

  void newStrokes_ofFewViews_areAllRead() {
    const Scribbles former = filled();
    Scribbles now = filled();
    now.views.erase(now.views.begin());
    now.views[4].labels.row(3)[3] = 2;
    const auto strokes = new_strokes(former, now, {2, 2});
    QCOMPARE(strokes.size(), std::size_t{2});
    QCOMPARE(strokes[0].view, (ViewIndex{0, 0}));
    QCOMPARE(std::ranges::count(strokes[0].pixels, 1), 15);
    QCOMPARE(strokes[1].pixels.at(3, 3), 1);
  }
};

}  // namespace episcope::in_painted_views_test

EPISCOPE_TEST(painted_views_test, PaintedViewsTest)
#include "painted_views_test.moc"
