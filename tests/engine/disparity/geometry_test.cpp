// SPDX-License-Identifier: BSD-3-Clause
// Facts of geometry: what must hold of any disparity estimate, before any number is compared.
#include "engine/disparity/epi_l.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

namespace episcope::in_geometry_test {

using namespace episcope::test;

namespace {

Estimate epi_l(const LightField& lf, Interval range = {-1.2, 1.2},
               ViewSelection views = ViewSelection::All) {
  EpiLParameters parameters;
  parameters.range = range;
  return estimate_epi_l(lf, parameters, views, Progress());
}

Errors center_errors(const Scene& scene, const Estimate& estimate, int inset = 15) {
  const ViewIndex center = scene.light_field->center();
  return errors(estimate.field.disparity.view(center), scene.truth->field.view(center), inset);
}

// How two computations of the same map differ by rounding alone: hardly anywhere, but where two
// shears are equally coherent either may win, and their answers differ by the bias of a slope.
struct Difference {
  double share = 0;  // Of pixels that differ by more than 10⁻³ px.
  double worst = 0;
};

Difference difference(const ViewStack<float>& a, const ViewStack<float>& b,
                      const ViewStack<float>& confidence) {
  constexpr float confident = 0.9F;
  Difference result;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (confidence.data()[i] < confident) continue;
    const double off = std::fabs(static_cast<double>(a.data()[i]) - b.data()[i]);
    result.worst = std::max(result.worst, off);
    if (off > 1e-3) result.share += 1.0 / static_cast<double>(a.size());
  }
  return result;
}

void verify_same(const ViewStack<float>& a, const ViewStack<float>& b,
                 const ViewStack<float>& confidence) {
  const Difference off = difference(a, b, confidence);
  QVERIFY2(off.share < 1e-3, qPrintable(QString("share %1").arg(off.share)));
  QVERIFY2(off.worst < 0.05, qPrintable(QString("worst %1").arg(off.worst)));
}

ViewStack<float> transposed_map(const ViewStack<float>& map) {
  ViewStack<float> result({map.grid().u, map.grid().v}, map.width(), map.height());
  for (int v = 0; v < result.grid().v; ++v) {
    for (int u = 0; u < result.grid().u; ++u) {
      for (int y = 0; y < result.height(); ++y) {
        for (int x = 0; x < result.width(); ++x) {
          result.view({v, u}).at(y, x) = map.view({u, v}).at(x, y);
        }
      }
    }
  }
  return result;
}

}  // namespace

class GeometryTest : public QObject {
  Q_OBJECT

 private slots:
  void frontoPlane_isExactInEveryView();
  void slantedPlane_isWithinLimit();
  void planesWithEdge_areFlatAwayFromEdge();
  void edge_staysInPlace();
  void everyView_agreesWithItsTruth();
  void transposedLightField_transposesResult();
  void addedBrightness_changesNothing();
  void shear_addsToDisparity_data();
  void shear_addsToDisparity();
  void grid_ofAnyShape_isEstimated_data();
  void grid_ofAnyShape_isEstimated();
  void size_ofAnyKind_isEstimated_data();
  void size_ofAnyKind_isEstimated();
  void sampleType_changesNothing();
  void greyLightField_isEstimated();
  void wideRange_isEstimated();
};

// Bias below 0.005 px and MSE × 100 below 0.01, 15 px from the border, in the center view; views at
// the rim of the grid see lines on one side only, which costs up to twice the bias.
void GeometryTest::frontoPlane_isExactInEveryView() {
  const Scene scene = render("fronto", 80, 96);
  const Estimate estimate = epi_l(*scene.light_field);
  for (int v = 0; v < 9; ++v) {
    for (int u = 0; u < 9; ++u) {
      const Errors off =
          errors(estimate.field.disparity.view({v, u}), scene.truth->field.view({v, u}), 15);
      const bool inner = std::max(std::abs(v - 4), std::abs(u - 4)) <= 2;
      QVERIFY2(std::fabs(off.bias) < (inner ? 0.005 : 0.01),
               qPrintable(QString("view %1,%2: bias %3").arg(v).arg(u).arg(off.bias)));
      QVERIFY2(off.mse_100 < 0.01,
               qPrintable(QString("view %1,%2: MSE %3").arg(v).arg(u).arg(off.mse_100)));
    }
  }
}

