// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi_two_layer.h"

#include "engine/disparity/disparity_range.h"
#include "engine/disparity/epi_s.h"
#include "engine/scenes/builtin.h"
#include "engine/scenes/stage.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace episcope::in_epi_two_layer_test {

using namespace episcope::test;

namespace {

constexpr int kSize = 128;

Estimate run(const Scene& scene, ViewSelection views = ViewSelection::All, int threads = 0) {
  return estimate_epi_two_layer(*scene.light_field, {}, views, Progress(threads));
}

double median_error(const DisparityView& estimate, const DisparityView& truth) {
  std::vector<double> errors;
  for (int y = 0; y < truth.disparity.height; ++y) {
    for (int x = 0; x < truth.disparity.width; ++x) {
      if (!truth.is_valid(y, x)) continue;
      errors.push_back(std::fabs(estimate.disparity.at(y, x) - truth.disparity.at(y, x)));
    }
  }
  std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
  return errors[errors.size() / 2];
}

double right_share(ImageView<const std::uint8_t> layers, const DisparityView& foreground) {
  double right = 0;
  for (int y = 0; y < layers.height; ++y) {
    for (int x = 0; x < layers.width; ++x) {
      right += (layers.at(y, x) == 2) == foreground.is_valid(y, x);
    }
  }
  return right / static_cast<double>(layers.size());
}

}  // namespace

class EpiTwoLayerTest : public QObject {
  Q_OBJECT

 private slots:
  void transparentPane_isFound_data();
  void transparentPane_isFound();
  void opaqueScenes_haveOneLayer_data();
  void opaqueScenes_haveOneLayer();
  void noisyWall_hasOneLayer();
  void darkAndPeriodicScenes_areNotTwoLayers_data();
  void darkAndPeriodicScenes_areNotTwoLayers();
  void layers_areOrderedAndAgreeOutside();
  void layers_areExactWithinTheirRegion();
  void surfaceSmoothness_concernsTheForegroundAlone();
  void layers_stayWithinTheRange();
  void range_isWidenedToBothLayers();
  void opaqueScene_comesOutAsByEpiS();
  void threadsAndCentre_changeNothing();
};

void EpiTwoLayerTest::transparentPane_isFound_data() {
  QTest::addColumn<double>("scale");
  QTest::addColumn<double>("noise");
  QTest::newRow("plain") << 1.0 << 0.0;
  QTest::newRow("noisy") << 1.0 << 3.0;
  QTest::newRow("wide") << 3.0 << 1.0;
}

void EpiTwoLayerTest::transparentPane_isFound() {
  QFETCH(double, scale);
  QFETCH(double, noise);
  const Scene scene = render("transparent", kSize, kSize, {9, 9}, scale, noise);
  const Estimate estimate = run(scene);
  const GroundTruth& truth = *scene.truth;
  for (const ViewIndex view : {ViewIndex{4, 4}, ViewIndex{0, 0}, ViewIndex{8, 2}}) {
    const double right =
        right_share(estimate.layered.layers.view(view), truth.foreground.view(view));
    const double near =
        median_error(estimate.layered.foreground.view(view), truth.foreground.view(view));
    const double far =
        median_error(estimate.layered.background.view(view), truth.background.view(view));
    const QString text = QString("view %1,%2: %3 right, %4 and %5 px")
                             .arg(view.v)
                             .arg(view.u)
                             .arg(right)
                             .arg(near)
                             .arg(far);
    QVERIFY2(right > 0.9 && near < 0.05 && far < 0.05, qPrintable(text));
  }
}

void EpiTwoLayerTest::opaqueScenes_haveOneLayer_data() {
  QTest::addColumn<QString>("id");
  for (const char* id : {"fronto", "slant", "edge", "bars", "objects", "demo"}) {
    QTest::newRow(id) << QString(id);
  }
}

void EpiTwoLayerTest::opaqueScenes_haveOneLayer() {
  QFETCH(QString, id);
  const Scene scene = render(id.toStdString(), kSize, kSize, {9, 9}, 1, 1);
  const Estimate estimate = run(scene, ViewSelection::Center);
  const auto& layers = estimate.layered.layers;
  const auto doubles = std::count(layers.data(), layers.data() + layers.size(), 2);
  QVERIFY2(doubles < 0.01 * static_cast<double>(layers.size()),
           qPrintable(QString::number(doubles)));
}

