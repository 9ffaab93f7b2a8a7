// SPDX-License-Identifier: BSD-3-Clause
// Stereo on views of different brightness, and of cameras that stand beside their grid.
#include "engine/core/view_gain.h"
#include "engine/disparity/registry.h"
#include "engine/scenes/builtin.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace episcope::in_unlike_views_test {

using namespace episcope::test;

namespace {

constexpr GridShape kGrid{7, 7};

double mse(const std::string& method, const Scene& scene, const LightField& lf,
           ParameterSet values = {}) {
  values.emplace_back("range", Interval{-2.2, 2.2});
  const Estimate estimate =
      find_estimator(method).run(lf, values, {.views = ViewSelection::Center}, Progress());
  return errors(estimate.field.disparity.view(lf.center()), scene.truth->field.view(lf.center()), 6)
      .mse_100;
}

// Every view but the center brighter or darker by up to a tenth, which methods shall not even out.
LightField with_gains(const LightField& lf) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> gain(0.9F, 1.1F);
  ViewStack<float> samples = float_samples(lf);
  for (int i = 0; i < lf.grid().count(); ++i) {
    const ViewIndex view = lf.grid().view_at(i);
    if (view == lf.center()) continue;
    const float factor = gain(random);
    float* const first = samples.view(view).data;
    std::transform(first, first + samples.view_size(), first,
                   [factor](float sample) { return factor * sample; });
  }
  LightFieldInfo info = lf.info();
  info.reading.options = {{kKeepBrightness, true}};
  return {std::move(samples), std::move(info)};
}

// Less by the straight line that fits best along the grid, so that the mean step stays 1.
void take_trend(GridShape grid, std::vector<double>& offsets) {
  const ViewIndex center = grid.center();
  for (const bool along_u : {true, false}) {
    double sum = 0, weight = 0;
    const auto step = [&](std::size_t i) {
      const ViewIndex view = grid.view_at(static_cast<int>(i));
      return static_cast<double>(along_u ? view.u - center.u : view.v - center.v);
    };
    for (std::size_t i = 0; i < offsets.size(); ++i) {
      sum += step(i) * offsets[i];
      weight += step(i) * step(i);
    }
    for (std::size_t i = 0; i < offsets.size(); ++i) offsets[i] -= sum / weight * step(i);
  }
}

// Up to a third of a step beside the grid, the center view on it.
std::vector<CameraPosition> jittered(GridShape grid) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> off(-0.33, 0.33);
  const ViewIndex center = grid.center();
  std::vector<double> dx, dy;
  for (int i = 0; i < grid.count(); ++i) {
    const bool moves = grid.view_at(i) != center;
    dx.push_back(moves ? off(random) : 0);
    dy.push_back(moves ? off(random) : 0);
  }
  take_trend(grid, dx);
  take_trend(grid, dy);
  std::vector<CameraPosition> positions;
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = grid.view_at(i);
    positions.push_back({view.u - center.u + dx[i], view.v - center.v + dy[i]});
  }
  return positions;
}

Scene render_at(const std::vector<CameraPosition>& positions) {
  scenes::RenderOptions options;
  options.grid = kGrid;
  options.height = 96;
  options.width = 104;
  options.disparity_scale = 2;
  options.positions = positions;
  return scenes::render_builtin("slant", options, Progress());
}

LightField with_positions(const LightField& lf, std::vector<CameraPosition> positions) {
  LightFieldInfo info = lf.info();
  info.positions = std::move(positions);
  return {float_samples(lf), std::move(info)};
}

void add_methods() {
  QTest::addColumn<QString>("method");
  for (const char* method : {"st_av_l", "st_ch_l", "st_av_s", "st_ch_s", "st_av_g", "st_ch_g"}) {
    QTest::newRow(method) << method;
  }
}

std::string fetched() {
  QFETCH(QString, method);
  return method.toStdString();
}

QString numbers(double a, double b, double c) {
  return QString("%1, %2, %3").arg(a).arg(b).arg(c);
}

}  // namespace

class UnlikeViewsTest : public QObject {
  Q_OBJECT

 private slots:
  void relativeCost_bearsGains_data() { add_methods(); }
  void relativeCost_bearsGains();
  void positions_areUsed_data() {
    add_methods();
    QTest::newRow("net") << "net";
  }
  void positions_areUsed();
  void rowsFartherApart_areMeasuredInColumns();
  void methodsOfEpis_sayWhatTheyAssume();
  void wrongPositions_doNoHarm_data();
  void wrongPositions_doNoHarm();
};

