// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/shear.h"
#include "engine/core/error.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope::in_shear_test {

namespace {

constexpr int kHeight = 40;
constexpr int kWidth = 64;
constexpr GridShape kGrid{5, 7};
constexpr ViewIndex kCenter = {2, 3};

float texture(double x, double y) {
  return static_cast<float>(0.5 + 0.2 * std::sin(0.5 * x) + 0.2 * std::cos(0.4 * y));
}

template <class Value>
auto stack_of(const Value& value) {
  using T = decltype(value(ViewIndex(), 0, 0));
  ViewStack<T> stack(kGrid, kHeight, kWidth);
  for (int v = 0; v < kGrid.v; ++v) {
    for (int u = 0; u < kGrid.u; ++u) {
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) stack.view({v, u}).at(y, x) = value({v, u}, y, x);
      }
    }
  }
  return stack;
}

// A smooth texture on one plane of disparity `d`, as every view sees it.
ViewStack<float> plane_of(double d) {
  return stack_of([d](ViewIndex view, int y, int x) {
    return texture(x + d * (view.u - kCenter.u), y + d * (view.v - kCenter.v));
  });
}

// Largest difference, but for the border that is repeated.
double largest_difference(const LightField& a, const LightField& b, int inset) {
  double largest = 0;
  for (int v = 0; v < kGrid.v; ++v) {
    for (int u = 0; u < kGrid.u; ++u) {
      for (int y = inset; y < kHeight - inset; ++y) {
        for (int x = inset; x < kWidth - inset; ++x) {
          const double off = a.view<float>({v, u}).at(y, x) - b.view<float>({v, u}).at(y, x);
          largest = std::max(largest, std::abs(off));
        }
      }
    }
  }
  return largest;
}

// Label 1 left of column 50, 2 from there, on a corner view, the center and one between.
Scribbles painted_everywhere() {
  Scribbles scribbles;
  scribbles.labels = {{1, "left", {}}, {2, "right", {}}};
  for (const ViewIndex view : {ViewIndex{0, 0}, ViewIndex{1, 4}, kCenter}) {
    Image<std::int32_t> labels(kHeight, kWidth);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) labels.at(y, x) = x < 50 ? 1 : 2;
    }
    labels.at(17, 23) = 0;
    scribbles.views.push_back({view, std::move(labels)});
  }
  return scribbles;
}

}  // namespace

class ShearTest : public QObject {
  Q_OBJECT

 private slots:
  void plane_hasItsDisparityLessTheFocus_data() {
    QTest::addColumn<double>("focus");
    QTest::addColumn<double>("tolerance");
    QTest::newRow("whole pixels") << 1.0 << 1e-6;
    QTest::newRow("negative") << -2.0 << 1e-6;
    // Cubic interpolation of a wave of 12 px is off by 6e-4 at most (h³·f‴ terms vanish).
    QTest::newRow("between pixels") << 0.37 << 1e-3;
    QTest::newRow("other way") << -0.73 << 1e-3;
  }

  void plane_hasItsDisparityLessTheFocus() {
    QFETCH(double, focus);
    QFETCH(double, tolerance);
    const LightField before(plane_of(0.6), {});

    const LightFieldPtr after = sheared(before, focus, Progress());

    const double off = largest_difference(*after, LightField(plane_of(0.6 - focus), {}), 10);
    QVERIFY2(off < tolerance, qPrintable(QString::number(off)));
  }

  void centerView_stays() {
    const LightField before(stack_of([](ViewIndex view, int y, int x) {
                              return static_cast<std::uint8_t>(view.v * 31 + y * 7 + x * 3);
                            }),
                            {});

    const LightFieldPtr after = sheared(before, 0.4, Progress());

    const auto a = before.view<std::uint8_t>(kCenter);
    const auto b = after->view<std::uint8_t>(kCenter);
    QVERIFY(std::equal(a.data, a.data + a.size(), b.data));
  }

  void extremeSamples_stayInTheirType() {
    const LightField before(stack_of([](ViewIndex, int, int x) {
                              return static_cast<std::uint8_t>(x % 4 < 2 ? 255 : 0);
                            }),
                            {});

    const LightFieldPtr after = sheared(before, 0.5, Progress());

    // Beside an edge, a cubic overshoots; wrapped around, white would become black.
    const auto row = after->view<std::uint8_t>({2, 4}).row(20);
    for (int x = 8; x < kWidth - 8; ++x) {
      const bool is_edge = x % 2 == 0;
      if (!is_edge) QVERIFY(row[x] > 240 || row[x] < 15);
    }
  }

