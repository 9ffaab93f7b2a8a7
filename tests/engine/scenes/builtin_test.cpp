// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/builtin.h"

#include "engine/core/error.h"
#include "tests/test_main.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>
#include <stop_token>

namespace episcope::in_builtin_test {

namespace {

constexpr int kSize = 96;

scenes::RenderOptions small_options(GridShape grid = {3, 3}) {
  scenes::RenderOptions options;
  options.grid = grid;
  options.height = kSize;
  options.width = kSize;
  return options;
}

Scene render(const std::string& id, const scenes::RenderOptions& options = small_options()) {
  return scenes::render_builtin(id, options, Progress());
}

QString error_of(const std::string& id, const scenes::RenderOptions& options) {
  try {
    render(id, options);
  } catch (const Error& error) {
    return QString::fromUtf8(error.what());
  }
  return {};
}

void add_every_scene() {
  QTest::addColumn<QString>("id");
  for (const auto& scene : scenes::builtin_scenes()) {
    QTest::newRow(scene.id.c_str()) << QString::fromStdString(scene.id);
  }
}

// Mean power at wavelengths below `limit_px` as a share of all but the mean, over all rows.
double fine_energy_share(const Image<float>& view, double limit_px) {
  const int n = view.width();
  const double turn = 2 * std::acos(-1.0) / n;
  double fine = 0;
  double all = 0;
  for (int y = 0; y < view.height(); ++y) {
    for (int k = 1; k <= n / 2; ++k) {
      double re = 0;
      double im = 0;
      for (int x = 0; x < n; ++x) {
        const double window = 0.5 - 0.5 * std::cos(turn * x);
        re += window * view.at(y, x) * std::cos(turn * k * x);
        im += window * view.at(y, x) * std::sin(turn * k * x);
      }
      // The window spreads the mean over the first two frequencies.
      if (k < 2) continue;
      all += re * re + im * im;
      if (static_cast<double>(n) / k < limit_px) fine += re * re + im * im;
    }
  }
  return fine / all;
}

}  // namespace

class BuiltinTest : public QObject {
  Q_OBJECT

 private slots:
  void builtinScenes_listsTheDemoFirstAndEverySceneOnce() {
    std::vector<std::string> ids;
    for (const auto& scene : scenes::builtin_scenes()) {
      ids.push_back(scene.id);
      QVERIFY(!scene.summary.empty());
    }

    QCOMPARE(ids.front(), std::string("demo"));
    QCOMPARE(
        std::set<std::string>(ids.begin(), ids.end()),
        (std::set<std::string>{"demo", "fronto", "slant", "edge", "bars", "objects", "transparent",
                               "backgammon", "dots", "stripes", "pyramids", "random"}));
    QCOMPARE(ids.size(), std::size_t{12});
  }

  void renderBuiltin_namesTheScene_data() { add_every_scene(); }
  void renderBuiltin_namesTheScene() {
    QFETCH(QString, id);

    const Scene scene = render(id.toStdString(), small_options({1, 1}));

    const LightFieldInfo& info = scene.light_field->info();
    const bool is_drawn = scenes::is_drawn(id.toStdString());
    QCOMPARE(QString::fromStdString(info.name), is_drawn ? id + "_1" : id);
    const QString text = is_drawn ? id + "?seed=1" : id;
    QCOMPARE(QString::fromStdString(info.source), id == "demo" ? id : "demo:" + text);
    QVERIFY(info.camera.is_known());
    QVERIFY(!info.disparity_range);
  }

  void renderBuiltin_honoursShape() {
    scenes::RenderOptions options = small_options({2, 5});
    options.height = 40;
    options.width = 57;
    options.channels = 1;

    const Scene scene = render("demo", options);

    QCOMPARE(scene.light_field->grid(), (GridShape{2, 5}));
    QCOMPARE(scene.light_field->height(), 40);
    QCOMPARE(scene.light_field->width(), 57);
    QCOMPARE(scene.light_field->channels(), 1);
    QVERIFY(scene.light_field->sample_type() == SampleType::UInt8);
    QCOMPARE(scene.truth->field.disparity.grid(), (GridShape{2, 5}));
    QCOMPARE(scene.truth->labels.height(), 40);
    QCOMPARE(scene.scribbles.views.at(0).labels.width(), 57);
  }

