// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/metrics.h"
#include "engine/scenes/builtin.h"
#include "tests/test_main.h"

#include <algorithm>
#include <functional>
#include <set>

namespace episcope::in_stratified_scene_test {

namespace {

constexpr int kSize = 192;
constexpr ViewIndex kCenter{0, 0};

Scene render(const std::string& text) {
  auto [id, options] = scenes::read_request(text);
  options.grid = {1, 1};
  options.height = options.width = kSize;
  return scenes::render_builtin(id, options, Progress());
}

// An estimate of the center view, made from its truth.
using Estimator = std::function<float(float truth, int y, int x)>;

Metrics judge(const Scene& scene, const Estimator& estimate) {
  const DisparityView truth = scene.truth->field.view(kCenter);
  Image<float> map(kSize, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) map.at(y, x) = estimate(truth.disparity.at(y, x), y, x);
  }
  EvaluationOptions options;
  options.protocol = Protocol::Benchmark2016;
  options.camera = scene.light_field->info().camera;
  return evaluate({map.view(), {}}, truth, scene.truth->regions, options).metrics;
}

// −1 if there is no such number.
double number(const Metrics& metrics, const std::string& key) {
  return find_metric(metrics, key).value_or(-1);
}

std::set<int> values_of(const Image<std::uint8_t>& mask) {
  return {mask.data(), mask.data() + mask.size()};
}

// A row or column of the truth as an estimate: what stands in column `x` of the same row.
Estimator column_of(const Scene& scene, int x) {
  const auto truth = scene.truth->field.disparity.view(kCenter);
  return [truth, x](float, int y, int) { return truth.at(y, x); };
}

}  // namespace

class StratifiedSceneTest : public QObject {
  Q_OBJECT

 private slots:
  void truth_hasNoErrors_data() {
    QTest::addColumn<QString>("id");
    QTest::addColumn<QStringList>("keys");
    QTest::newRow("backgammon") << "backgammon?seed=3"
                                << QStringList{"backgammon_fattening_0070_lowres",
                                               "backgammon_thinning_0070_lowres"};
    QTest::newRow("dots") << "dots?seed=3"
                          << QStringList{"missed_dots_50_0400_lowres", "background_mse_100_lowres"};
    QTest::newRow("stripes") << "stripes?seed=3"
                             << QStringList{"low_texture_0070_lowres", "dark_stripes_0070_lowres",
                                            "bright_stripes_0070_lowres"};
    QTest::newRow("pyramids") << "pyramids?seed=3"
                              << QStringList{"bumpiness_slanted_100_0050",
                                             "bumpiness_parallel_100_0050"};
  }
  void truth_hasNoErrors() {
    QFETCH(QString, id);
    QFETCH(QStringList, keys);
    const Scene scene = render(id.toStdString());

    const Metrics metrics = judge(scene, [](float truth, int, int) { return truth; });

    for (const QString& key : keys) QCOMPARE(number(metrics, key.toStdString()), 0.0);
  }

  void backgammon_tellsFatTeethFromThinOnes() {
    const Scene scene = render("backgammon?seed=3");

    const Metrics fat = judge(scene, column_of(scene, 14));
    const Metrics thin = judge(scene, column_of(scene, kSize - 11));

    QCOMPARE(number(fat, "backgammon_fattening_0070_lowres"), 100.0);
    QCOMPARE(number(fat, "backgammon_thinning_0070_lowres"), 0.0);
    QCOMPARE(number(thin, "backgammon_fattening_0070_lowres"), 0.0);
    QCOMPARE(number(thin, "backgammon_thinning_0070_lowres"), 100.0);
  }

  void backgammon_hasStepsThatGrowDownwards_data() {
    QTest::addColumn<int>("seed");
    for (int seed = 1; seed <= 8; ++seed) QTest::addRow("%d", seed) << seed;
  }
  void backgammon_hasStepsThatGrowDownwards() {
    QFETCH(int, seed);
    const Scene scene = render("backgammon?seed=" + std::to_string(seed));

    const auto truth = scene.truth->field.disparity.view(kCenter);
    float last = 0;
    for (int y = 0; y < kSize; ++y) {
      const float step = truth.at(y, 14) - truth.at(y, kSize - 11);
      QVERIFY(step > last && step <= 1.51F);
      last = step;
    }
    QVERIFY(last > 0.85F);
  }

  void dots_areMissedWhereTheWallIsSeen() {
    const Scene scene = render("dots?seed=3");
    const auto truth = scene.truth->field.disparity.view(kCenter);
    const float wall = *std::min_element(truth.data, truth.data + truth.size());

    const Metrics metrics = judge(scene, [=](float, int, int) { return wall; });

    QCOMPARE(number(metrics, "missed_dots_50_0400_lowres"), 100.0);
    QVERIFY(number(metrics, "background_mse_100_lowres") < 1e-9);
  }