void UnlikeViewsTest::relativeCost_bearsGains() {
  const Scene scene = render("objects", 96, 104, kGrid);
  const LightField unlike = with_gains(*scene.light_field);
  const ParameterSet relative{{"cost", std::string("relative")}};

  const double alike = mse(fetched(), scene, *scene.light_field, relative);
  const double with = mse(fetched(), scene, unlike, relative);
  const double plain = mse(fetched(), scene, unlike);

  QVERIFY2(with < 1.5 * alike, qPrintable(numbers(alike, with, plain)));
  QVERIFY2(plain > 1.5 * with, qPrintable(numbers(alike, with, plain)));
}

void UnlikeViewsTest::positions_areUsed() {
  const Scene regular = render_at({}), scene = render_at(jittered(kGrid));

  const double on_grid = mse(fetched(), regular, *regular.light_field);
  const double used = mse(fetched(), scene, *scene.light_field);
  const double ignored =
      mse(fetched(), scene, *scene.light_field, {{"positions", std::string("ignore")}});

  QVERIFY2(used < 1.3 * on_grid + 0.01, qPrintable(numbers(on_grid, used, ignored)));
  QVERIFY2(ignored > 2 * used, qPrintable(numbers(on_grid, used, ignored)));
}

// In millimeters, to the left and up, rows half as far apart again as columns.
void UnlikeViewsTest::rowsFartherApart_areMeasuredInColumns() {
  std::vector<CameraPosition> true_places, stated;
  for (int i = 0; i < kGrid.count(); ++i) {
    const ViewIndex view = kGrid.view_at(i), center = kGrid.center();
    true_places.push_back({static_cast<double>(view.u - center.u), 1.5 * (view.v - center.v)});
    stated.push_back({300 - 8 * true_places.back().x, 70 - 8 * true_places.back().y});
  }
  const Scene scene = render_at(true_places);
  const LightField lf = with_positions(*scene.light_field, stated);

  const double used = mse("st_av_l", scene, lf);
  const double ignored = mse("st_av_l", scene, lf, {{"positions", std::string("ignore")}});

  QVERIFY2(used < 0.5 && ignored > 4 * used, qPrintable(numbers(0, used, ignored)));
}

void UnlikeViewsTest::methodsOfEpis_sayWhatTheyAssume() {
  const auto notes_cameras = [](const Scene& scene) {
    const Estimate estimate = find_estimator("epi_l").run(
        *scene.light_field, {}, {.views = ViewSelection::Center}, Progress());
    return std::ranges::any_of(estimate.notes, [](const std::string& note) {
      return note.starts_with("cameras stand up to 0.");
    });
  };
  QVERIFY(notes_cameras(render_at(jittered(kGrid))));
  QVERIFY(!notes_cameras(render_at({})));
}

void UnlikeViewsTest::wrongPositions_doNoHarm_data() {
  QTest::addColumn<QString>("what");
  for (const char* what : {"jitter", "outlier", "zero", "nan", "columns first"}) {
    QTest::newRow(what) << what;
  }
}

// Stated for a light field whose views do stand on the grid.
void UnlikeViewsTest::wrongPositions_doNoHarm() {
  QFETCH(QString, what);
  const Scene scene = render_at({});
  std::vector<CameraPosition> stated = jittered(kGrid);
  if (what != "jitter") {
    for (int i = 0; i < kGrid.count(); ++i) {
      const ViewIndex view = kGrid.view_at(i);
      stated[i] = {8.0 * view.u, 8.0 * view.v};
      if (what == "zero") stated[i] = {0, 0};
      if (what == "columns first") stated[i] = {8.0 * view.v, 8.0 * view.u};
    }
  }
  if (what == "outlier") stated[9] = {4000, -3};
  if (what == "nan") stated[9].x = std::nan("");

  const double on_grid = mse("st_av_l", scene, *scene.light_field);
  const double with = mse("st_av_l", scene, with_positions(*scene.light_field, stated));

  QVERIFY2(with < 1.05 * on_grid + 0.002, qPrintable(numbers(on_grid, with, 0)));
}

}  // namespace episcope::in_unlike_views_test

EPISCOPE_TEST(unlike_views_test, UnlikeViewsTest)
#include "unlike_views_test.moc"
