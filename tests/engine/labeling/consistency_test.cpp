// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/label_review.h"

#include "engine/core/error.h"
#include "engine/labeling/pixel_features.h"
#include "engine/labeling/ray_labeling.h"
#include "engine/scenes/builtin.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>

namespace episcope::in_consistency_test {

namespace {

Scene render(const std::string& id) {
  scenes::RenderOptions options;
  options.grid = {5, 5};
  options.height = options.width = 64;
  return scenes::render_builtin(id, options, Progress());
}

}  // namespace

class ConsistencyTest : public QObject {
  Q_OBJECT

 private slots:
  void truth_agrees();
  void oneWrongView_isSeenByTheOthers();
  void hiddenPoints_areNotCompared();
  void consistency_refusesOtherSizes();
  void edges_lieWhereImageOrDisparityJump();
  void weights_takeTheMoreProbableDirection();
  void edges_refuseOtherSizes();
};

// Only where a ray arrives between two pixels may the nearer one belong to the neighbor.
void ConsistencyTest::truth_agrees() {
  const Scene planes = render("edge"), objects = render("objects");

  const auto on_planes = label_consistency(planes.truth->labels, planes.truth->field, Progress());
  const auto on_objects =
      label_consistency(objects.truth->labels, objects.truth->field, Progress());

  QVERIFY(on_planes.checked() > 0.9 && on_planes.checked() < 1);
  QVERIFY2(on_planes.share() > 0.999, qPrintable(QString::number(on_planes.share())));
  QVERIFY2(on_objects.share() > 0.99, qPrintable(QString::number(on_objects.share())));
  QCOMPARE(on_planes.pairs, std::int64_t{25} * 8 * 64 * 64);
}

void ConsistencyTest::oneWrongView_isSeenByTheOthers() {
  const Scene scene = render("fronto");
  auto labels = scene.truth->labels.clone();
  const auto wrong = labels.view({1, 3});
  for (std::size_t i = 0; i < labels.view_size(); ++i) wrong.data[i] += 5;

  const auto found = label_consistency(labels, scene.truth->field, Progress());

  // Of 25 · 8 pairs of views, 16 have the wrong one at one end; rays leave the image here and
  // there.
  QVERIFY(std::abs(found.share() - (1 - 16.0 / 200)) < 2e-3);
}

void ConsistencyTest::hiddenPoints_areNotCompared() {
  const Scene scene = render("fronto");
  DisparityField field{scene.truth->field.disparity.clone(), {}};
  const auto other = field.disparity.view({2, 2});
  for (std::size_t i = 0; i < field.disparity.view_size(); ++i) other.data[i] += 2;
  auto labels = scene.truth->labels.clone();
  const auto wrong = labels.view({2, 2});
  for (std::size_t i = 0; i < labels.view_size(); ++i) wrong.data[i] += 5;

  const auto found = label_consistency(labels, field, Progress());

  QCOMPARE(found.agreeing, found.visible);
}

void ConsistencyTest::consistency_refusesOtherSizes() {
  const Scene scene = render("fronto");
  const ViewStack<std::int32_t> small({5, 5}, 8, 8);

  QVERIFY_THROWS_EXCEPTION(InvalidInput,
                           (void)label_consistency(small, scene.truth->field, Progress()));
  QVERIFY_THROWS_EXCEPTION(InvalidInput,
                           (void)label_consistency(scene.truth->labels, {}, Progress()));
}

void ConsistencyTest::edges_lieWhereImageOrDisparityJump() {
  const Scene scene = render("edge");
  const ViewIndex view{2, 2};
  const auto truth = scene.truth->labels.view(view);

  const auto both = edge_probabilities(*scene.light_field, scene.truth->field, {}, Progress());
  const auto one = edge_probability(*scene.light_field, view, {}, {});

  const auto edges = both.view(view);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 63; ++x) {
      QVERIFY(edges.at(y, x) >= 0 && edges.at(y, x) <= 1);
      if (truth.at(y, x) != truth.at(y, x + 1)) QVERIFY(edges.at(y, x) > 0.9F);
      // Texture counts less where disparity has no jump.
      const bool is_far = truth.at(y, std::max(x - 5, 0)) == truth.at(y, std::min(x + 6, 63));
      const float texture =
          std::pow(1 - one.at(y, x), static_cast<float>(EdgeParameters().texture));
      if (is_far) QVERIFY(std::abs(1 - edges.at(y, x) - texture) < 1e-3F);
    }
  }
}

void ConsistencyTest::weights_takeTheMoreProbableDirection() {
  Image<float> two(1, 2, 2);
  two.at(0, 0, 0) = 0.25F;
  two.at(0, 0, 1) = 0.75F;
  two.at(0, 1, 0) = 1;

  const Image<float> weights = boundary_weights(two);

  QCOMPARE(weights.at(0, 0), 0.25F);
  QCOMPARE(weights.at(0, 1), kMinBoundaryWeight);
}

void ConsistencyTest::edges_refuseOtherSizes() {
  const Scene scene = render("fronto");
  const DisparityField small{ViewStack<float>({5, 5}, 8, 8), {}};

  QVERIFY_THROWS_EXCEPTION(InvalidInput,
                           (void)edge_probabilities(*scene.light_field, small, {}, Progress()));
}

}  // namespace episcope::in_consistency_test

EPISCOPE_TEST(consistency_test, ConsistencyTest)
#include "consistency_test.moc"
