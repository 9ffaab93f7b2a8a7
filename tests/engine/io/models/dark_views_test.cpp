// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/formats/write_scene.h"
#include "engine/io/models/assemble_scene.h"
#include "engine/io/models/scribble_file.h"
#include "engine/io/open.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <cmath>
#include <functional>

namespace episcope::in_dark_views_test {

using namespace episcope::test;

namespace {

/// Factor of brightness at a pixel of a view.
using Light = std::function<double(ViewIndex, int y, int x)>;

io::SceneParts parts_of(GridShape grid, const Light& light) {
  PlaneOptions plane;
  plane.grid = grid;
  plane.height = 160;
  plane.width = 200;
  plane.slope_x = 0;
  plane.slope_y = 0;
  plane.d0 = 1;
  const Scene scene = plane_scene(plane);
  io::SceneParts parts;
  ViewStack<std::uint8_t> views = bytes_of(scene).clone();
  for (int i = 0; i < grid.count(); ++i) {
    const auto view = views.view(grid.view_at(i));
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width * view.channels; ++x) {
        std::uint8_t& sample = view.row(y)[x];
        sample = static_cast<std::uint8_t>(sample * light(grid.view_at(i), y, x / view.channels));
      }
    }
  }
  parts.samples = std::move(views);
  parts.truth.labels = ViewStack<std::int32_t>(grid, plane.height, plane.width);
  parts.truth.field.disparity = scene.truth->field.disparity.clone();
  for (int i = 0; i < grid.count(); ++i) {
    const auto labels = parts.truth.labels.view(grid.view_at(i));
    std::fill_n(labels.data, labels.size(), i);
    parts.info.positions.push_back({static_cast<double>(i), 0});
  }
  return parts;
}

/// A round pupil: black outside `radius` views from the middle of the grid.
Light pupil(GridShape grid, double radius) {
  return [grid, radius](ViewIndex view, int, int) {
    const double v = view.v - (grid.v - 1) / 2.0;
    const double u = view.u - (grid.u - 1) / 2.0;
    return std::hypot(v, u) > radius ? 0.03 : 1.0;
  };
}

Scene assembled(GridShape grid, const Light& light, const std::string& crop = "") {
  io::OpenOptions options;
  options.crop = crop;
  Scene scene;
  io::assemble(parts_of(grid, light), options, scene, Progress(2));
  return scene;
}

/// What the first view was among those stored.
int first_stored(const Scene& scene) {
  return scene.truth->labels.view({0, 0}).at(0, 0);
}

QString report_of(const Scene& scene) {
  return QString::fromStdString(describe(scene.convention));
}

}  // namespace

class DarkViewsTest : public QObject {
  Q_OBJECT

 private slots:
  void darkCorners_areLeftOut_data() {
    QTest::addColumn<int>("side");
    QTest::addColumn<double>("radius");
    QTest::addColumn<int>("kept");
    QTest::addColumn<int>("first");
    QTest::newRow("odd") << 7 << 3.2 << 5 << 1;
    QTest::newRow("even") << 8 << 4.0 << 6 << 1;
    QTest::newRow("far") << 9 << 3.0 << 5 << 2;
  }
  void darkCorners_areLeftOut() {
    QFETCH(int, side);
    QFETCH(double, radius);
    QFETCH(int, kept);
    QFETCH(int, first);
    const GridShape grid{side, side};

    const Scene scene = assembled(grid, pupil(grid, radius));

    QCOMPARE(scene.light_field->grid(), (GridShape{kept, kept}));
    QCOMPARE(first_stored(scene), first * side + first);
    // The center stays the center.
    const ViewIndex center = grid.center();
    QCOMPARE(scene.truth->labels.view(scene.light_field->center()).at(0, 0),
             center.v * side + center.u);
    QCOMPARE(scene.light_field->info().positions.front().x, first_stored(scene));
    QCOMPARE(scene.light_field->info().positions.size(),
             static_cast<std::size_t>(kept) * static_cast<std::size_t>(kept));
    QCOMPARE(scene.truth->field.disparity.grid(), scene.light_field->grid());
    QVERIFY2(
        report_of(scene).contains("outer views are dark (mean 3 % of the center's); --crop all"),
        qPrintable(report_of(scene)));
    QVERIFY(scene.light_field->valid().empty());
  }