// From −1 to 1 px, MSE × 100 below 0.02.
void GeometryTest::slantedPlane_isWithinLimit() {
  const Scene scene = render("slant", 96, 128);
  const Errors off = center_errors(scene, epi_l(*scene.light_field));
  QVERIFY2(off.mse_100 < 0.02, qPrintable(QString("MSE %1").arg(off.mse_100)));
  QVERIFY2(std::fabs(off.bias) < 0.005, qPrintable(QString("bias %1").arg(off.bias)));
}

// Away from the edge by more than occlusion (1.3 px · 4 views) and windows reach, both planes
// are flat.
void GeometryTest::planesWithEdge_areFlatAwayFromEdge() {
  const int width = 128;
  const Scene scene = render("edge", 72, width);
  const Estimate estimate = epi_l(*scene.light_field);
  const ViewIndex center = scene.light_field->center();
  const ImageView<const float> map = estimate.field.disparity.view(center);
  const DisparityView truth = scene.truth->field.view(center);
  const int reach = 14;
  for (int y = 15; y < map.height - 15; ++y) {
    for (int x = 15; x < width - 15; ++x) {
      if (std::abs(x - width / 2) < reach) continue;
      const double off = std::fabs(map.at(y, x) - truth.disparity.at(y, x));
      QVERIFY2(off < 0.05, qPrintable(QString("(%1, %2) off by %3").arg(y).arg(x).arg(off)));
    }
  }
  QVERIFY(std::fabs(map.at(36, 20) + 0.5F) < 0.01F);
  QVERIFY(std::fabs(map.at(36, width - 20) - 0.8F) < 0.01F);
}

// Fattening: how far the place moves where the map crosses from one plane to the other. A plain
// window over a silhouette would move it by its own radius of 2 px; 0.9 px were measured.
void GeometryTest::edge_staysInPlace() {
  const Scene scene = render("edge", 72, 128);
  const Estimate estimate = epi_l(*scene.light_field);
  for (const ViewIndex view : {ViewIndex{4, 4}, ViewIndex{4, 2}, ViewIndex{2, 6}}) {
    const ImageView<const float> map = estimate.field.disparity.view(view);
    const DisparityView truth = scene.truth->field.view(view);
    constexpr float middle = 0.15F;
    double shift = 0;
    for (int y = 15; y < map.height - 15; ++y) {
      for (int x = 15; x < map.width - 15; ++x) {
        shift += (map.at(y, x) > middle) - (truth.disparity.at(y, x) > middle);
      }
    }
    shift /= map.height - 30;
    QVERIFY2(std::fabs(shift) < 1.2,
             qPrintable(QString("view %1,%2 moved by %3 px").arg(view.v).arg(view.u).arg(shift)));
  }
}

// Each view has a truth of its own: a map stored at the wrong view would be off by up to
// 0.1 px × 4 at this slant.
void GeometryTest::everyView_agreesWithItsTruth() {
  const Scene scene = render("slant", 61, 96, {5, 9}, 1.0);
  const Estimate estimate = epi_l(*scene.light_field);
  for (int v = 0; v < 5; ++v) {
    for (int u = 0; u < 9; ++u) {
      const Errors off =
          errors(estimate.field.disparity.view({v, u}), scene.truth->field.view({v, u}), 15);
      QVERIFY2(off.mse_100 < 0.05,
               qPrintable(QString("view %1,%2: MSE %3").arg(v).arg(u).arg(off.mse_100)));
    }
  }
}

