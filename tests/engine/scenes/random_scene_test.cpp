// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/random_scene.h"
#include "engine/scenes/builtin.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace episcope::in_random_scene_test {

using scenes::RandomKind;

namespace {

constexpr int kSize = 48;
constexpr double kMostDisparity = 3.5;

Scene render(unsigned seed, RandomKind kind, GridShape grid, int size = kSize) {
  scenes::RenderOptions options;
  options.grid = grid;
  options.height = options.width = size;
  options.seed = seed;
  options.kind = kind;
  return scenes::render_builtin("random", options, Progress());
}

Interval range_of(const ViewStack<float>& disparity) {
  const auto [min, max] =
      std::minmax_element(disparity.data(), disparity.data() + disparity.size());
  return {*min, *max};
}

std::set<int> labels_of(const Scene& scene) {
  const auto& labels = scene.truth->labels;
  return {labels.data(), labels.data() + labels.size()};
}

std::vector<RandomKind> all_kinds() {
  std::vector<RandomKind> kinds;
  for (std::size_t i = 0; i < names_of(scenes::RandomKind{}).size(); ++i) {
    kinds.push_back(static_cast<RandomKind>(i));
  }
  return kinds;
}

void add_every_kind() {
  QTest::addColumn<int>("kind");
  for (const RandomKind kind : all_kinds()) {
    QTest::newRow(name_of(kind).c_str()) << static_cast<int>(kind);
  }
}

double mean_sample(const Scene& scene) {
  const Image<float> view = scene.light_field->view_as_float(scene.light_field->center());
  double sum = 0;
  for (const float sample : view) sum += static_cast<double>(sample);
  return 255 * sum / static_cast<double>(view.size());
}

// The median difference of samples beside each other, in units of 1/255.
double median_step(const Scene& scene) {
  const Image<float> view = scene.light_field->view_as_float(scene.light_field->center());
  std::vector<float> steps;
  for (int y = 0; y < view.height(); ++y) {
    for (int x = 0; x + 1 < view.width(); ++x) {
      steps.push_back(255 * std::fabs(view.at(y, x + 1) - view.at(y, x)));
    }
  }
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return static_cast<double>(*middle);
}

double roughness(RandomKind kind) {
  double sum = 0;
  for (unsigned seed = 0; seed < 8; ++seed) sum += median_step(render(seed, kind, {1, 1}, 128));
  return sum / 8;
}

}  // namespace

class RandomSceneTest : public QObject {
  Q_OBJECT

 private slots:
  void disparities_lieWithinTheLimitInAllViews_data() { add_every_kind(); }
  void disparities_lieWithinTheLimitInAllViews() {
    QFETCH(int, kind);

    for (unsigned seed = 0; seed < 6; ++seed) {
      const Scene scene = render(seed, static_cast<RandomKind>(kind), {9, 9}, 32);

      const Interval range = range_of(scene.truth->field.disparity);
      QVERIFY2(range.min >= -kMostDisparity - 1e-5 && range.max <= kMostDisparity + 1e-5,
               qPrintable(QString("seed %1: %2 to %3").arg(seed).arg(range.min).arg(range.max)));
      const auto& valid = scene.truth->field.valid;
      QVERIFY(std::all_of(valid.data(), valid.data() + valid.size(),
                          [](std::uint8_t is_valid) { return is_valid != 0; }));
    }
  }

  void seeds_giveDifferentScenes() {
    std::set<std::uint64_t> hashes;
    for (const RandomKind kind : all_kinds()) {
      for (unsigned seed = 0; seed < 20; ++seed) {
        hashes.insert(render(seed, kind, {1, 1}).light_field->sample_hash());
      }
    }
    QCOMPARE(hashes.size(), 20 * all_kinds().size());
  }

