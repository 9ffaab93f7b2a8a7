// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/light_field.h"
#include "tests/test_main.h"

#include <cmath>
#include <vector>

namespace episcope::in_view_places_test {

namespace {

constexpr GridShape kGrid{5, 7};

// Columns 8.2 mm apart, to the left, and rows `row_step` columns apart; each row starts a little
// farther right.
std::vector<CameraPosition> gantry(double row_step = 1) {
  std::vector<CameraPosition> positions;
  for (int i = 0; i < kGrid.count(); ++i) {
    const ViewIndex view = kGrid.view_at(i);
    positions.push_back({100 - 8.2 * view.u + 0.3 * view.v, -380 + 8.2 * row_step * view.v});
  }
  return positions;
}

ViewPlaces places_of(std::vector<CameraPosition> positions, GridShape grid = kGrid) {
  LightFieldInfo info;
  info.positions = std::move(positions);
  return view_places(info, grid);
}

// From the first view.
ViewPlace way_to(const ViewPlaces& places, ViewIndex view) {
  const ViewPlace& there = places.places[static_cast<std::size_t>(view.v) * kGrid.u + view.u];
  return {there.v - places.places[0].v, there.u - places.places[0].u};
}

}  // namespace

class ViewPlacesTest : public QObject {
  Q_OBJECT

 private slots:
  void noPositions_areUnknown() {
    QVERIFY(places_of({}).kind == PlacesKind::Unknown);
    QVERIFY(places_of({{1, 2}, {3, 4}}).kind == PlacesKind::Unknown);
  }

  void exactGrid_isRegular() {
    auto positions = gantry();
    for (int i = 0; i < kGrid.count(); ++i) positions[i].x -= 0.3 * kGrid.view_at(i).v;
    const ViewPlaces places = places_of(positions);
    QVERIFY(places.kind == PlacesKind::Regular && places.places.empty());
  }

  void places_areInStepsOfTheColumns() {
    const ViewPlaces places = places_of(gantry(1.25));

    QVERIFY(places.kind == PlacesKind::Irregular);
    const ViewPlace way = way_to(places, {4, 3});
    QVERIFY(std::fabs(way.v - 5) < 1e-4);
    QVERIFY(std::fabs(way.u - (3 - 4 * 0.3 / 8.2)) < 1e-4);
    QVERIFY(std::fabs(places.largest_deviation - 0.5) < 1e-4);
  }

  void outlier_getsThePlaceOfTheGrid() {
    auto positions = gantry();
    positions[10] = {0, 0};
    positions[20].y = std::nan("");

    const ViewPlaces places = places_of(positions);

    QCOMPARE(places.outliers, 2);
    QVERIFY(places.kind == PlacesKind::Irregular && places.largest_deviation < 0.2);
    QVERIFY(std::fabs(way_to(places, {1, 3}).u - (3 - 0.3 / 8.2)) < 1e-4);
  }

  void whatIsNoGrid_isImplausible_data() {
    QTest::addColumn<QString>("what");
    for (const char* what : {"all alike", "columns first", "mixed up", "far apart", "nan"}) {
      QTest::newRow(what) << what;
    }
  }
  void whatIsNoGrid_isImplausible() {
    QFETCH(QString, what);
    auto positions = gantry(what == "far apart" ? 3 : 1);
    for (int i = 0; i < kGrid.count(); ++i) {
      if (what == "all alike") positions[i] = {3, 3};
      if (what == "columns first") std::swap(positions[i].x, positions[i].y);
      if (what == "mixed up") positions[i] = gantry()[i * 13 % kGrid.count()];
      if (what == "nan") positions[i].x = std::nan("");
    }
    QVERIFY(places_of(positions).kind == PlacesKind::Implausible);
  }

  void oneRow_hasPlaces() {
    const ViewPlaces places = places_of({{0, 0}, {1.1, 0}, {2, 0.1}, {3, 0}}, {1, 4});
    QVERIFY(places.kind == PlacesKind::Irregular);
    QVERIFY(places.places[1].u > places.places[0].u + 1);
  }
};

}  // namespace episcope::in_view_places_test

EPISCOPE_TEST(view_places_test, ViewPlacesTest)
#include "view_places_test.moc"
