// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/models/better_reading.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace episcope::in_map_reading_test {

using namespace episcope::test;
using io::MapCrop;
using io::MapFlip;
using io::MapReading;
using io::MapValues;

constexpr int kSide = 64;
constexpr int kBorder = 6;

/// Maps that a person wrote or read in another way than they were meant.
class MapReadingTest : public QObject {
  Q_OBJECT

 private:
  Scene scene_ = plane_scene({.width = kSide, .slope_x = 0.03, .slope_y = -0.02});

  [[nodiscard]] ViewIndex center() const { return scene_.light_field->center(); }
  [[nodiscard]] DisparityView truth() const { return scene_.truth->field.view(center()); }

  /// The map of the center view with `value_at(y, x)`.
  [[nodiscard]] Estimate map_of(const std::function<double(int y, int x)>& value_at) const {
    Estimate estimate;
    estimate.field.disparity = ViewStack<float>({1, 1}, kSide, kSide, 1, center());
    const auto map = estimate.field.disparity.view(center());
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) map.at(y, x) = static_cast<float>(value_at(y, x));
    }
    return estimate;
  }
  /// The truth with errors that an estimate has, as it is before it is spoilt.
  [[nodiscard]] double good(int y, int x) const {
    return truth().disparity.at(y, x) + 0.02 * ((7 * x + 3 * y) % 5 - 2);
  }

  /// What a person did to a good map by mistake, so that `reading` is right.
  [[nodiscard]] Estimate spoilt(const MapReading& reading) const {
    const CameraGrid& camera = scene_.light_field->info().camera;
    return map_of([&](int y, int x) {
      int row = reading.is_transposed ? x : y;
      int column = reading.is_transposed ? y : x;
      if (reading.flip == MapFlip::Y || reading.flip == MapFlip::Both) row = kSide - 1 - row;
      if (reading.flip == MapFlip::X || reading.flip == MapFlip::Both) column = kSide - 1 - column;
      row += reading.border_px;
      column += reading.border_px;
      if (std::max(row, column) >= kSide - reading.border_px) return 0.0;
      const double d = good(row, column);
      return (reading.values == MapValues::Depth ? camera.depth_from_disparity(d) : d) /
             reading.scale;
    });
  }

  [[nodiscard]] std::optional<io::BetterReading> better(const Estimate& estimate,
                                                        bool has_truth) const {
    io::MapEvidence evidence{*scene_.light_field, center()};
    if (has_truth) evidence.truth = truth();
    return io::find_better_reading(estimate.field.view(center()), evidence);
  }

  [[nodiscard]] double error_of(const Estimate& estimate) const {
    double largest = 0;
    const DisparityView map = estimate.field.view(center());
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        if (!map.is_valid(y, x)) continue;
        const double error = map.disparity.at(y, x) - truth().disparity.at(y, x);
        largest = std::max(largest, std::abs(error));
      }
    }
    return largest;
  }

  static void add_mistakes(bool has_truth) {
    QTest::addColumn<MapReading>("mistake");
    QTest::newRow("transposed") << MapReading{.is_transposed = true};
    QTest::newRow("upside down") << MapReading{.flip = MapFlip::Y};
    QTest::newRow("mirrored") << MapReading{.flip = MapFlip::X};
    QTest::newRow("upside down and mirrored") << MapReading{.flip = MapFlip::Both};
    QTest::newRow("turned by 90°") << MapReading{.is_transposed = true, .flip = MapFlip::Y};
    QTest::newRow("negated") << MapReading{.scale = -1};
    QTest::newRow("hundredths") << MapReading{.scale = 0.01};
    QTest::newRow("sixteenths") << MapReading{.scale = 1.0 / 16};
    QTest::newRow("widths of the image") << MapReading{.scale = kSide};
    QTest::newRow("depth") << MapReading{.values = MapValues::Depth};
    QTest::newRow("transposed and negated") << MapReading{.is_transposed = true, .scale = -1};
    QTest::newRow("without a border") << MapReading{.border_px = kBorder};
    if (!has_truth) return;
    QTest::newRow("depth in thousandths") << MapReading{.scale = 0.001, .values = MapValues::Depth};
    QTest::newRow("transposed hundredths") << MapReading{.is_transposed = true, .scale = 0.01};
    QTest::newRow("mirrored depth") << MapReading{.flip = MapFlip::X, .values = MapValues::Depth};
  }

 private slots:
  void mistakes_areSeenByTheTruth_data() { add_mistakes(true); }
  void mistakes_areSeenByTheTruth() {
    QFETCH(MapReading, mistake);
    Estimate estimate = spoilt(mistake);

    const auto found = better(estimate, true);

    QVERIFY(found.has_value());
    QCOMPARE(QString::fromStdString(io::reading_text(found->reading)),
             QString::fromStdString(io::reading_text(mistake)));
    QVERIFY(*found->better.mse_100 < 0.1);
    QVERIFY(*found->as_read.mse_100 > 4 * *found->better.mse_100);  // half of the errors
    QVERIFY(!found->is_contradicted());
    io::apply_reading(found->reading, scene_.light_field.get(), estimate);
    QVERIFY(error_of(estimate) < 0.05);
    QCOMPARE(estimate.border_px, mistake.border_px);
    QVERIFY(!better(estimate, true));
  }

  void mistakes_areSeenByTheViewsAlone_data() { add_mistakes(false); }
  void mistakes_areSeenByTheViewsAlone() {
    QFETCH(MapReading, mistake);

    const auto found = better(spoilt(mistake), false);

    QVERIFY(found.has_value());
    QCOMPARE(QString::fromStdString(io::reading_text(found->reading)),
             QString::fromStdString(io::reading_text(mistake)));
    QVERIFY(!found->better.mse_100.has_value() && found->better.grey_levels.has_value());
  }

  void mapsOffTheirPlace_areSeenByTheTruth_data() {
    QTest::addColumn<int>("down");
    QTest::addColumn<int>("right");
    QTest::newRow("up and left") << 4 << 4;
    QTest::newRow("down") << -3 << 0;
    QTest::newRow("as far as is looked") << 16 << -16;
  }
  void mapsOffTheirPlace_areSeenByTheTruth() {
    QFETCH(int, down);
    QFETCH(int, right);
    const auto uneven = [](int y, int x) {
      return std::sin(0.21 * x) + std::cos(0.17 * y + 0.1 * x);
    };
    const Estimate whole = map_of(uneven);
    Estimate moved =
        map_of([&](int y, int x) { return uneven(y + down, x + right) + 0.01 * (x % 3); });
    io::MapEvidence evidence{*scene_.light_field, center()};
    evidence.truth = whole.field.view(center());

    const auto found = io::find_better_reading(moved.field.view(center()), evidence);

    QVERIFY(found.has_value());
    QVERIFY((found->reading == MapReading{.down_px = down, .right_px = right}));
    io::apply_reading(found->reading, scene_.light_field.get(), moved);
    const DisparityView put = moved.field.view(center());
    QVERIFY(std::abs(put.disparity.at(32, 32) - uneven(32, 32)) < 0.03);
    QVERIFY(!put.is_valid(down > 0 ? 0 : kSide - 1, 32));
    QCOMPARE(moved.border_px, std::max(std::abs(down), std::abs(right)));
  }

  void honestMaps_areLeftAlone_data() {
    QTest::addColumn<int>("kind");
    QTest::newRow("good") << 0;
    QTest::newRow("constant") << 1;
    QTest::newRow("noisy") << 2;
    QTest::newRow("too flat") << 3;
    QTest::newRow("too near") << 4;
  }
  void honestMaps_areLeftAlone() {
    QFETCH(int, kind);
    const Estimate estimate = map_of([&](int y, int x) {
      if (kind == 0) return good(y, x);
      if (kind == 1) return 0.3;
      if (kind == 2) return good(y, x) + 0.8 * ((13 * x + 29 * y) % 11 - 5) / 5.0;
      if (kind == 3) return 0.3 + 0.7 * (good(y, x) - 0.3);
      return good(y, x) + 0.15;
    });

    QVERIFY(!better(estimate, true));
    QVERIFY(!better(estimate, false));
  }

  void mapsThatExplainLittle_areTold_data() {
    QTest::addColumn<int>("kind");
    QTest::addColumn<bool>("is_poor");
    QTest::newRow("good") << 0 << false;
    QTest::newRow("constant") << 1 << true;
    QTest::newRow("of another scene") << 2 << true;
    QTest::newRow("of an unusual scale") << 3 << true;
    QTest::newRow("a little too flat") << 4 << false;
    QTest::newRow("good, few outliers") << 5 << false;
    QTest::newRow("missing in most pixels") << 6 << false;
  }
  void mapsThatExplainLittle_areTold() {
    QFETCH(int, kind);
    QFETCH(bool, is_poor);
    Estimate estimate = map_of([&](int y, int x) {
      if (kind == 1) return 0.3;
      if (kind == 2) return 0.02 * ((13 * x + 29 * y) % 101);
      if (kind == 3) return 3.7 * good(y, x);
      if (kind == 4) return 0.3 + 0.7 * (good(y, x) - 0.3);
      return good(y, x) + (kind == 5 && (x + y) % 50 == 0 ? 9 : 0);
    });
    if (kind == 6) {
      estimate.field.valid = ViewStack<std::uint8_t>({1, 1}, kSide, kSide, 1, center());
    }

    const auto fit = io::find_poor_fit(estimate.field.view(center()), truth());

    QCOMPARE(fit.has_value(), is_poor);
    QVERIFY(!fit || fit->mse_100 > 0.5 * fit->constant_mse_100);
  }

  /// Other programs write a number where they know nothing, some of them within the range.
  void valuesForNoEstimate_areSeenByTheTruth_data() {
    QTest::addColumn<double>("value");
    QTest::addColumn<MapReading>("mistake");
    QTest::newRow("0") << 0.0 << MapReading{.missing = "0"};
    QTest::newRow("-1") << -1.0 << MapReading{.missing = "-1"};
    QTest::newRow("9999") << 9999.0 << MapReading{.missing = "9999"};
    QTest::newRow("hundredths, -32768")
        << -32768.0 << MapReading{.scale = 0.01, .missing = "-32768"};
    QTest::newRow("mirrored, 1e10") << 1e10 << MapReading{.flip = MapFlip::X, .missing = "1e+10"};
  }
  void valuesForNoEstimate_areSeenByTheTruth() {
    QFETCH(double, value);
    QFETCH(MapReading, mistake);
    Estimate estimate = spoilt(mistake);
    const auto map = estimate.field.disparity.view(center());
    for (int i = 0; i < kSide; ++i) map.at((7 * i) % kSide, (11 * i + 5) % kSide / 4) = value;

    const auto found = better(estimate, true);

    QVERIFY(found.has_value());
    QCOMPARE(QString::fromStdString(io::reading_text(found->reading)),
             QString::fromStdString(io::reading_text(mistake)));
    QVERIFY(*found->better.mse_100 < 0.1);
    QVERIFY(*found->as_read.mse_100 > 2 * *found->better.mse_100);
    io::apply_reading(found->reading, scene_.light_field.get(), estimate);
    const auto left_out = std::count(estimate.field.valid.data(),
                                     estimate.field.valid.data() + estimate.field.valid.size(), 0);
    // A few good pixels have the value by chance.
    QVERIFY(left_out >= kSide && left_out < kSide + 8);
    QVERIFY(!better(estimate, true));
  }

  /// A value that many pixels have may be right, or the end of a range.
  void valuesOfManyPixels_areNotDoubtedWhereTheyFit() {
    const Estimate quantized =
        map_of([&](int y, int x) { return std::round(10 * good(y, x)) / 10; });
    const Estimate cut = map_of([&](int y, int x) { return std::max(good(y, x), -0.2); });

    QVERIFY(!better(quantized, true));
    QVERIFY(!better(cut, true));
  }

  /// Where truth and views do not agree, the truth may be the one that is wrong.
  void views_speakAgainstAWrongTruth() {
    const Estimate right = spoilt({});
    Estimate turned = spoilt({.is_transposed = true});

    const auto found = io::find_better_reading(
        right.field.view(center()), {*scene_.light_field, center(), turned.field.view(center())});

    QVERIFY(found.has_value());
    QVERIFY(found->reading.is_transposed);
    QVERIFY(found->is_contradicted());
  }

  void oblongMaps_changeTheirSides() {
    Estimate estimate;
    estimate.field.disparity = ViewStack<float>({1, 1}, 3, 2, 1, {2, 2});
    std::iota(estimate.field.disparity.data(), estimate.field.disparity.data() + 6, 0.0F);
    estimate.confidence = estimate.field.disparity.clone();

    io::apply_reading({.is_transposed = true, .scale = 10}, nullptr, estimate);

    QCOMPARE(estimate.field.disparity.height(), 2);
    QCOMPARE(estimate.field.disparity.view({2, 2}).at(1, 2), 50.0F);
    QCOMPARE(estimate.confidence.view({2, 2}).at(1, 2), 5.0F);
  }

  void partOfPaddedMaps_isThatOfTheViews_data() {
    QTest::addColumn<MapCrop>("crop");
    QTest::addColumn<int>("above");
    QTest::addColumn<int>("left");
    QTest::newRow("corner") << MapCrop::Corner << 0 << 0;
    QTest::newRow("middle") << MapCrop::Middle << 3 << 5;
  }
  void partOfPaddedMaps_isThatOfTheViews() {
    QFETCH(MapCrop, crop);
    QFETCH(int, above);
    QFETCH(int, left);
    const LightField& views = *scene_.light_field;
    Estimate estimate;
    estimate.field.disparity = ViewStack<float>({1, 1}, views.height() + 6, views.width() + 10);
    std::iota(estimate.field.disparity.data(),
              estimate.field.disparity.data() + estimate.field.disparity.size(), 1.0F);
    const float first = estimate.field.disparity.view({0, 0}).at(above, left);

    io::apply_reading({.crop = crop}, &views, estimate);

    QCOMPARE(estimate.field.disparity.height(), views.height());
    QCOMPARE(estimate.field.disparity.width(), views.width());
    QCOMPARE(estimate.field.disparity.view({0, 0}).at(0, 0), first);
    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             io::apply_reading({.border_px = 1, .crop = crop}, nullptr, estimate));
  }

  void mapsOfAnotherResolution_fillTheViews() {
    const LightField& views = *scene_.light_field;
    for (const int factor : {2, -2}) {
      Estimate estimate;
      const int side = factor > 0 ? kSide * factor : kSide / -factor;
      estimate.field.disparity = ViewStack<float>({1, 1}, side, side, 1, center());
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
          estimate.field.disparity.view(center()).at(y, x) =
              static_cast<float>(good(y * kSide / side, x * kSide / side));
        }
      }

      io::apply_reading({.is_resized = true}, &views, estimate);

      QCOMPARE(estimate.field.disparity.height(), kSide);
      QCOMPARE(estimate.field.disparity.width(), kSide);
      QVERIFY2(error_of(estimate) < 0.15, qPrintable(QString::number(error_of(estimate))));
    }
    Estimate estimate = spoilt({});
    QVERIFY_THROWS_EXCEPTION(
        InvalidInput, io::apply_reading({.border_px = 1, .is_resized = true}, &views, estimate));
  }

  void impossibleReadings_areRefused() {
    Estimate estimate = spoilt({});

    for (const MapReading& reading :
         {MapReading{.scale = 0}, MapReading{.values = MapValues::Depth},
          MapReading{.border_px = 1}, MapReading{.missing = "-1,none"},
          MapReading{.is_resized = true}}) {
      QVERIFY_THROWS_EXCEPTION(InvalidInput, io::apply_reading(reading, nullptr, estimate));
    }
  }

  void givenOptions_areReadBack() {
    const MapReading reading{.is_transposed = true,
                             .flip = MapFlip::X,
                             .scale = -0.01,
                             .values = MapValues::Depth,
                             .border_px = 3,
                             .down_px = -2,
                             .right_px = 5,
                             .crop = MapCrop::Middle,
                             .missing = "0,-1",
                             .is_resized = true};

    QVERIFY(io::given_options(MapReading{}).empty());
    QVERIFY(io::map_schema().parse(io::given_options(reading)) == reading);
  }
};

}  // namespace episcope::in_map_reading_test

EPISCOPE_TEST(map_reading_test, MapReadingTest)
#include "map_reading_test.moc"