void GeometryTest::transposedLightField_transposesResult() {
  const Scene scene = render("objects", 61, 83, {5, 7});
  const LightField& lf = *scene.light_field;
  const LightField other = transposed(lf);
  const Estimate a = epi_l(lf);
  const Estimate b = epi_l(other);
  const ViewStack<float> expected = transposed_map(a.field.disparity);
  const ViewStack<float> confidence = transposed_map(a.confidence);
  verify_same(expected, b.field.disparity, confidence);
  double confidence_difference = 0;
  for (int v = 0; v < 7; ++v) {
    for (int u = 0; u < 5; ++u) {
      confidence_difference =
          std::max(confidence_difference,
                   largest_difference(confidence.view({v, u}), b.confidence.view({v, u})));
    }
  }
  QVERIFY2(confidence_difference < 1e-2, qPrintable(QString::number(confidence_difference)));
}

void GeometryTest::addedBrightness_changesNothing() {
  const Scene scene = render("edge", 48, 64, {5, 5});
  const LightField& lf = *scene.light_field;
  const ViewStack<float> samples = float_samples(lf);
  const auto brightened = [&](float added) {
    return like(lf, [&](ViewIndex view, int y, int x, int c) {
      return samples.view(view).at(y, x, c) + added;
    });
  };
  const Estimate plain = epi_l(brightened(0));
  const Estimate bright = epi_l(brightened(0.25F));
  verify_same(plain.field.disparity, bright.field.disparity, plain.confidence);
}

void GeometryTest::shear_addsToDisparity_data() {
  QTest::addColumn<int>("shear");
  for (const int shear : {-2, -1, 1, 3}) QTest::addRow("%d", shear) << shear;
}

void GeometryTest::shear_addsToDisparity() {
  QFETCH(int, shear);
  const Scene scene = render("slant", 80, 96, {5, 5});
  const Interval range{-1.5, 1.5};
  const Estimate plain = epi_l(*scene.light_field, range, ViewSelection::Center);
  const Estimate moved = epi_l(sheared(*scene.light_field, shear),
                               {range.min + shear, range.max + shear}, ViewSelection::Center);
  const ViewIndex center = scene.light_field->center();
  const ImageView<const float> a = plain.field.disparity.view(center);
  const ImageView<const float> b = moved.field.disparity.view(center);
  const int inset = 2 * std::abs(shear) + 8;
  for (int y = inset; y < a.height - inset; ++y) {
    for (int x = inset; x < a.width - inset; ++x) {
      // Unshearing the tensor by k loses the bits of k² · Jxx.
      QVERIFY2(
          std::fabs(b.at(y, x) - a.at(y, x) - static_cast<float>(shear)) < 2e-3F,
          qPrintable(
              QString("(%1, %2): %3, sheared %4").arg(y).arg(x).arg(a.at(y, x)).arg(b.at(y, x))));
    }
  }
}

void GeometryTest::grid_ofAnyShape_isEstimated_data() {
  QTest::addColumn<int>("rows");
  QTest::addColumn<int>("columns");
  QTest::addColumn<double>("limit");
  // Fewer views measure slopes with less; the limits are three times what was measured or more.
  QTest::newRow("3x3") << 3 << 3 << 0.05;
  QTest::newRow("2x2") << 2 << 2 << 0.2;
  QTest::newRow("5x9") << 5 << 9 << 0.01;
  QTest::newRow("even") << 4 << 6 << 0.03;
  QTest::newRow("one row") << 1 << 17 << 0.02;
  QTest::newRow("one column") << 17 << 1 << 0.02;
}

void GeometryTest::grid_ofAnyShape_isEstimated() {
  QFETCH(int, rows);
  QFETCH(int, columns);
  QFETCH(double, limit);
  const Scene scene = render("fronto", 64, 64, {rows, columns});
  const Estimate estimate = epi_l(*scene.light_field);
  QVERIFY(estimate.field.disparity.grid() == scene.light_field->grid());
  QVERIFY(all_finite(estimate.field.disparity));
  const Errors off = center_errors(scene, estimate);
  QVERIFY2(off.mse_100 < limit, qPrintable(QString("MSE %1").arg(off.mse_100)));
  const ViewIndex corner{rows - 1, columns - 1};
  const Errors corner_off =
      errors(estimate.field.disparity.view(corner), scene.truth->field.view(corner), 15);
  QVERIFY2(corner_off.mse_100 < 3 * limit, qPrintable(QString("MSE %1").arg(corner_off.mse_100)));
}

