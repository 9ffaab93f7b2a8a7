// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/image_file.h"
#include "engine/io/base/npy.h"
#include "engine/io/open.h"
#include "tests/engine/io/models/sidecar_maps/layered_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <fmt/format.h>
#include <QTemporaryDir>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <vector>

namespace episcope::in_unknown_unit_test {

using namespace episcope::test;

namespace fs = std::filesystem;

namespace {

/// A plane with a square before it, which hides other parts of it in each view.
Scene plane_behind_square(const PlaneOptions& options = {}) {
  constexpr float kNear = 1.8F;
  const Scene plane = plane_scene(options);
  ViewStack<std::uint8_t> views = bytes_of(plane).clone();
  auto truth = std::make_shared<GroundTruth>();
  truth->field.disparity = plane.truth->field.disparity.clone();
  const ViewIndex center = views.grid().center();
  for (int i = 0; i < views.grid().count(); ++i) {
    const ViewIndex view = views.view_at(i);
    for (int y = 0; y < views.height(); ++y) {
      for (int x = 0; x < views.width(); ++x) {
        const double cx = x + kNear * static_cast<float>(view.u - center.u);
        const double cy = y + kNear * static_cast<float>(view.v - center.v);
        if (cx < 20 || cx > 50 || cy < 16 || cy > 46) continue;
        const double grey = 128 + 60 * std::sin(0.9 * cx + 0.3 * cy) * std::cos(0.7 * cy);
        for (int c = 0; c < 3; ++c) {
          views.view(view).at(y, x, c) = static_cast<std::uint8_t>(std::lround(grey));
        }
        truth->field.disparity.view(view).at(y, x) = kNear;
      }
    }
  }
  Scene scene;
  scene.light_field = std::make_shared<LightField>(std::move(views), plane.light_field->info());
  scene.truth = std::move(truth);
  return scene;
}

}  // namespace

/// Maps of the center view whose unit, sign or order of pixels no file states.
class UnknownUnitTest : public QObject {
  Q_OBJECT

 private:
  using Number = std::function<double(double disparity)>;

  std::unique_ptr<QTemporaryDir> folder_;
  Scene scene_ = plane_behind_square();

  fs::path path(const std::string& name = {}) const {
    return fs::path(folder_->path().toStdString()) / name;
  }
  ImageView<const float> disparity() const {
    return scene_.truth->field.disparity.view(scene_.light_field->grid().center());
  }
  void write_views() const {
    const ViewStack<std::uint8_t>& views = bytes_of(scene_);
    for (int i = 0; i < views.grid().count(); ++i) {
      const ViewIndex view = views.view_at(i);
      io::write_png(path(fmt::format("{}_{}.png", view.v, view.u)), views.view(view));
    }
  }
  /// With a gap between them and 0.
  void use_positive_disparities() {
    PlaneOptions options;
    options.d0 = 1.5;
    scene_ = plane_scene(options);
    write_views();
  }
  /// No map explains noise.
  void use_noisy_views() {
    use_positive_disparities();
    ViewStack<std::uint8_t> views = bytes_of(scene_).clone();
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 9);
    std::transform(views.data(), views.data() + views.size(), views.data(), [&](std::uint8_t grey) {
      return static_cast<std::uint8_t>(std::clamp(grey + noise(random), 0.0, 255.0));
    });
    scene_.light_field = std::make_shared<LightField>(std::move(views), scene_.light_field->info());
    write_views();
  }
  /// Writes the disparity as numbers.
  void write_numbers(const Number& number) const {
    Image<float> map(disparity().height, disparity().width);
    std::transform(disparity().data, disparity().data + disparity().size(), map.data(),
                   [&](float d) { return static_cast<float>(number(d)); });
    write_array("disparity.npy", map.view());
  }
  Scene open() const { return io::open_scene(path(), {}, Progress(2)); }