  void ranges_areNarrowAndWideAndOneSided() {
    int narrow = 0;
    int wide = 0;
    int one_sided = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
      const Scene scene = render(seed, RandomKind::Any, {1, 1});
      const Interval range = range_of(scene.truth->field.disparity);
      narrow += range.length() < 1.2;
      wide += range.length() > 3;
      one_sided += range.min > 0 || range.max < 0;
    }
    QVERIFY(narrow >= 4 && wide >= 4 && one_sided >= 4);
  }

  void objects_areFewOrManyAndInSight() {
    std::size_t fewest = 1000;
    std::size_t most = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
      const std::size_t labels = labels_of(render(seed, RandomKind::Any, {1, 1}, 160)).size();
      QVERIFY2(labels >= 3, qPrintable(QString::number(seed)));
      fewest = std::min(fewest, labels);
      most = std::max(most, labels);
    }
    // A wall or ground and the objects.
    QVERIFY(fewest <= 6);
    QVERIFY(most >= 25);
  }

  void dark_isDarkAndWide() {
    for (unsigned seed = 0; seed < 10; ++seed) {
      const Scene scene = render(seed, RandomKind::Dark, {1, 1}, 96);

      QVERIFY(mean_sample(scene) < 90);
      const Interval range = range_of(scene.truth->field.disparity);
      QVERIFY(range.min < -2 && range.min > -3.2 && range.max < 3.2);
    }
  }

  void occlusion_hasBarsAndGrowingNoise() {
    for (unsigned seed = 0; seed < 10; ++seed) {
      const auto model = scenes::random_scene(96, 96, seed, RandomKind::Occlusion).model;

      QVERIFY(model.sensor.noise_bottom >= model.sensor.noise_top + 2);
      QVERIFY(std::ranges::any_of(model.primitives, [](const scenes::Primitive& primitive) {
        return primitive.shape == scenes::Shape::Lattice;
      }));
    }
  }

  void thin_hasMoreThinThings() {
    const auto share = [](RandomKind kind) {
      std::size_t thin = 0;
      std::size_t all = 0;
      for (unsigned seed = 0; seed < 30; ++seed) {
        for (const auto& primitive : scenes::random_scene(96, 96, seed, kind).model.primitives) {
          ++all;
          thin +=
              primitive.shape == scenes::Shape::Lattice || primitive.shape == scenes::Shape::Leaf;
        }
      }
      return static_cast<double>(thin) / static_cast<double>(all);
    };
    QVERIFY(share(RandomKind::Thin) > 1.2 * share(RandomKind::Any));
    QVERIFY(share(RandomKind::Thin) > 2 * share(RandomKind::Shiny));
  }

  void room_holdsThinBarsAmongElevenObjects() {
    for (unsigned seed = 0; seed < 10; ++seed) {
      const auto scene = scenes::random_scene(512, 512, seed, RandomKind::Room);
      std::set<int> labels;
      for (const scenes::Primitive& primitive : scene.model.primitives) {
        labels.insert(primitive.label);
        if (primitive.shape != scenes::Shape::Lattice) continue;
        const double width_px = 2 * primitive.profile[2] / scene.stage.pixel(primitive.center[2]);
        QVERIFY(width_px > 1.5 && width_px <= 4);
      }
      QCOMPARE(labels.size(), std::size_t{11});
    }
  }

  // Few things, and a thing of three or more curved parts is a drape.
  void smooth_isWeaklyTexturedCleanAndFolded() {
    int folded = 0;
    for (unsigned seed = 0; seed < 10; ++seed) {
      const auto model = scenes::random_scene(256, 256, seed, RandomKind::Smooth).model;

      QVERIFY(model.sensor.noise_top <= 2 && model.sensor.noise_bottom <= 2);
      QVERIFY(model.lighting.is_on && !model.lighting.has_moving_highlights);
      std::map<int, int> curved;  // Parts of each thing.
      for (const scenes::Primitive& primitive : model.primitives) {
        curved[primitive.label] += primitive.shape == scenes::Shape::Revolution ? 1 : 0;
      }
      QVERIFY(curved.size() <= 9);
      folded += std::ranges::any_of(curved, [](const auto& each) { return each.second >= 3; });
    }
    QVERIFY2(folded >= 6, qPrintable(QString::number(folded)));
  }

  void smooth_hasLessTextureThanOthers() {
    const double smooth = roughness(RandomKind::Smooth);
    QVERIFY2(smooth < 2.5, qPrintable(QString::number(smooth)));
    QVERIFY(smooth < 0.6 * roughness(RandomKind::Any));
  }

  // Half of the sensors see single points; the others a part of each pixel.
  void aliased_isSampledSparsely() {
    int points = 0;
    for (unsigned seed = 0; seed < 20; ++seed) {
      const float fill = scenes::random_scene(64, 64, seed, RandomKind::Aliased).model.sensor.fill;
      QVERIFY(fill >= 0 && fill < 1);
      points += fill == 0 ? 1 : 0;
    }
    QVERIFY2(points >= 5 && points <= 15, qPrintable(QString::number(points)));
  }

  void aliased_hasFinerDetailThanOthers() {
    const double aliased = roughness(RandomKind::Aliased);
    QVERIFY2(aliased > 1.4 * roughness(RandomKind::Any), qPrintable(QString::number(aliased)));
  }

  // Rays that leave out parts of pixels miss the edges in these.
  void aliased_hasDiscontinuitiesAllTheSame() {
    const Scene scene = render(1, RandomKind::Aliased, {1, 1}, 96);
    QVERIFY(scene.truth->regions.contains("discontinuities"));
  }

  void faint_isMostlyADarkWall() {
    for (unsigned seed = 0; seed < 6; ++seed) {
      const Scene scene = render(seed, RandomKind::Faint, {1, 1}, 96);

      const auto& labels = scene.truth->labels;
      const Image<float> view = scene.light_field->view_as_float(scene.light_field->center());
      std::size_t wall = 0;
      double sum = 0;
      for (std::size_t i = 0; i < labels.size(); ++i) {
        if (labels.data()[i] != 1) continue;
        ++wall;
        sum += view.data()[3 * i + 1];
      }
      const double share = static_cast<double>(wall) / static_cast<double>(labels.size());
      QVERIFY2(share > 0.3, qPrintable(QString("seed %1: %2").arg(seed).arg(share)));
      QVERIFY(sum / static_cast<double>(wall) < 0.2);
    }
  }

  void shiny_hasHighlightsThatMove() {
    const auto model = scenes::random_scene(96, 96, 3, RandomKind::Shiny).model;

    QVERIFY(model.lighting.is_on && model.lighting.has_moving_highlights);
    QVERIFY(std::ranges::any_of(model.textures,
                                [](const scenes::Texture& texture) { return texture.gloss > 0; }));
  }
};

}  // namespace episcope::in_random_scene_test

EPISCOPE_TEST(random_scene_test, RandomSceneTest)
#include "random_scene_test.moc"