  void renderBuiltin_fillsEveryPixelWithTruth_data() { add_every_scene(); }
  void renderBuiltin_fillsEveryPixelWithTruth() {
    QFETCH(QString, id);

    const Scene scene = render(id.toStdString());

    const GroundTruth& truth = *scene.truth;
    for (int view = 0; view < 9; ++view) {
      const ViewIndex index{view / 3, view % 3};
      for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
          const bool has_pane = truth.has_layers() && truth.foreground.view(index).is_valid(y, x);
          QCOMPARE(truth.field.view(index).is_valid(y, x), !has_pane);
          QVERIFY(truth.labels.view(index).at(y, x) >= 1);
        }
      }
    }
  }

  void camera_agreesWithTruth() {
    const Scene scene = render("fronto");
    const CameraGrid& camera = scene.light_field->info().camera;

    const double depth = camera.depth_from_disparity(0.37);

    QVERIFY(std::abs(camera.disparity_from_depth(*camera.cam_distance)) < 1e-12);
    QVERIFY(depth < *camera.cam_distance);
    QVERIFY(std::abs(camera.disparity_from_depth(depth) - 0.37) < 1e-12);
  }

  void fronto_hasOneDisparity() {
    const Scene scene = render("fronto");

    const auto& disparity = scene.truth->field.disparity;
    const auto [min, max] =
        std::minmax_element(disparity.data(), disparity.data() + disparity.size());
    QVERIFY(std::abs(*min - 0.37F) < 1e-6F);
    QVERIFY(std::abs(*max - 0.37F) < 1e-6F);
  }

  void slant_isAffineInThePixel() {
    const Scene scene = render("slant");

    const auto center = scene.truth->field.disparity.view({1, 1});
    for (int y = 0; y < kSize; y += 5) {
      for (int x = 0; x < kSize; ++x) {
        // Float has 6e-8 below 1.
        QVERIFY(std::abs(center.at(y, x) - (2.0 * x / (kSize - 1) - 1)) < 1e-6);
      }
    }
  }

  void edge_liesBetweenTwoPixels() {
    const Scene scene = render("edge");

    const auto center = scene.truth->field.disparity.view({1, 1});
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        QVERIFY(std::abs(center.at(y, x) - (x < kSize / 2 ? -0.5F : 0.8F)) < 1e-6F);
      }
    }
    // The near plane moves by 0.8 px per view, and the far one shows or hides behind it: from view
    // 0 its left side stands 0.8 px further right.
    QVERIFY(std::abs(scene.truth->field.disparity.view({1, 0}).at(9, kSize / 2) + 0.5F) < 1e-6F);
    QVERIFY(std::abs(scene.truth->field.disparity.view({1, 2}).at(9, kSize / 2 - 1) - 0.8F) <
            1e-6F);
  }

  void bars_haveTheirWidths() {
    const Scene scene = render("bars");

    const auto labels = scene.truth->labels.view({1, 1});
    std::vector<int> widths;
    for (int x = 0, run = 0; x < kSize; ++x) {
      if (labels.at(kSize / 4, x) == 2) ++run;
      if (run > 0 && labels.at(kSize / 4, x) != 2) {
        widths.push_back(run);
        run = 0;
      }
    }
    QCOMPARE(widths, (std::vector<int>{1, 2, 3, 5, 1, 2, 3, 5}));
  }

  void transparent_hasTwoTruthsUnderThePane() {
    const Scene scene = render("transparent");

    const GroundTruth& truth = *scene.truth;
    const ViewIndex center{1, 1};
    QVERIFY(truth.has_layers());
    const int middle = kSize / 2;
    QVERIFY(std::abs(truth.foreground.view(center).disparity.at(middle, middle) - 0.5F) < 1e-6F);
    QVERIFY(std::abs(truth.background.view(center).disparity.at(middle, middle) + 0.5F) < 1e-6F);
    QVERIFY(!truth.field.view(center).is_valid(middle, middle));
    QVERIFY(!truth.foreground.view(center).is_valid(2, 2));
    QVERIFY(!truth.background.view(center).is_valid(2, 2));
    QVERIFY(std::abs(truth.field.view(center).disparity.at(2, 2) + 0.5F) < 1e-6F);
  }

  void demo_staysNearTheZeroPlane() {
    const Scene scene = render("demo");

    const auto center = scene.truth->field.disparity.view({1, 1});
    const auto [min, max] = std::minmax_element(center.data, center.data + center.size());
    QVERIFY(*min < -1 && *min > -1.6F);
    QVERIFY(*max > 1 && *max < 1.6F);
  }

  void disparityScale_multipliesTruth() {
    scenes::RenderOptions options = small_options();
    const Scene plain = render("demo", options);
    options.disparity_scale = 2.5;

    const Scene scaled = render("demo", options);

    const auto a = plain.truth->field.disparity.view({1, 1});
    const auto b = scaled.truth->field.disparity.view({1, 1});
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        QVERIFY(std::abs(2.5F * a.at(y, x) - b.at(y, x)) < 2e-6F);
      }
    }
    // The center view does not move.
    QVERIFY(std::equal(plain.light_field->view<std::uint8_t>({1, 1}).data,
                       plain.light_field->view<std::uint8_t>({1, 1}).data + 3 * kSize * kSize,
                       scaled.light_field->view<std::uint8_t>({1, 1}).data));
  }

  void noise_hasItsSigmaAndItsSeed() {
    scenes::RenderOptions options = small_options();
    const Scene clean = render("fronto", options);
    options.noise_sigma = 5;
    const Scene noisy = render("fronto", options);
    options.seed = 2;
    const Scene other = render("fronto", options);

    double sum = 0;
    double squares = 0;
    const std::size_t count = clean.light_field->byte_size();
    const auto* a = clean.light_field->view<std::uint8_t>({0, 0}).data;
    const auto* b = noisy.light_field->view<std::uint8_t>({0, 0}).data;
    for (std::size_t i = 0; i < count; ++i) {
      const double difference = b[i] - a[i];
      sum += difference;
      squares += difference * difference;
    }
    // 5 grey levels and what rounding adds, sqrt(25 + 1/6); 250 000 samples give ±0.01.
    QVERIFY(std::abs(sum / count) < 0.05);
    QVERIFY(std::abs(std::sqrt(squares / count) - 5.02) < 0.05);
    QVERIFY(noisy.light_field->sample_hash() != other.light_field->sample_hash());
  }

  void textures_areBandLimited_data() {
    QTest::addColumn<QString>("id");
    QTest::addColumn<int>("size");
    QTest::newRow("fronto") << "fronto" << 96;
    QTest::newRow("fronto, small") << "fronto" << 48;
    QTest::newRow("slant") << "slant" << 128;
  }
  void textures_areBandLimited() {
    QFETCH(QString, id);
    QFETCH(int, size);
    scenes::RenderOptions options = small_options({1, 1});
    options.height = options.width = size;
    options.channels = 1;

    const Scene scene = render(id.toStdString(), options);

    const double share = fine_energy_share(scene.light_field->view_as_float({0, 0}), 4);
    // C2 interpolation and rounding to 8 bits leave a little; white noise would have half.
    QVERIFY2(share < 0.01, qPrintable(QString::number(share)));
  }

  void regions_separateEdgesPlanesAndCurves() {
    const Scene scene = render("demo");

    const auto& regions = scene.truth->regions;
    QVERIFY(regions.contains("discontinuities") && regions.contains("planes") &&
            regions.contains("smooth_surfaces"));
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        int inside = 0;
        for (const auto& [name, mask] : regions) inside += mask.at(y, x) != 0;
        QCOMPARE(inside, 1);
      }
    }
  }

  void scribbles_touchEveryLabelAndAgreeWithTruth_data() {
    QTest::addColumn<QString>("id");
    QTest::addColumn<int>("labels");
    QTest::newRow("objects") << "objects" << 3;
    QTest::newRow("demo") << "demo" << 11;
  }
  void scribbles_touchEveryLabelAndAgreeWithTruth() {
    QFETCH(QString, id);
    QFETCH(int, labels);

    const Scene scene = render(id.toStdString());

    std::set<int> painted;
    const auto truth = scene.truth->labels.view(scene.scribbles.views.at(0).view);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const int label = scene.scribbles.views.at(0).labels.at(y, x);
        if (label == 0) continue;
        painted.insert(label);
        QCOMPARE(label, truth.at(y, x));
      }
    }
    QCOMPARE(scene.scribbles.views.at(0).view, (ViewIndex{1, 1}));
    QCOMPARE(static_cast<int>(painted.size()), labels);
  }

  void renderBuiltin_namesTheNearestScene() {
    const QString message = error_of("frontoo", small_options());

    QVERIFY2(message.contains("did you mean 'fronto'"), qPrintable(message));
  }

  void renderBuiltin_refusesBadOptions_data() {
    QTest::addColumn<scenes::RenderOptions>("options");
    QTest::addColumn<QString>("word");
    const auto add = [](const char* word, auto change) {
      scenes::RenderOptions options = small_options();
      change(options);
      QTest::newRow(word) << options << QString(word);
    };
    add("views in u", [](auto& o) { o.grid.u = 0; });
    add("height", [](auto& o) { o.height = 0; });
    add("width", [](auto& o) { o.width = 100000; });
    add("noise", [](auto& o) { o.noise_sigma = -1; });
    add("disparity scale", [](auto& o) { o.disparity_scale = std::nan(""); });
    add("channels", [](auto& o) { o.channels = 2; });
  }
  void renderBuiltin_refusesBadOptions() {
    QFETCH(scenes::RenderOptions, options);
    QFETCH(QString, word);

    QVERIFY_THROWS_EXCEPTION(InvalidInput, render("fronto", options));
    QVERIFY(error_of("fronto", options).contains(word));
  }

  void renderBuiltin_stops() {
    std::stop_source stop;
    std::atomic<int> reports{0};
    const Progress progress(stop.get_token(), [&](const ProgressState& state) {
      if (state.fraction > 0 && ++reports == 3) stop.request_stop();
    });

    QVERIFY_THROWS_EXCEPTION(Cancelled,
                             (void)scenes::render_builtin("demo", small_options({9, 9}), progress));

    // One report per thread may be in progress when the stop comes.
    QVERIFY(reports < 3 + progress.threads() + 1);
  }
};

}  // namespace episcope::in_builtin_test

EPISCOPE_TEST(builtin_test, BuiltinTest)
#include "builtin_test.moc"