  template <class T>
  void write_picture(const std::string& name, const Number& number) const {
    Image<T> picture(disparity().height, disparity().width);
    for (std::size_t i = 0; i < picture.size(); ++i) {
      picture.data()[i] = static_cast<T>(std::lround(number(disparity().data[i])));
    }
    io::write_png(path(name), picture.view());
  }
  void write_array(const std::string& name, ImageView<const float> map) const {
    const std::vector<float> values(map.data, map.data + map.size());
    io::write_npy<float>(
        path(name), {static_cast<std::size_t>(map.height), static_cast<std::size_t>(map.width)},
        values);
  }
  /// Of the center view, where both know the disparity; infinite if there is none.
  double error(const Scene& scene) const {
    if (!scene.truth->has_disparity()) return std::numeric_limits<double>::infinity();
    const DisparityView found = scene.truth->field.view(scene.light_field->grid().center());
    double largest = 0;
    for (int y = 0; y < disparity().height; ++y) {
      for (int x = 0; x < disparity().width; ++x) {
        if (!found.is_valid(y, x)) continue;
        const double difference = found.disparity.at(y, x) - disparity().at(y, x);
        largest = std::max(largest, std::abs(difference));
      }
    }
    return largest;
  }

 private slots:
  void init() {
    folder_ = std::make_unique<QTemporaryDir>();
    scene_ = plane_behind_square();
    write_views();
  }

  void integersOfCommonScale_areUnderstood_data() {
    QTest::addColumn<float>("scale");
    QTest::newRow("hundredths") << 100.0F;
    QTest::newRow("fixed point") << 256.0F;
  }
  void integersOfCommonScale_areUnderstood() {
    QFETCH(float, scale);
    use_positive_disparities();
    Image<float> map(disparity().height, disparity().width);
    std::transform(disparity().data, disparity().data + disparity().size(), map.data(),
                   [&](float d) { return std::round(scale * d); });
    write_array("disparity.npy", map.view());

    const Scene scene = open();

    QVERIFY2(error(scene) < 0.51 / scale, describe(scene.convention).c_str());
    QVERIFY(!warns_of(scene, "No known unit"));
  }

  void integersOfRareScale_areDoubted_data() {
    QTest::addColumn<float>("scale");
    QTest::newRow("64ths") << 64.0F;
    QTest::newRow("16ths") << 16.0F;
    QTest::newRow("part of 1") << 0.3F;
  }
  void integersOfRareScale_areDoubted() {
    QFETCH(float, scale);
    use_positive_disparities();
    Image<float> map(disparity().height, disparity().width);
    std::transform(disparity().data, disparity().data + disparity().size(), map.data(),
                   [&](float d) { return scale < 1 ? scale * d : std::round(scale * d); });
    write_array("disparity.npy", map.view());

    const Scene scene = open();

    QVERIFY2(warns_of(scene, "No known unit explains the views well"),
             describe(scene.convention).c_str());
  }

  /// Hundredths explain a good part of the views, too, and noise hides what they do not.
  void scaleNearAKnownOne_isDoubtedUnderNoise() {
    use_noisy_views();
    write_numbers([](double d) { return std::round(84 * d); });

    const Scene scene = open();

    QVERIFY2(warns_of(scene, "No known unit explains the views well"),
             describe(scene.convention).c_str());
    QVERIFY2(warns_of(scene, "--map-scale 0.01"), describe(scene.convention).c_str());
  }

  void normalizedDisparity_isDoubted_data() {
    QTest::addColumn<double>("white");
    QTest::newRow("0 to 1") << 1.0;
    QTest::newRow("0 to 255") << 255.0;
  }
  void normalizedDisparity_isDoubted() {
    QFETCH(double, white);
    const auto [least, most] =
        std::minmax_element(disparity().data, disparity().data + disparity().size());
    const double begin = *least, length = *most - *least;
    write_numbers([=](double d) { return white * (d - begin) / length; });

    const Scene scene = open();

    QVERIFY2(warns_of(scene, "normalized or shifted"), describe(scene.convention).c_str());
  }

  void rightValues_areNotDoubted() {
    use_noisy_views();
    write_numbers([](double d) { return d; });

    const Scene scene = open();

    QVERIFY2(!warns_of(scene, "No known unit"), describe(scene.convention).c_str());
  }