// Where nothing but noise is seen, neither one orientation fits nor two.
void EpiTwoLayerTest::noisyWall_hasOneLayer() {
  constexpr int size = 96;
  const LightField wall =
      make_light_field({9, 9}, size, size, 3, [](auto view, int y, int x, int c) {
        const std::uint64_t ray = (std::uint64_t(view.v * 9 + view.u) * size + y) * size + x;
        return 0.7F + 3 / 255.0F * scenes::sensor_noise(1, ray * 3 + c);
      });
  EpiTwoLayerParameters parameters;
  parameters.tensor.range = Interval{-1.5, 1.5};
  const Estimate estimate =
      estimate_epi_two_layer(wall, parameters, ViewSelection::Center, Progress());
  const auto& layers = estimate.layered.layers;
  QCOMPARE(std::count(layers.data(), layers.data() + layers.size(), 2), 0);
}

void EpiTwoLayerTest::darkAndPeriodicScenes_areNotTwoLayers_data() {
  QTest::addColumn<QString>("id");
  QTest::newRow("dark") << "random?seed=5&kind=dark&size=96";
  QTest::newRow("periodic") << "random?seed=51&kind=periodic&size=96";
  QTest::newRow("noisy") << "random?seed=13&size=128";
}

// Opaque scenes in which no line fits well, which came out as two layers throughout.
void EpiTwoLayerTest::darkAndPeriodicScenes_areNotTwoLayers() {
  QFETCH(QString, id);
  const auto [name, options] = scenes::read_request(id.toStdString());
  const Scene scene = scenes::render_builtin(name, options, Progress());
  const Estimate estimate = run(scene, ViewSelection::Center);
  const auto& layers = estimate.layered.layers;
  QCOMPARE(std::count(layers.data(), layers.data() + layers.size(), 2), 0);
}

void EpiTwoLayerTest::layers_areOrderedAndAgreeOutside() {
  const Scene scene = render("transparent", kSize, kSize, {5, 5});
  const Estimate estimate = run(scene);
  const LayeredDisparity& layered = estimate.layered;
  QVERIFY(all_finite(layered.foreground.disparity) && all_finite(layered.background.disparity));
  QVERIFY(same_bytes(estimate.field.disparity, layered.foreground.disparity));
  for (std::size_t i = 0; i < layered.layers.size(); ++i) {
    const float near = layered.foreground.disparity.data()[i];
    const float far = layered.background.disparity.data()[i];
    const int count = layered.layers.data()[i];
    QVERIFY(count == 1 || count == 2);
    QVERIFY(count == 2 ? near >= far : near == far);
    QVERIFY(far >= estimate.range.min - 1e-5 && near <= estimate.range.max + 1e-5);
  }
}

// However much a surface is smoothed, it may jump at its border: pulled to what lies around, it
// would be off by λ·perimeter/area, 0.04 px.
void EpiTwoLayerTest::layers_areExactWithinTheirRegion() {
  const Scene scene = render("transparent", 96, 96, {7, 7});
  const ViewIndex view = scene.light_field->center();
  const Estimate estimate = run(scene, ViewSelection::Center);
  const ImageView<const std::uint8_t> layers = estimate.layered.layers.view(view);
  const auto mse_100 = [&](const DisparityField& field, const DisparityField& truth) {
    double sum = 0, count = 0;
    for (int y = 0; y < layers.height; ++y) {
      for (int x = 0; x < layers.width; ++x) {
        if (layers.at(y, x) != 2 || !truth.view(view).is_valid(y, x)) continue;
        const double off =
            field.view(view).disparity.at(y, x) - truth.view(view).disparity.at(y, x);
        sum += 100 * off * off;
        count += 1;
      }
    }
    return count > 4000 ? sum / count : 1e9;
  };
  const double near = mse_100(estimate.layered.foreground, scene.truth->foreground);
  const double far = mse_100(estimate.layered.background, scene.truth->background);
  QVERIFY2(near < 0.005 && far < 0.01, qPrintable(QString("%1 %2").arg(near).arg(far)));
}