  // A dot without pixels would count as missed whatever the estimate.
  void dots_areSeenInEveryBox_data() {
    QTest::addColumn<int>("size");
    for (const int size : {96, 100, 192, 256}) QTest::addRow("%d px", size) << size;
  }
  void dots_areSeenInEveryBox() {
    QFETCH(int, size);
    scenes::RenderOptions options;
    options.grid = {1, 1};
    options.height = options.width = size;
    const Scene scene = scenes::render_builtin("dots", options, Progress());

    const auto& regions = scene.truth->regions;
    const Image<std::uint8_t>& sizes = regions.at("dots_by_size");
    const Image<std::uint8_t>& boxes = regions.at("boxes");
    std::set<std::pair<int, int>> dots;
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        if (sizes.at(y, x) != 0) dots.emplace(boxes.at(y, x), sizes.at(y, x));
      }
    }
    QCOMPARE(values_of(boxes).size(), std::size_t{16});
    QCOMPARE(*values_of(sizes).rbegin(), 8);
    QCOMPARE(dots.size(), std::size_t{16 * 8});
  }

  void stripes_partTheView() {
    const Scene scene = render("stripes?seed=3");

    const auto& regions = scene.truth->regions;
    const auto labels = scene.truth->labels.view(kCenter);
    const auto count = [&](const char* name, int y) {
      const std::uint8_t* row = regions.at(name).row(y);
      return std::count(row, row + kSize, 1);
    };
    for (int y = 0; y < kSize; ++y) {
      const auto walls = std::count(labels.row(y), labels.row(y) + kSize, 1);
      QCOMPARE(count("low_texture", y), y < kSize / 2 ? 0 : walls);
      QCOMPARE(count("high_contrast", y) + count("low_contrast", y) + walls, kSize);
      QVERIFY(count("high_contrast", y) > 0 && count("low_contrast", y) > 0);
    }
  }

  void pyramids_riseFromTheWall() {
    const Scene scene = render("pyramids?seed=3");

    const auto truth = scene.truth->field.disparity.view(kCenter);
    const auto labels = scene.truth->labels.view(kCenter);
    const float wall = truth.at(0, 0);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        if (labels.at(y, x) == 1) QCOMPARE(truth.at(y, x), wall);
        QVERIFY(truth.at(y, x) >= wall - 1e-6F && truth.at(y, x) < wall + 1.41F);
      }
    }
    QCOMPARE((std::set<int>(labels.data, labels.data + labels.size())), (std::set{1, 2, 3, 4}));
  }

  void masks_areThoseOfTheScene_data() {
    QTest::addColumn<QString>("id");
    QTest::addColumn<int>("kind");
    QTest::newRow("backgammon") << "backgammon" << static_cast<int>(StratifiedScene::Backgammon);
    QTest::newRow("dots") << "dots" << static_cast<int>(StratifiedScene::Dots);
    QTest::newRow("stripes") << "stripes" << static_cast<int>(StratifiedScene::Stripes);
    QTest::newRow("pyramids") << "pyramids" << static_cast<int>(StratifiedScene::Pyramids);
  }
  void masks_areThoseOfTheScene() {
    QFETCH(QString, id);
    QFETCH(int, kind);

    const Scene scene = render(id.toStdString());

    QCOMPARE(static_cast<int>(scene.truth->stratified), kind);
    QVERIFY(scene.truth->regions.contains("planes"));
    for (const auto& [name, mask] : scene.truth->regions) {
      QVERIFY2(*values_of(mask).rbegin() > 0, name.c_str());
    }
  }

  // The seed is that of the scene, not of its noise alone.
  void seeds_giveOtherScenes_data() {
    QTest::addColumn<QString>("id");
    for (const char* id : {"backgammon", "dots", "stripes", "pyramids"}) QTest::newRow(id) << id;
  }
  void seeds_giveOtherScenes() {
    QFETCH(QString, id);

    const Scene one = render(id.toStdString() + "?seed=1");
    const Scene two = render(id.toStdString() + "?seed=2");

    const auto a = one.truth->field.disparity.view(kCenter);
    const auto b = two.truth->field.disparity.view(kCenter);
    QVERIFY(!std::equal(a.data, a.data + a.size(), b.data));
    QVERIFY(one.light_field->sample_hash() != two.light_field->sample_hash());
  }
};

}  // namespace episcope::in_stratified_scene_test

EPISCOPE_TEST(stratified_scene_test, StratifiedSceneTest)
#include "stratified_scene_test.moc"
