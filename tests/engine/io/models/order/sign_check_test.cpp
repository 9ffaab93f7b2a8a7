// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/assemble_scene.h"
#include "engine/io/models/order/line_matches.h"
#include "engine/io/models/order/order_check.h"
#include "tests/engine/io/models/order/layered_scene.h"
#include "tests/engine/io/models/sidecar_maps/layered_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>

namespace episcope::in_sign_check_test {

using namespace episcope::test;
using io::Flip;
using io::ViewFlip;

/// Whether near and far, and rows and columns of views, are told apart from the views alone.
class SignCheckTest : public QObject {
  Q_OBJECT

 private:
  static LayeredOptions options_of(GridShape grid) {
    return {.grid = grid, .height = 160, .width = 192, .discs = 12};
  }
  static Scene assembled(ViewStack<std::uint8_t> views, Flip flip = Flip::Auto,
                         std::vector<CameraPosition> positions = {}, bool are_axes_known = false) {
    io::SceneParts parts;
    parts.samples = std::move(views);
    parts.info.positions = std::move(positions);
    parts.expected = {{}, "the test says so", are_axes_known};
    Scene scene;
    io::assemble(std::move(parts), {.flip = flip}, scene, Progress(2));
    return scene;
  }
  static ViewStack<std::uint8_t> swapped(const ViewStack<std::uint8_t>& views) {
    const GridShape grid{views.grid().u, views.grid().v};
    return rearranged(views, grid, [&](int i) {
      const ViewIndex view = grid.view_at(i);
      return ViewIndex{view.u, view.v};
    });
  }
  static bool has_views(const Scene& scene, const ViewStack<std::uint8_t>& views) {
    const ViewStack<std::uint8_t>& read = bytes_of(scene);
    return read.grid() == views.grid() && std::equal(read.data(), read.data() + read.size(),
                                                     views.data(), views.data() + views.size());
  }
  static std::string told(const Scene& scene) {
    return describe(scene.convention) + " | " + scene.convention.sign_check;
  }

 private slots:
  void everyOrder_isFoundByOcclusion_data() {
    QTest::addColumn<int>("rows");
    QTest::addColumn<int>("columns");
    QTest::addColumn<bool>("u");
    QTest::addColumn<bool>("v");
    QTest::addColumn<double>("noise");
    for (const double noise : {0.0, 3.0}) {
      for (const GridShape grid : {GridShape{5, 5}, {1, 9}, {9, 1}, {3, 7}}) {
        for (const bool u : {false, true}) {
          for (const bool v : {false, true}) {
            if ((u && grid.u == 1) || (v && grid.v == 1)) continue;
            QTest::addRow("%dx%d, %s, noise %.0f", grid.v, grid.u, io::flip_text({u, v}).c_str(),
                          noise)
                << grid.v << grid.u << u << v << noise;
          }
        }
      }
    }
  }
  void everyOrder_isFoundByOcclusion() {
    QFETCH(int, rows);
    QFETCH(int, columns);
    QFETCH(bool, u);
    QFETCH(bool, v);
    QFETCH(double, noise);
    LayeredOptions options = options_of({rows, columns});
    options.noise = noise;
    const ViewStack<std::uint8_t> views = layered_views(options);
    ViewStack<std::uint8_t> stored = views.clone();
    io::reverse_views(stored, options.grid, {u, v});

    const Scene scene = assembled(std::move(stored));

    QVERIFY2(has_views(scene, views), told(scene).c_str());
    QCOMPARE(scene.convention.reversed_u, u);
    QCOMPARE(scene.convention.reversed_v, v);
    QCOMPARE(scene.convention.sign, std::string("checked"));
    QVERIFY2(scene.convention.sign_check.find("by occlusion") != std::string::npos,
             told(scene).c_str());
  }