void GeometryTest::size_ofAnyKind_isEstimated_data() {
  QTest::addColumn<int>("height");
  QTest::addColumn<int>("width");
  QTest::newRow("47x61") << 47 << 61;
  QTest::newRow("61x47") << 61 << 47;
  QTest::newRow("100x130") << 100 << 130;
  QTest::newRow("a row more than a band") << 129 << 57;
  QTest::newRow("a column more than a block") << 64 << 29;
  QTest::newRow("high and narrow") << 150 << 31;
  QTest::newRow("tiny") << 33 << 34;
}

// No column or row is left out or written by a neighbor: each is near the truth, to the border.
void GeometryTest::size_ofAnyKind_isEstimated() {
  QFETCH(int, height);
  QFETCH(int, width);
  const Scene scene = render("fronto", height, width, {5, 5});
  const Estimate estimate = epi_l(*scene.light_field);
  QVERIFY(all_finite(estimate.field.disparity));
  QVERIFY(all_finite(estimate.confidence));
  QVERIFY(center_errors(scene, estimate, 12).mse_100 < 0.02);
  const ImageView<const float> map = estimate.field.disparity.view(scene.light_field->center());
  for (int x = 0; x < width; ++x) {
    double sum = 0;
    for (int y = 0; y < height; ++y) sum += map.at(y, x);
    // At the border samples are repeated, which pulls towards 0.
    QVERIFY2(std::fabs(sum / height - 0.37) < 0.12,
             qPrintable(QString("column %1: %2").arg(x).arg(sum / height)));
  }
  for (int y = 0; y < height; ++y) {
    double sum = 0;
    for (int x = 0; x < width; ++x) sum += map.at(y, x);
    QVERIFY2(std::fabs(sum / width - 0.37) < 0.12,
             qPrintable(QString("row %1: %2").arg(y).arg(sum / width)));
  }
}

void GeometryTest::sampleType_changesNothing() {
  const Scene scene = render("edge", 53, 71, {5, 5});
  const LightField& bytes = *scene.light_field;
  QVERIFY(bytes.sample_type() == SampleType::UInt8);
  const ViewStack<float> samples = float_samples(bytes);
  const LightField floats = like(
      bytes, [&](ViewIndex view, int y, int x, int c) { return samples.view(view).at(y, x, c); });
  const Estimate of_bytes = epi_l(bytes);
  const Estimate of_words = epi_l(as_uint16(bytes));
  const Estimate of_floats = epi_l(floats);
  verify_same(of_bytes.field.disparity, of_words.field.disparity, of_bytes.confidence);
  verify_same(of_bytes.field.disparity, of_floats.field.disparity, of_bytes.confidence);
}

void GeometryTest::greyLightField_isEstimated() {
  const Scene scene = render("slant", 72, 96, {7, 7});
  const Estimate estimate = epi_l(grey(*scene.light_field));
  const Errors off = center_errors(scene, estimate);
  QVERIFY2(off.mse_100 < 0.1, qPrintable(QString("MSE %1").arg(off.mse_100)));
}

// ±3.5 px are far beyond what an unsheared EPI can measure.
void GeometryTest::wideRange_isEstimated() {
  const Scene scene = render("slant", 96, 160, {9, 9}, 3.5);
  const Estimate estimate = epi_l(*scene.light_field, {-3.8, 3.8}, ViewSelection::Center);
  const Errors off = center_errors(scene, estimate, 20);
  QVERIFY2(off.mse_100 < 0.2, qPrintable(QString("MSE %1").arg(off.mse_100)));
}

}  // namespace episcope::in_geometry_test

EPISCOPE_TEST(geometry_test, GeometryTest)
#include "geometry_test.moc"