void EpiTwoLayerTest::surfaceSmoothness_concernsTheForegroundAlone() {
  const Scene scene = render("transparent", 72, 72, {5, 5}, 1, 2);
  EpiTwoLayerParameters rough, smooth;
  rough.layer_smoothness = 1;
  smooth.layer_smoothness = 10;
  const auto layers_of = [&](const EpiTwoLayerParameters& p) {
    return estimate_epi_two_layer(*scene.light_field, p, ViewSelection::Center, Progress()).layered;
  };
  const LayeredDisparity a = layers_of(rough), b = layers_of(smooth);
  QVERIFY(same_bytes(a.background.disparity, b.background.disparity));
  const ViewIndex view = scene.light_field->center();
  const double moved =
      largest_difference(a.foreground.disparity.view(view), b.foreground.disparity.view(view));
  QVERIFY2(moved > 0.01, qPrintable(QString::number(moved)));
}

void EpiTwoLayerTest::layers_stayWithinTheRange() {
  const Scene scene = render("transparent", 64, 64, {5, 5});
  const DisparityView near = scene.truth->foreground.view({2, 2});
  const DisparityView far = scene.truth->background.view({2, 2});
  EpiTwoLayerParameters p;
  p.tensor.range = Interval{far.disparity.at(32, 32) + 0.1, near.disparity.at(32, 32) - 0.1};
  QVERIFY(near.is_valid(32, 32) && p.tensor.range->length() > 0.5);
  const Estimate estimate =
      estimate_epi_two_layer(*scene.light_field, p, ViewSelection::All, Progress());
  for (const ViewStack<float>* layer :
       {&estimate.layered.foreground.disparity, &estimate.layered.background.disparity}) {
    const auto [least, most] = std::minmax_element(layer->data(), layer->data() + layer->size());
    QVERIFY(*least >= static_cast<float>(p.tensor.range->min) &&
            *most <= static_cast<float>(p.tensor.range->max));
  }
}

void EpiTwoLayerTest::range_isWidenedToBothLayers() {
  for (const double scale : {1.0, 3.0}) {
    const Scene scene = render("transparent", kSize, kSize, {9, 9}, scale);
    const EpiTwoLayerParameters p;
    const TensorScales scales{p.double_inner_scale, p.double_outer_scale, p.tensor.view_scale,
                              p.tensor.cross_scale, p.double_contrast,    p.tensor.noise};
    const Interval single = search_range(*scene.light_field, {}, Progress());

    const Interval both = search_layer_range(*scene.light_field, p.tensor, scales, Progress());

    QVERIFY(both.min <= single.min && both.max >= single.max);
    QVERIFY(both.min <= scene.truth->background.view({4, 4}).disparity.at(64, 64));
    QVERIFY(both.max >= scene.truth->foreground.view({4, 4}).disparity.at(64, 64));
  }
}

void EpiTwoLayerTest::opaqueScene_comesOutAsByEpiS() {
  const Scene scene = render("objects", 96, 96, {5, 5});
  EpiTwoLayerParameters layered;
  EpiSParameters parameters;
  parameters.denoising = {.lambda = layered.lambda,
                          .weight_power = layered.weight_power,
                          .edge_strength = layered.edge_strength,
                          .stop = layered.stop};
  parameters.line_check = layered.line_check;
  parameters.tensor = layered.tensor;
  parameters.tensor.range = layered.tensor.range = Interval{-2, 2};
  const Estimate smooth =
      estimate_epi_s(*scene.light_field, parameters, ViewSelection::Center, Progress());
  const Estimate found =
      estimate_epi_two_layer(*scene.light_field, layered, ViewSelection::Center, Progress());
  const ViewIndex center = scene.light_field->center();
  QVERIFY(largest_difference(smooth.field.disparity.view(center),
                             found.field.disparity.view(center)) < 1e-5);
}

void EpiTwoLayerTest::threadsAndCentre_changeNothing() {
  const Scene scene = render("transparent", 72, 88, {5, 5}, 1, 1);
  const Estimate one = run(scene, ViewSelection::All, 1);
  const Estimate many = run(scene, ViewSelection::All, 4);
  const Estimate center = run(scene, ViewSelection::Center);
  QVERIFY(same_bytes(one.field.disparity, many.field.disparity));
  QVERIFY(same_bytes(one.layered.background.disparity, many.layered.background.disparity));
  const ViewIndex view = scene.light_field->center();
  QVERIFY(largest_difference(one.layered.foreground.disparity.view(view),
                             center.layered.foreground.disparity.view(view)) < 1e-5);
}

}  // namespace episcope::in_epi_two_layer_test

EPISCOPE_TEST(epi_two_layer_test, EpiTwoLayerTest)
#include "epi_two_layer_test.moc"