  void wideMotion_isFollowed_data() {
    QTest::addColumn<double>("background");
    QTest::addColumn<double>("foreground");
    QTest::addColumn<bool>("reversed");
    for (const bool reversed : {false, true}) {
      QTest::addRow("both ways, %d", reversed) << -20.0 << 12.0 << reversed;
      QTest::addRow("one way, %d", reversed) << 14.0 << 26.0 << reversed;
    }
  }
  /// Of a few cameras far apart.
  void wideMotion_isFollowed() {
    QFETCH(double, background);
    QFETCH(double, foreground);
    QFETCH(bool, reversed);
    LayeredOptions options = options_of({3, 5});
    options.height = 256;
    options.width = 320;
    options.background_px = background;
    options.foreground_px = foreground;
    ViewStack<std::uint8_t> views = layered_views(options);
    ViewStack<std::uint8_t> stored = views.clone();
    io::reverse_views(stored, options.grid, {reversed, false});

    const Scene scene = assembled(std::move(stored));

    QVERIFY2(has_views(scene, views), told(scene).c_str());
    QCOMPARE(scene.convention.sign, std::string("checked"));
  }

  void vignettedViews_doNotMislead_data() {
    QTest::addColumn<bool>("reversed");
    QTest::newRow("as stored") << false;
    QTest::newRow("reversed") << true;
  }
  /// Of an even grid the view at the center is not in the middle: views of one side are darker.
  void vignettedViews_doNotMislead() {
    QFETCH(bool, reversed);
    const GridShape grid{8, 8};
    ViewStack<std::uint8_t> stored = layered_views(options_of(grid));
    for (int i = 0; i < grid.count(); ++i) {
      const ViewIndex at = grid.view_at(i);
      const double radius = std::hypot(at.v - 3.5, at.u - 3.5);
      const double gain = std::clamp((5.5 - radius) / 2.5, 0.0, 1.0);
      const auto view = stored.view(at);
      for (std::size_t k = 0; k < view.size(); ++k) {
        view.data[k] = static_cast<std::uint8_t>(gain * view.data[k]);
      }
    }
    io::reverse_views(stored, grid, {reversed, reversed});

    const Scene scene = assembled(std::move(stored));

    QVERIFY2(scene.convention.reversed_u == reversed && scene.convention.reversed_v == reversed,
             told(scene).c_str());
    QCOMPARE(scene.convention.sign, std::string("checked"));
  }

  /// Cameras give 10 or 12 bits, which arrive in 16.
  void fewBitsOfSixteen_areSeenLikeAll() {
    const ViewStack<std::uint8_t> views = layered_views(options_of({5, 5}));
    ViewStack<std::uint16_t> stored(views.grid(), views.height(), views.width(), views.channels());
    std::transform(views.data(), views.data() + views.size(), stored.data(),
                   [](std::uint8_t value) { return static_cast<std::uint16_t>(4 * value); });
    LightField::Samples samples = std::move(stored);

    const io::SignFinding finding = io::check_sign(samples, {}, true, Progress(1));

    QVERIFY2(finding.is_decided, finding.evidence.c_str());
    QVERIFY(finding.flip == io::ViewFlip{});
  }

  void viewsWithoutDepthEdges_haveAnUnknownSign_data() {
    QTest::addColumn<double>("foreground");
    QTest::addColumn<double>("noise");
    QTest::newRow("one plane") << -0.6 << 0.0;
    QTest::newRow("one plane with noise") << -0.6 << 12.0;
    QTest::newRow("hardly any depth") << -0.55 << 3.0;
  }
  void viewsWithoutDepthEdges_haveAnUnknownSign() {
    QFETCH(double, foreground);
    QFETCH(double, noise);
    LayeredOptions options = options_of({5, 5});
    options.foreground_px = foreground;
    options.noise = noise;

    for (unsigned seed = 1; seed <= 4; ++seed) {
      options.seed = seed;
      const Scene scene = assembled(layered_views(options));

      QVERIFY2(scene.convention.sign.empty(), told(scene).c_str());
      QVERIFY2(scene.convention.sign_check.find("no depth edges") != std::string::npos,
               told(scene).c_str());
    }
  }