  void cropAll_keepsDarkViewsAsNotValid() {
    const GridShape grid{7, 7};

    const Scene scene = assembled(grid, pupil(grid, 3.2), "all");

    QCOMPARE(scene.light_field->grid(), grid);
    QVERIFY(!scene.light_field->is_valid({0, 0}, 80, 100));
    QVERIFY(scene.light_field->is_valid({3, 3}, 80, 100));
    QVERIFY(scene.light_field->is_valid({0, 3}, 80, 100));
    QCOMPARE(std::get<std::string>(*scene.light_field->info().reading.find("crop")),
             std::string("all"));
  }

  void chosenCrop_isTaken() {
    const Light bright = [](ViewIndex, int, int) { return 1.0; };

    const Scene scene = assembled({6, 7}, bright, "3x4");

    QCOMPARE(scene.light_field->grid(), (GridShape{3, 4}));
    QCOMPARE(first_stored(scene), 2 * 7 + 1);
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)assembled({3, 3}, bright, "4x3"));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)assembled({3, 3}, bright, "some"));
  }

  void sceneOfItsOwn_staysWhole_data() {
    QTest::addColumn<Light>("light");
    const auto row = [](const char* name, Light light) { QTest::newRow(name) << light; };
    row("bright", [](ViewIndex, int, int) { return 1.0; });
    row("dark everywhere", [](ViewIndex, int, int) { return 0.01; });
    row("black", [](ViewIndex, int, int) { return 0.0; });
    row("lit from one side", [](ViewIndex, int, int x) { return x / 200.0; });
    row("gains that differ", [](ViewIndex view, int, int) { return 1 - 0.06 * view.u; });
    row("black background, moving by 12 px a view", [](ViewIndex view, int y, int x) {
      const double from_middle = std::hypot(y - 80, x - 100 + 12 * (view.u - 2));
      return from_middle < 30 ? 1.0 : 0.0;
    });
    row("black object, moving by 6 px a view", [](ViewIndex view, int y, int x) {
      const double from_middle = std::hypot(y - 80, x - 100 + 6 * (view.u - 2));
      return from_middle < 14 ? 0.0 : 1.0;
    });
    row("disc that fills the height",
        [](ViewIndex, int y, int x) { return std::hypot(y - 80, x - 100) < 85 ? 1.0 : 0.0; });
  }
  void sceneOfItsOwn_staysWhole() {
    QFETCH(Light, light);

    const Scene scene = assembled({5, 5}, light);

    QCOMPARE(scene.light_field->grid(), (GridShape{5, 5}));
    QVERIFY2(scene.light_field->valid().empty(), qPrintable(report_of(scene)));
  }

  void failedCamera_isMarkedAndNotCutAround_data() {
    QTest::addColumn<int>("side");
    QTest::addColumn<QString>("marked");
    QTest::newRow("few views") << 5 << "4.0 % of all pixels, in 1 of 25 views";
    QTest::newRow("many views") << 10 << "1.0 % of all pixels, in 1 of 100 views";
  }
  void failedCamera_isMarkedAndNotCutAround() {
    QFETCH(int, side);
    QFETCH(QString, marked);

    const Scene scene = assembled({side, side}, [](ViewIndex view, int, int) {
      return view == ViewIndex{1, 2} ? 0.0 : 1.0;
    });

    QCOMPARE(scene.light_field->grid(), (GridShape{side, side}));
    QVERIFY(!scene.light_field->is_valid({1, 2}, 10, 10));
    QVERIFY(scene.light_field->is_valid({1, 1}, 10, 10));
    QVERIFY2(report_of(scene).contains(marked), qPrintable(report_of(scene)));
  }

  void vignettedPart_isMarked_data() {
    QTest::addColumn<int>("side");
    QTest::newRow("few views") << 3;
    QTest::newRow("many views") << 10;
  }
  void vignettedPart_isMarked() {
    QFETCH(int, side);

    // The first view sees nothing in its left tenth.
    const Scene scene = assembled({side, side}, [](ViewIndex view, int, int x) {
      return view == ViewIndex{} && x < 40 ? 0.02 : 1.0;
    });

    QVERIFY(!scene.light_field->is_valid({0, 0}, 80, 5));
    QVERIFY(!scene.light_field->is_valid({0, 0}, 80, 34));
    QVERIFY(scene.light_field->is_valid({0, 0}, 80, 46));
    QVERIFY(scene.light_field->is_valid({0, 1}, 80, 5));
  }

  void cornersCutOffByALens_areMarked() {
    const auto in_corner = [](int y, int x) {
      return std::min(y, 159 - y) + std::min(x, 199 - x) < 25;
    };
    const Scene scene =
        assembled({3, 3}, [&](ViewIndex, int y, int x) { return in_corner(y, x) ? 0.0 : 1.0; });

    QVERIFY2(report_of(scene).contains("as a lens cuts them off"), qPrintable(report_of(scene)));
    for (int y = 0; y < 160; ++y) {
      for (int x = 0; x < 200; ++x) {
        QCOMPARE(scene.light_field->is_valid({0, 2}, y, x), !in_corner(y, x));
      }
    }
  }

  void noiseInDarkCorners_isInvalid() {
    const auto is_noise = [](ViewIndex view, int y, int x) {
      return view == ViewIndex{0, 0} && (y == 3 || y == 4) && x == 5;
    };
    const auto is_outline = [](ViewIndex view, int y, int x) {
      return view == ViewIndex{0, 0} && y == 0 && x >= 20 && x < 25;
    };
    const Scene scene = assembled({3, 3}, [&](ViewIndex view, int y, int x) {
      const bool is_dark = std::min(y, 159 - y) + std::min(x, 199 - x) < 25;
      return is_dark && !is_noise(view, y, x) && !is_outline(view, y, x) ? 0.0 : 1.0;
    });

    QVERIFY(!scene.light_field->is_valid({0, 0}, 3, 5));
    QVERIFY(!scene.light_field->is_valid({0, 0}, 4, 5));
    QVERIFY(scene.light_field->is_valid({0, 0}, 0, 21));  // of the picture beside the corner
  }

  void reversedAxis_takesTheMaskAlong() {
    io::SceneParts parts = parts_of({3, 3}, [](ViewIndex, int, int) { return 1.0; });
    parts.valid = ViewStack<std::uint8_t>({3, 3}, 160, 200);
    std::fill_n(parts.valid.data(), parts.valid.size(), std::uint8_t{1});
    parts.valid.view({0, 0}).at(7, 9) = 0;
    io::OpenOptions options;
    options.flip = io::Flip::U;
    Scene scene;

    io::assemble(std::move(parts), options, scene, Progress(1));

    QVERIFY(!scene.light_field->is_valid({0, 2}, 7, 9));
    QVERIFY(scene.light_field->is_valid({0, 0}, 7, 9));
  }

  void scribblesOfACroppedScene_keepTheirPlaces() {
    const QTemporaryDir folder;
    const std::filesystem::path file = std::filesystem::path(folder.path().toStdString()) / "lf.h5";
    Scene scene = plane_scene();  // 5×5, painted in the center
    const Image<std::int32_t> painted = scene.scribbles.views.front().labels;
    scene.scribbles.views.insert(scene.scribbles.views.begin(), {ViewIndex{0, 0}, painted});
    io::write_archive(file, scene, Progress(1));
    io::OpenOptions options;
    options.crop = "3x3";

    const Scene read = io::open_scene(file, options, Progress(1));
    QCOMPARE(read.scribbles.views.size(), std::size_t{1});
    QCOMPARE(read.scribbles.views.front().view, (ViewIndex{1, 1}));
    QCOMPARE(read.truth->labels.grid(), (GridShape{3, 3}));

    Scribbles changed;
    changed.views.push_back({ViewIndex{0, 1}, painted});
    io::write_scribbles(file.parent_path() / "labels.h5", changed, read, Progress(1));
    const Scene whole = io::open_scene(file, {}, Progress(1));
    QCOMPARE(whole.scribbles.views.size(), std::size_t{2});
    QCOMPARE(whole.scribbles.views[0].view, (ViewIndex{0, 0}));  // not touched
    QCOMPARE(whole.scribbles.views[1].view, (ViewIndex{1, 2}));
  }
};

}  // namespace episcope::in_dark_views_test

EPISCOPE_TEST(dark_views_test, DarkViewsTest)
#include "dark_views_test.moc"