  void pictureWithoutAUnit_isLeftOut_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<QString>("what");
    QTest::newRow("disparity") << "disparity.png"
                               << "pictures of disparity, of unknown scale";
    QTest::newRow("depth") << "depth.png"
                           << "pictures of depth, of unknown scale";
  }
  /// A warning says how it can be used.
  void pictureWithoutAUnit_isLeftOut() {
    QFETCH(QString, name);
    QFETCH(QString, what);
    write_picture<std::uint16_t>(name.toStdString(), [](double d) { return 10000 * (d + 2); });

    const Scene scene = open();

    QVERIFY2(!scene.truth->has_disparity(), describe(scene.convention).c_str());
    QCOMPARE(count_unused(scene, what.toStdString()), 1);
    QVERIFY2(warns_of(scene, "save disparity in px per view step"),
             describe(scene.convention).c_str());
    QVERIFY2(has_same_samples(scene, scene_), scene.convention.order.c_str());
  }

  void coloursAreNoNumbers() {
    Image<std::uint8_t> picture(disparity().height, disparity().width, 3);
    for (std::size_t i = 0; i < picture.size(); ++i) {
      const double level = 60 * (disparity().data[i / 3] + 1.5);
      picture.data()[i] = static_cast<std::uint8_t>(i % 3 == 0 ? 255 - level : level);
    }
    io::write_png(path("disparity.png"), picture.view());

    const Scene scene = open();

    QVERIFY(!scene.truth->has_disparity());
    QCOMPARE(count_unused(scene, "pictures of disparity, of unknown scale"), 1);
  }

  /// A plane hides nothing.
  void signThatNothingTells_leavesTheViewsInOrder() {
    use_positive_disparities();
    Image<float> map(disparity().height, disparity().width);
    std::transform(disparity().data, disparity().data + disparity().size(), map.data(),
                   std::negate<>());
    write_array("disparity.npy", map.view());

    const Scene scene = open();

    QCOMPARE(error(scene), 0.0);
    QVERIFY2(has_same_samples(scene, scene_), scene.convention.order.c_str());
    QVERIFY2(scene.convention.units_check.find("no depth edges") != std::string::npos,
             scene.convention.units_check.c_str());
  }

  void zerosThatTheViewsContradict_areNotKnown() {
    use_positive_disparities();
    Image<float> map(disparity().height, disparity().width);
    std::copy_n(disparity().data, disparity().size(), map.data());
    for (int y = 20; y < 40; ++y) std::fill_n(map.row(y) + 30, 20, 0.0F);
    write_array("disparity.npy", map.view());

    const Scene scene = open();

    QCOMPARE(error(scene), 0.0);
    QVERIFY(!scene.truth->field.view({2, 2}).is_valid(30, 40));
    QVERIFY2(warns_of(scene, "which the views contradict"), describe(scene.convention).c_str());
  }

  void zerosAmongValuesOfBothSigns_areNotKnown_data() {
    QTest::addColumn<QString>("where");
    QTest::newRow("around the square") << "edges";
    QTest::newRow("in a block") << "block";
    QTest::newRow("at most pixels") << "scattered";
  }
  void zerosAmongValuesOfBothSigns_areNotKnown() {
    QFETCH(QString, where);
    write_views();
    Image<float> map(disparity().height, disparity().width);
    std::copy_n(disparity().data, disparity().size(), map.data());
    std::mt19937 random(1);
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) {
        const int outside = std::max({20 - x, x - 50, 16 - y, y - 46});
        const bool is_zero = where == "edges"   ? std::abs(outside) < 3
                             : where == "block" ? x > 56 && y > 10 && y < 40
                                                : random() % 10 < 7;
        if (is_zero) map.at(y, x) = 0;
      }
    }
    write_array("disparity.npy", map.view());

    const Scene scene = open();

    QVERIFY2(warns_of(scene, "which the views contradict"), describe(scene.convention).c_str());
    QVERIFY2(error(scene) < 1e-6, describe(scene.convention).c_str());
    QVERIFY2(has_same_samples(scene, scene_), scene.convention.order.c_str());
  }

  void surfaceOfOneValue_staysKnown_data() {
    QTest::addColumn<double>("value");
    QTest::newRow("0") << 0.0;
    QTest::newRow("-1") << -1.0;
  }
  void surfaceOfOneValue_staysKnown() {
    QFETCH(double, value);
    PlaneOptions options;
    options.d0 = value;
    options.slope_x = options.slope_y = 0;
    scene_ = plane_behind_square(options);
    write_views();
    write_array("disparity.npy", disparity());

    const Scene scene = open();

    QVERIFY2(!warns_of(scene, "which the views contradict"), describe(scene.convention).c_str());
    QVERIFY(scene.truth->field.view({2, 2}).is_valid(5, 5));
    QVERIFY2(error(scene) < 1e-6, describe(scene.convention).c_str());
  }

  void valueOfUnknownDisparity_isLeftOut_data() {
    QTest::addColumn<float>("unknown");
    QTest::addColumn<float>("factor");
    for (const float factor : {1.0F, 4.0F}) {
      QTest::addRow("too far, %.0f", factor) << -999.0F << factor;
      QTest::addRow("too near, %.0f", factor) << 1000.0F << factor;
      QTest::addRow("-1, %.0f", factor) << -1.0F << factor;
    }
  }
  /// Also where the values are those of the whole baseline of five views.
  void valueOfUnknownDisparity_isLeftOut() {
    QFETCH(float, unknown);
    QFETCH(float, factor);
    use_positive_disparities();
    Image<float> map(disparity().height, disparity().width);
    std::transform(disparity().data, disparity().data + disparity().size(), map.data(),
                   [&](float d) { return factor * d; });
    for (int y = 20; y < 40; ++y) std::fill_n(map.row(y) + 30, 20, unknown);
    write_array("disparity.npy", map.view());

    const Scene scene = open();

    QVERIFY2(error(scene) < 1e-6, describe(scene.convention).c_str());
    QVERIFY(!scene.truth->field.view({2, 2}).is_valid(30, 40));
    QVERIFY2(warns_of(scene, "which the views contradict"), describe(scene.convention).c_str());
  }

  void mirroredDisparity_isPutRight_data() {
    QTest::addColumn<float>("factor");
    QTest::newRow("px per view step") << 1.0F;
    QTest::newRow("of the whole baseline, nearer is smaller") << -4.0F;
  }
  void mirroredDisparity_isPutRight() {
    QFETCH(float, factor);
    Image<float> map(disparity().height, disparity().width);
    for (int y = 0; y < map.height(); ++y) {
      std::transform(disparity().row(y), disparity().row(y) + map.width(), map.row(y),
                     [&](float d) { return factor * d; });
      std::reverse(map.row(y), map.row(y) + map.width());
    }
    write_array("disparity.npy", map.view());

    const Scene scene = open();

    QVERIFY2(error(scene) < 1e-6, describe(scene.convention).c_str());
    QVERIFY2(has_same_samples(scene, scene_), scene.convention.order.c_str());
    QVERIFY2(warns_of(scene, "columns from right to left"), describe(scene.convention).c_str());
  }

  void mapWithoutItsBorder_isPutIntoTheMiddle() {
    Image<float> map(disparity().height - 8, disparity().width - 8);
    for (int y = 0; y < map.height(); ++y) {
      std::copy_n(disparity().row(y + 4) + 4, map.width(), map.row(y));
    }
    write_array("disparity.npy", map.view());

    const Scene scene = open();

    QCOMPARE(error(scene), 0.0);
    const DisparityView found = scene.truth->field.view({2, 2});
    QVERIFY(found.is_valid(4, 4) && !found.is_valid(3, 40) && !found.is_valid(40, 3));
    QVERIFY2(warns_of(scene, "taken for the middle"), describe(scene.convention).c_str());
  }
};

}  // namespace episcope::in_unknown_unit_test

EPISCOPE_TEST(unknown_unit_test, UnknownUnitTest)
#include "unknown_unit_test.moc"
