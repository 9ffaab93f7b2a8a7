// SPDX-License-Identifier: BSD-3-Clause
// What every method makes of views that are dark in part, or altogether.
#include "engine/disparity/estimator.h"
#include "engine/disparity/registry.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>

namespace episcope::in_invalid_pixels_test {

using namespace episcope::test;

namespace {

constexpr GridShape kGrid{7, 7};
constexpr int kSide = 64;

// A round aperture that outer views see from the side; nothing at all in the corners of the grid.
bool is_seen(ViewIndex view, int y, int x) {
  const double dv = (view.v - 3) / 3.0;
  const double du = (view.u - 3) / 3.0;
  const double off = std::hypot(dv, du);
  if (off > 1.3) return false;
  const double middle_y = 0.5 * kSide * (1 - 0.5 * dv);
  const double middle_x = 0.5 * kSide * (1 - 0.5 * du);
  const double radius = off > 0.5 ? 0.55 * kSide : 0.64 * kSide;
  return std::hypot(y - middle_y, x - middle_x) < radius;
}

enum class Mask { None, Given, AllValid };

LightField vignetted(const LightField& clean, Mask mask) {
  LightFieldInfo info = clean.info();
  ViewStack<std::uint8_t> valid(kGrid, kSide, kSide);
  ViewStack<float> samples = float_samples(clean);
  for (int i = 0; i < kGrid.count(); ++i) {
    const ViewIndex view = kGrid.view_at(i);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const bool is_there = mask == Mask::AllValid || is_seen(view, y, x);
        valid.view(view).at(y, x) = is_there ? 1 : 0;
        for (int c = 0; c < 3 && !is_there; ++c) samples.view(view).at(y, x, c) = 0;
      }
    }
  }
  if (mask == Mask::None) return {std::move(samples), std::move(info)};
  return {std::move(samples), std::move(info), std::move(valid)};
}

Estimate run(const std::string& method, const LightField& light_field) {
  return find_estimator(method).run(light_field, {{"range", Interval{-1.2, 1.2}}},
                                    {.views = ViewSelection::Center}, Progress(2));
}

// Root of the mean squared error in px, over the pixels that the center view shows.
double rms_error(const Estimate& estimate, const Scene& scene) {
  constexpr int kInset = 6;
  const ViewIndex center = kGrid.center();
  const auto truth = scene.truth->field.view(center);
  const auto found = estimate.field.disparity.view(center);
  double sum = 0;
  int count = 0;
  for (int y = kInset; y < kSide - kInset; ++y) {
    for (int x = kInset; x < kSide - kInset; ++x) {
      if (!is_seen(center, y, x)) continue;
      const double off = found.at(y, x) - truth.disparity.at(y, x);
      sum += off * off;
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

}  // namespace

class InvalidPixelsTest : public QObject {
  Q_OBJECT

 private slots:
  void mask_undoesVignetting_data() { addMethods(); }
  void mask_undoesVignetting();
  void invalidPixels_getNoValidResult_data() { addMethods(); }
  void invalidPixels_getNoValidResult();
  void maskOfValidPixels_changesNothing_data() { addMethods(); }
  void maskOfValidPixels_changesNothing();
  void unseenView_isLeftOut_data() { addMethods(); }
  void unseenView_isLeftOut();

 private:
  static void addMethods() {
    QTest::addColumn<QString>("method");
    for (const Estimator& method : registered_estimators()) {
      QTest::newRow(method.info.id.c_str()) << QString::fromStdString(method.info.id);
    }
  }
  const Scene scene_ = render("slant", kSide, kSide, kGrid);
};

void InvalidPixelsTest::mask_undoesVignetting() {
  QFETCH(QString, method);
  const std::string id = method.toStdString();

  const double clean = rms_error(run(id, *scene_.light_field), scene_);
  const double dark = rms_error(run(id, vignetted(*scene_.light_field, Mask::None)), scene_);
  const double masked = rms_error(run(id, vignetted(*scene_.light_field, Mask::Given)), scene_);

  const QString numbers = QString("clean %1, dark %2, masked %3").arg(clean).arg(dark).arg(masked);
  // Fewer views see the border: as much as half again is theirs, and what rounding leaves.
  QVERIFY2(masked < 1.5 * clean + 0.005, qPrintable(numbers));
  QVERIFY2(masked <= dark + 0.002, qPrintable(numbers));
  if (method.startsWith("epi")) QVERIFY2(dark > 2 * masked, qPrintable(numbers));
}

void InvalidPixelsTest::invalidPixels_getNoValidResult() {
  QFETCH(QString, method);

  const Estimate estimate = run(method.toStdString(), vignetted(*scene_.light_field, Mask::Given));

  const ViewIndex center = kGrid.center();
  const DisparityView map = estimate.field.view(center);
  const auto confidence = estimate.confidence.view(center);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      QCOMPARE(map.is_valid(y, x), is_seen(center, y, x));
      QVERIFY(is_seen(center, y, x) || confidence.at(y, x) == 0);
    }
  }
}

void InvalidPixelsTest::maskOfValidPixels_changesNothing() {
  QFETCH(QString, method);
  const LightField bare(float_samples(*scene_.light_field), scene_.light_field->info());

  const Estimate without = run(method.toStdString(), bare);
  const Estimate with = run(method.toStdString(), vignetted(bare, Mask::AllValid));

  const ViewIndex center = kGrid.center();
  // The last places may differ, as sums are added in another order.
  QVERIFY(largest_difference(without.field.disparity.view(center),
                             with.field.disparity.view(center)) < 1e-3);
}

void InvalidPixelsTest::unseenView_isLeftOut() {
  QFETCH(QString, method);
  const LightField first = vignetted(*scene_.light_field, Mask::Given);
  // Whatever invalid pixels hold.
  const LightField other = [&] {
    ViewStack<float> samples = float_samples(first);
    for (int i = 0; i < kGrid.count(); ++i) {
      const ViewIndex view = kGrid.view_at(i);
      if (view == kGrid.center()) continue;
      for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
          for (int c = 0; c < 3 && !is_seen(view, y, x); ++c) samples.view(view).at(y, x, c) = 0.9F;
        }
      }
    }
    return LightField(std::move(samples), first.info(), first.valid().clone());
  }();

  const Estimate a = run(method.toStdString(), first);
  const Estimate b = run(method.toStdString(), other);

  QVERIFY(same_bytes(a.field.disparity, b.field.disparity));
}

}  // namespace episcope::in_invalid_pixels_test

EPISCOPE_TEST(invalid_pixels_test, InvalidPixelsTest)
#include "invalid_pixels_test.moc"