  void slopesThatCorrelateByChance_decideNothing_data() {
    QTest::addColumn<double>("correlation");
    QTest::addColumn<int>("squares");
    QTest::addColumn<bool>("is_decided");
    QTest::newRow("by chance") << 0.3 << 80 << false;
    QTest::newRow("more than that") << 0.5 << 80 << true;
    QTest::newRow("of as many points in fewer places") << 0.5 << 20 << false;
  }
  void slopesThatCorrelateByChance_decideNothing() {
    QFETCH(double, correlation);
    QFETCH(int, squares);
    QFETCH(bool, is_decided);

    QCOMPARE((io::SlopeCorrelation{correlation, 200, squares}.is_decided()), is_decided);
    QCOMPARE((io::SlopeCorrelation{-correlation, 200, squares}.is_decided()), is_decided);
  }

  void singleRow_isNotCalledFlat() {
    LayeredOptions options = options_of({1, 9});
    options.foreground_px = options.background_px;

    const Scene scene = assembled(layered_views(options));

    QVERIFY2(scene.convention.order_check.find("one row of views") != std::string::npos,
             told(scene).c_str());
  }

  void orderChosenByHand_winsOverOcclusion() {
    const Scene scene = assembled(layered_views(options_of({5, 5})), Flip::Both);

    QVERIFY(scene.convention.reversed_u && scene.convention.reversed_v);
    QVERIFY2(scene.convention.sign.empty(), told(scene).c_str());
    QVERIFY2(told(scene).find("check favors") != std::string::npos, told(scene).c_str());
  }

  void swappedAxes_areSwappedBack_data() {
    QTest::addColumn<int>("rows");
    QTest::addColumn<int>("columns");
    QTest::newRow("5x5") << 5 << 5;
    QTest::newRow("3x5") << 3 << 5;
    QTest::newRow("9x1") << 9 << 1;
  }
  void swappedAxes_areSwappedBack() {
    QFETCH(int, rows);
    QFETCH(int, columns);
    const ViewStack<std::uint8_t> views = layered_views(options_of({rows, columns}));

    const Scene scene = assembled(swapped(views));

    QVERIFY2(has_views(scene, views), told(scene).c_str());
    QVERIFY2(scene.convention.order.starts_with("rows and columns swapped"), told(scene).c_str());
    QVERIFY2(scene.convention.order_check.find("motion along x") != std::string::npos,
             told(scene).c_str());
  }

  void swappedAxesOfSmallViews_areSwappedBack_data() {
    QTest::addColumn<int>("side");
    QTest::addColumn<int>("height");
    QTest::addColumn<double>("disparity");
    QTest::newRow("few views") << 3 << 60 << 0.9;
    QTest::newRow("few pixels") << 5 << 48 << 0.9;
    QTest::newRow("many views and little motion") << 13 << 48 << 0.4;
  }
  /// A pair of views has few blocks to match.
  void swappedAxesOfSmallViews_areSwappedBack() {
    QFETCH(int, side);
    QFETCH(int, height);
    QFETCH(double, disparity);
    const LayeredOptions options{.grid = {side, side},
                                 .height = height,
                                 .width = 4 * height / 3,
                                 .background_px = -0.7 * disparity,
                                 .foreground_px = disparity,
                                 .discs = 6,
                                 .noise = 3,
                                 .seed = 2};
    const ViewStack<std::uint8_t> views = layered_views(options);

    const Scene scene = assembled(swapped(views));

    QVERIFY2(has_views(scene, views), told(scene).c_str());
    QVERIFY(!scene.convention.are_axes_unclear);
  }