  void invalidPixels_moveWithTheirView_data() {
    QTest::addColumn<double>("focus");
    QTest::addColumn<int>("first");
    QTest::addColumn<int>("last");
    // View u = 5 is fetched 2·focus further left; a cubic takes in two pixels to either side.
    QTest::newRow("whole pixels") << 1.0 << 32 << 32;
    QTest::newRow("between pixels") << 0.25 << 29 << 32;
  }
  void invalidPixels_moveWithTheirView() {
    QFETCH(double, focus);
    QFETCH(int, first);
    QFETCH(int, last);
    ViewStack<std::uint8_t> valid(kGrid, kHeight, kWidth);
    std::fill_n(valid.data(), valid.size(), std::uint8_t{1});
    const ViewIndex view{2, 5};
    valid.view(view).at(17, 30) = 0;
    const LightField before(plane_of(0.6), {}, std::move(valid));

    const LightFieldPtr after = sheared(before, focus, Progress());

    for (int x = 0; x < kWidth; ++x) {
      QCOMPARE(after->is_valid(view, 17, x), x < first || x > last);
      QVERIFY(after->is_valid(view, 10, x) && after->is_valid(kCenter, 17, x));
    }
  }

  void borderThatLeft_isRepeated() {
    const LightField before(plane_of(0), {});

    const LightFieldPtr after = sheared(before, 2, Progress());

    // View u = 6 is fetched six pixels further left.
    QCOMPARE(after->view<float>({2, 6}).at(9, 0), before.view<float>({2, 6}).at(9, 0));
    QCOMPARE(after->view<float>({2, 6}).at(9, 5), before.view<float>({2, 6}).at(9, 0));
    QCOMPARE(after->view<float>({2, 6}).at(9, 20), before.view<float>({2, 6}).at(9, 14));
  }

  void depth_staysWhatItWas() {
    LightFieldInfo info;
    info.camera = {100, 2, 1.5, 200 / 1.5};
    info.disparity_range = Interval{-1, 2};
    const LightField before(plane_of(0.5), info);

    const LightFieldPtr after = sheared(before, 0.5, Progress());

    const CameraGrid& camera = after->info().camera;
    QCOMPARE(camera.depth_from_disparity(0.0), info.camera.depth_from_disparity(0.5));
    QCOMPARE(*camera.cam_distance, info.camera.depth_from_disparity(0.5));
    QVERIFY(*after->info().disparity_range == (Interval{-1.5, 1.5}));
  }

  void truth_movesWithItsViews() {
    DisparityField slope;
    slope.disparity = stack_of([](ViewIndex, int y, int x) { return 0.01F * x + 0.02F * y; });

    const DisparityField after = sheared(slope, kCenter, 0.5, Progress());

    for (const ViewIndex view : {kCenter, ViewIndex{0, 6}, ViewIndex{3, 1}}) {
      const double x = 30 - 0.5 * (view.u - kCenter.u);
      const double y = 20 - 0.5 * (view.v - kCenter.v);
      QVERIFY(after.view(view).is_valid(20, 30));
      const double off = after.view(view).disparity.at(20, 30) - (0.01 * x + 0.02 * y - 0.5);
      QVERIFY2(std::abs(off) < 1e-5, qPrintable(QString::number(off)));
    }
    QVERIFY(!after.view({2, 6}).is_valid(20, 0));  // there the border is repeated
    QVERIFY(after.view(kCenter).is_valid(0, 0));
  }

  void edgeOfTruth_isNotBlurred() {
    DisparityField edge;
    edge.disparity = stack_of([](ViewIndex, int, int x) { return x < 30 ? 1.0F : 0.0F; });
    edge.disparity.view({2, 5}).at(20, 50) = std::numeric_limits<float>::quiet_NaN();

    const DisparityField after = sheared(edge, kCenter, 0.25, Progress());

    for (int x = 2; x < kWidth - 2; ++x) {
      if (!after.view({2, 5}).is_valid(20, x)) continue;
      const float value = after.view({2, 5}).disparity.at(20, x);
      QVERIFY2(value == 0.75F || value == -0.25F, qPrintable(QString::number(value)));
    }
    QVERIFY(!after.view({2, 5}).is_valid(20, 50));
  }

