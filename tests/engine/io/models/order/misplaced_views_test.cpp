// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/order/misplaced_views.h"
#include "engine/core/finding.h"
#include "engine/io/models/assemble_scene.h"
#include "engine/io/open.h"
#include "tests/engine/io/archive_files.h"
#include "tests/engine/io/models/order/layered_scene.h"
#include "tests/engine/io/models/sidecar_maps/layered_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <algorithm>
#include <functional>

namespace episcope::in_misplaced_views_test {

using namespace episcope::test;

/// Views that do not fit their neighbors, and cameras that stand farther apart in one direction.
class MisplacedViewsTest : public QObject {
  Q_OBJECT

 private:
  static constexpr GridShape kGrid{5, 5};
  using Source = std::function<ViewIndex(ViewIndex)>;

  /// A view of the right order in each place.
  static std::vector<Finding> found_in(const Source& source, double noise = 1) {
    const ViewStack<std::uint8_t> views =
        layered_views({.grid = kGrid, .height = 160, .width = 192, .discs = 12, .noise = noise});
    const LightField::Samples samples =
        rearranged(views, kGrid, [&](int i) { return source(kGrid.view_at(i)); });
    std::vector<Finding> found;
    for (const std::string& sentence : io::find_misplaced_views(samples, Progress(1))) {
      found.push_back(finding_of(sentence).value_or(Finding{sentence, {}}));
    }
    return found;
  }
  static Source exchanged(ViewIndex a, ViewIndex b) {
    return [a, b](ViewIndex view) { return view == a ? b : view == b ? a : view; };
  }
  /// Rows of cameras are `row_step` times as far apart as columns.
  static std::vector<CameraPosition> positions(double row_step, GridShape grid) {
    std::vector<CameraPosition> all;
    for (int i = 0; i < grid.count(); ++i) {
      const ViewIndex view = grid.view_at(i);
      all.push_back({100 - 10.0 * view.u, 10 * row_step * view.v});
    }
    return all;
  }
  static Scene assembled(double row_step, GridShape grid) {
    io::SceneParts parts;
    parts.samples = layered_views({.grid = grid});
    parts.info.positions = positions(row_step, grid);
    Scene scene;
    io::assemble(std::move(parts), {}, scene, Progress(1));
    return scene;
  }

 private slots:
  void rightOrders_raiseNoAlarm_data() {
    QTest::addColumn<bool>("u");
    QTest::addColumn<bool>("v");
    QTest::addColumn<double>("noise");
    QTest::newRow("as it is") << false << false << 0.0;
    QTest::newRow("reversed") << true << false << 1.0;
    QTest::newRow("both reversed, noise") << true << true << 12.0;
  }
  void rightOrders_raiseNoAlarm() {
    QFETCH(bool, u);
    QFETCH(bool, v);
    QFETCH(double, noise);

    const auto found = found_in(
        [&](ViewIndex view) {
          return io::flipped(view, kGrid, {u, v});
        },
        noise);

    QCOMPARE(found.size(), std::size_t{0});
  }

  void exchangedViews_areNamed_data() {
    QTest::addColumn<int>("row");
    QTest::addColumn<int>("column");
    QTest::newRow("side by side") << 1 << 2;
    QTest::newRow("far apart") << 4 << 3;
    QTest::newRow("diagonal") << 2 << 2;
    QTest::newRow("corner") << 4 << 4;
  }
  void exchangedViews_areNamed() {
    QFETCH(int, row);
    QFETCH(int, column);

    const auto found = found_in(exchanged({1, 1}, {row, column}));

    QCOMPARE(found.size(), std::size_t{1});
    QCOMPARE(found.front().code, std::string("views.exchanged"));
    QCOMPARE(found.front().values.at(0), std::string("1,1"));
    QCOMPARE(found.front().values.at(1), view_text({row, column}));
  }

  void snakes_areTold_data() {
    QTest::addColumn<bool>("of_columns");
    QTest::newRow("rows") << false;
    QTest::newRow("columns") << true;
  }
  void snakes_areTold() {
    QFETCH(bool, of_columns);

    const auto found = found_in([&](ViewIndex view) {
      const bool turns_u = !of_columns && view.v % 2 == 1, turns_v = of_columns && view.u % 2 == 1;
      return io::flipped(view, kGrid, {turns_u, turns_v});
    });

    QCOMPARE(found.size(), std::size_t{1});
    QCOMPARE(found.front().code, std::string("views.snake"));
    QCOMPARE(found.front().values.front(), std::string(of_columns ? "column" : "row"));
  }

  void viewsStoredTwice_areNamed() {
    const auto found = found_in([](ViewIndex view) {
      return view == ViewIndex{4, 1} || view == ViewIndex{2, 3} ? ViewIndex{0, 1} : view;
    });

    QVERIFY(!found.empty());
    QCOMPARE(found.front().code, std::string("views.same"));
    QCOMPARE(found.front().values.front(), std::string("0,1 and 2,3 and 4,1"));
  }

  void viewsThatAreAllEqual_areNoFault() {
    const auto found = found_in([](ViewIndex) { return ViewIndex{2, 2}; });

    QCOMPARE(found.size(), std::size_t{0});
  }

  void unequalSteps_areTold_data() {
    QTest::addColumn<double>("row_step");
    QTest::addColumn<int>("rows");
    QTest::addColumn<bool>("is_told");
    QTest::newRow("equal") << 1.0 << 5 << false;
    QTest::newRow("about equal") << 1.03 << 5 << false;
    QTest::newRow("rows farther apart") << 2.0 << 5 << true;
    QTest::newRow("columns farther apart") << 0.4 << 5 << true;
    QTest::newRow("a single row") << 2.0 << 1 << false;
  }
  void unequalSteps_areTold() {
    QFETCH(double, row_step);
    QFETCH(int, rows);
    QFETCH(bool, is_told);

    const Scene scene = assembled(row_step, {rows, 5});

    QVERIFY2(warns_of(scene, "as far apart as columns") == is_told,
             describe(scene.convention).c_str());
    if (is_told) QVERIFY(warns_of(scene, "--crop 1x5 reads a single row"));
  }

  void unequalSteps_areStatedByTheArchive() {
    const QTemporaryDir folder;
    const auto path = std::filesystem::path(folder.path().toStdString()) / "lf.h5";
    const Scene scene = plane_scene();
    const double step = scene.light_field->info().camera.baseline;
    RawArchive form;
    form.more = [&](io::Hdf5Output& file) { file.set_number("/", "dV", 2 * step); };
    write_raw_archive(path, scene, form);

    const Scene whole = io::open_scene(path, {}, Progress(1));
    const Scene row = io::open_scene(path, {.crop = "1x5"}, Progress(1));

    QVERIFY2(warns_of(whole, "2 times as far apart as columns"),
             describe(whole.convention).c_str());
    QVERIFY(!warns_of(row, "as far apart"));
  }

  void poses_tellNearFromFar() {
    io::SceneParts parts;
    parts.samples = ViewStack<std::uint8_t>(kGrid, 40, 40, 1);
    parts.expected = {.reason = "poses", .are_axes_known = true, .is_of_poses = true};
    Scene scene;
    io::assemble(std::move(parts), {}, scene, Progress(1));

    QCOMPARE(scene.convention.sign, std::string("checked"));
    QCOMPARE(scene.convention.sign_check, std::string(finding_text("sign.by_poses")));
    QCOMPARE(scene.convention.order_check, scene.convention.sign_check);
  }
};

}  // namespace episcope::in_misplaced_views_test

EPISCOPE_TEST(misplaced_views_test, MisplacedViewsTest)
#include "misplaced_views_test.moc"