  void swappedAxesOfTinyViews_areFoundByTruth() {
    const LayeredScene stored({3, 3}, 36, 40);
    io::SceneParts parts;
    parts.samples = swapped(stored.views);
    parts.truth.field.disparity = stored.disparity.clone();
    parts.truth.labels = stored.labels.clone();
    io::swap_view_axes(parts.truth);
    parts.expected.reason = "the test says so";
    Scene scene;

    io::assemble(std::move(parts), {}, scene, Progress(2));

    QVERIFY2(has_views(scene, stored.views), told(scene).c_str());
    QVERIFY2(scene.convention.order_check.starts_with("by the ground truth"), told(scene).c_str());
    const ViewStack<std::int32_t>& labels = scene.truth->labels;
    QVERIFY(std::equal(labels.data(), labels.data() + labels.size(), stored.labels.data()));
    QVERIFY(!scene.convention.are_axes_unclear);
  }

  /// Such views are the same with rows and columns exchanged, whatever their slopes say.
  void diagonalStripes_doNotTellRowsFromColumns() {
    const GridShape grid{5, 5};
    ViewStack<std::uint8_t> stripes(grid, 96, 128);
    for (int i = 0; i < grid.count(); ++i) {
      const ViewIndex at = grid.view_at(i);
      const auto view = stripes.view(at);
      for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) {
          const double along = x + y;
          const double moved = along + std::sin(along / 20) * (at.u + at.v - 4);
          const double wave = std::sin(moved / 1.7) + std::sin(moved / 2.9);
          view.at(y, x) = static_cast<std::uint8_t>(127 + 50 * wave);
        }
      }
    }

    const Scene scene = assembled(std::move(stripes));

    QVERIFY2(scene.convention.are_axes_unclear, told(scene).c_str());
    QVERIFY2(scene.convention.order_check.starts_with("not checked"), told(scene).c_str());
  }

  void reversedViews_areJudgedAlike() {
    for (unsigned seed = 1; seed <= 8; ++seed) {
      LayeredOptions options{.height = 72, .discs = 6, .noise = 6, .seed = seed};
      options.width = 96;
      const ViewStack<std::uint8_t> views = layered_views(options);
      ViewStack<std::uint8_t> stored = views.clone();
      io::reverse_views(stored, options.grid, {true, true});
      const LightField::Samples plain = views.clone(), reversed = std::move(stored);

      const io::SignFinding one = io::check_sign(plain, {}, true, Progress(1));
      const io::SignFinding other = io::check_sign(reversed, {}, true, Progress(1));

      QCOMPARE(one.is_decided, other.is_decided);
      if (one.is_decided) QCOMPARE(one.evidence, other.evidence);
    }
  }

  void swappedAxesOfAKnownForm_areReportedOnly() {
    const ViewStack<std::uint8_t> stored = swapped(layered_views(options_of({5, 5})));

    const Scene scene = assembled(stored.clone(), Flip::None, {}, true);

    QVERIFY2(has_views(scene, stored), told(scene).c_str());
    QVERIFY2(told(scene).find("seem to be swapped") != std::string::npos, told(scene).c_str());
  }

  void positions_followTheirViews() {
    const GridShape grid{5, 5};
    ViewStack<std::uint8_t> stored = layered_views(options_of(grid));
    io::reverse_views(stored, grid, {true, true});
    std::vector<CameraPosition> positions;
    for (int i = 0; i < grid.count(); ++i) {
      positions.push_back({10.0 * grid.view_at(i).u, 7.0 * grid.view_at(i).v});
    }

    const Scene scene = assembled(std::move(stored), Flip::Auto, positions);

    const std::vector<CameraPosition>& moved = scene.light_field->info().positions;
    QCOMPARE(moved.front().x, 40.0);
    QCOMPARE(moved.front().y, 28.0);
    QVERIFY2(scene.convention.sign_check.ends_with(
                 "by the positions, camera right = smaller X, camera down = smaller Y"),
             told(scene).c_str());
  }
};

}  // namespace episcope::in_sign_check_test

EPISCOPE_TEST(sign_check_test, SignCheckTest)
#include "sign_check_test.moc"