  void estimate_movesWithConfidenceRangeAndHash() {
    Estimate before;
    before.field.disparity = stack_of([](ViewIndex, int, int) { return 0.75F; });
    before.confidence = stack_of([](ViewIndex, int, int x) { return x < 32 ? 0.2F : 0.8F; });
    before.range = {-1, 1};
    before.camera = {.baseline = 2, .focal_length = 4, .shift = 1};
    before.parameters = {{"range", IntervalOrAuto(Interval{-1, 1})}, {"edges", true}};

    const Estimate after = sheared(before, {kCenter, 17}, 1, Progress());

    QCOMPARE(after.field.view({1, 4}).disparity.at(9, 9), -0.25F);
    QCOMPARE(after.confidence.view({2, 6}).at(9, 34), 0.2F);  // 3 views · 1 px further right
    QCOMPARE(after.confidence.view({2, 6}).at(9, 35), 0.8F);
    QVERIFY(after.range == (Interval{-2, 0}));
    QVERIFY(std::get<IntervalOrAuto>(after.parameters[0].second) ==
            IntervalOrAuto(Interval{-2, 0}));
    QCOMPARE(after.source_hash, std::uint64_t{17});
    QCOMPARE(after.camera.depth_from_disparity(-0.25), before.camera.depth_from_disparity(0.75));
    QCOMPARE(after.notes.size(), 1U);
  }

  void absurdFocus_isRefused_data() {
    QTest::addColumn<double>("focus");
    QTest::newRow("out of the image") << 12.0;
    QTest::newRow("NaN") << std::numeric_limits<double>::quiet_NaN();
    QTest::newRow("infinite") << -std::numeric_limits<double>::infinity();
  }

  void absurdFocus_isRefused() {
    QFETCH(double, focus);
    const LightField light_field(plane_of(0), {});

    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)sheared(light_field, focus, Progress()));
  }

  void scribbles_comeBackToTheViewsAsTheyWere_data() {
    QTest::addColumn<double>("focus");
    for (const double focus : {1.0, -2.0, 0.37, -0.5, 0.5}) QTest::addRow("%g px", focus) << focus;
  }

  void scribbles_comeBackToTheViewsAsTheyWere() {
    QFETCH(double, focus);
    const Scribbles before = painted_everywhere();

    const Scribbles moved = sheared(before, kCenter, focus);
    const Scribbles back = unsheared(moved, before, kCenter, focus);

    QVERIFY(!std::ranges::equal(moved.views[0].labels, before.views[0].labels));
    QCOMPARE(back.views.size(), before.views.size());
    for (std::size_t i = 0; i < before.views.size(); ++i) {
      QCOMPARE(back.views[i].view, before.views[i].view);
      QVERIFY(std::ranges::equal(back.views[i].labels, before.views[i].labels));
    }
  }

  void scribbles_thatAreNew_goWhereTheyBelong() {
    Scribbles painted;
    painted.labels = {{2, "new", {}}};
    painted.views.push_back({{0, 0}, Image<std::int32_t>(kHeight, kWidth)});
    painted.views[0].labels.at(10, 20) = 2;

    // Row y of view (0, 0) was fetched at y − 2·(0 − 2), column x at x − 2·(0 − 3).
    const Scribbles back = unsheared(painted, {}, kCenter, 2);

    QCOMPARE(back.views.size(), std::size_t{1});
    QCOMPARE(back.views[0].labels.at(14, 26), 2);
    QCOMPARE(static_cast<int>(std::ranges::count(back.views[0].labels, 0)), kHeight * kWidth - 1);
  }

  void scribbles_outOfSight_stayUnlessTheirLabelIsGone() {
    const Scribbles before = painted_everywhere();
    Scribbles erased;  // on all views, and label 2 is removed
    erased.labels = {{1, "kept", {}}};

    const Scribbles back = unsheared(erased, before, kCenter, 2);

    QCOMPARE(back.views.size(), before.views.size() - 1);  // all of the center view is in sight
    const Image<std::int32_t>& first = back.views[0].labels;
    QCOMPARE(first.at(0, 30), 1);  // the view begins at row 4 and column 6 now
    QCOMPARE(first.at(20, 2), 1);
    QCOMPARE(first.at(4, 6), 0);
    QCOMPARE(static_cast<int>(std::ranges::count(first, 2)), 0);
  }
};

}  // namespace episcope::in_shear_test

EPISCOPE_TEST(shear_test, ShearTest)
#include "shear_test.moc"
