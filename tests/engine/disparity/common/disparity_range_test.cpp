// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/disparity_range.h"

#include "engine/core/error.h"
#include "engine/disparity/registry.h"
#include "engine/disparity/structure_tensor.h"
#include "engine/scenes/builtin.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stop_token>

namespace episcope::in_disparity_range_test {

using namespace episcope::test;

namespace {

Interval true_range(const Scene& scene) {
  const DisparityView truth = scene.truth->field.view(scene.light_field->center());
  Interval range{1e9, -1e9};
  for (int y = 0; y < truth.disparity.height; ++y) {
    for (int x = 0; x < truth.disparity.width; ++x) {
      if (!truth.is_valid(y, x)) continue;
      range.min = std::min<double>(range.min, truth.disparity.at(y, x));
      range.max = std::max<double>(range.max, truth.disparity.at(y, x));
    }
  }
  return range;
}

// Of the pixels of the centre view.
double share_within(const Scene& scene, Interval range) {
  const DisparityView truth = scene.truth->field.view(scene.light_field->center());
  int count = 0;
  for (int y = 0; y < truth.disparity.height; ++y) {
    for (int x = 0; x < truth.disparity.width; ++x) {
      const float d = truth.disparity.at(y, x);
      if (d >= range.min && d <= range.max) ++count;
    }
  }
  return static_cast<double>(count) / static_cast<double>(truth.disparity.size());
}

// What is wanted of every range found.
bool is_narrow(const Interval& found, const Interval& truth) {
  return found.length() <= 1.25 * truth.length() + 0.3;
}

// How far beyond the truth an end may lie. Thin bars far in front hide parts of blocks of the wall,
// which then match farther away than it is.
double most_beyond(const QString& id, double scale, double usual) {
  return id == "bars" && scale > 2 ? 1.3 : usual;
}

QString text(const Interval& range) {
  return QString("[%1, %2]").arg(range.min).arg(range.max);
}

LightField with_promised_range(const Scene& scene, Interval promised) {
  LightFieldInfo info;
  info.disparity_range = promised;
  return {float_samples(*scene.light_field), info};
}

}  // namespace

class DisparityRangeTest : public QObject {
  Q_OBJECT

 private slots:
  void foundRange_holdsTheTruth_data();
  void foundRange_holdsTheTruth();
  void foundRange_ofWideBaselines_data();
  void foundRange_ofWideBaselines();
  void foundRange_leavesOutAliases();
  void foundRange_ofRandomScenes_data();
  void foundRange_ofRandomScenes();
  void foundRange_ofNothingButAPattern();
  void foundRange_ofOneRowOfCameras();
  void foundRange_holdsWhatIsSeenBadly();
  void foundRange_withoutTextureIsDefault();
  void foundRange_isTheSameForAnyThreadCount();
  void foundRange_ofSmallLightFieldIsFinite();
  void wantedRange_goesFirst();
  void promisedRange_goesBeforeFound();
  void rangeToBeFound_ignoresThePromise();
  void note_tellsOfARangeToBeFound();
  void note_tellsOfARangeThatEndsAtTheLimit();
  void note_tellsOfARangeThatHoldsNothing();
  void note_tellsWhereNothingMatches();
  void foundRange_ofGridTooLargeIsRefused();
  void stop_throwsCancelled();
  void coveringShears_reachEveryDisparity_data();
  void coveringShears_reachEveryDisparity();
};

void DisparityRangeTest::foundRange_holdsTheTruth_data() {
  QTest::addColumn<QString>("id");
  QTest::addColumn<double>("scale");
  QTest::addColumn<double>("noise");
  for (const double scale : {0.5, 1.0, 2.0, 3.5}) {
    QTest::addRow("slant %g", scale) << "slant" << scale << 0.0;
    QTest::addRow("edge %g", scale) << "edge" << scale << 0.0;
    QTest::addRow("bars %g", scale) << "bars" << scale << 0.0;
  }
  for (const double scale : {0.5, 2.0}) {
    QTest::addRow("objects %g", scale) << "objects" << scale << 0.0;
    QTest::addRow("demo %g", scale) << "demo" << scale << 0.0;
  }
  QTest::newRow("slant 1, noisy") << "slant" << 1.0 << 2.0;
  QTest::newRow("edge 2, noisy") << "edge" << 2.0 << 2.0;
  QTest::newRow("slant 1, very noisy") << "slant" << 1.0 << 10.0;
  QTest::newRow("edge 2, very noisy") << "edge" << 2.0 << 10.0;
}

void DisparityRangeTest::foundRange_holdsTheTruth() {
  QFETCH(QString, id);
  QFETCH(double, scale);
  QFETCH(double, noise);
  const Scene scene = render(id.toStdString(), 80, 96, {5, 5}, scale, noise);
  const Interval truth = true_range(scene);
  const Interval found = find_disparity_range(*scene.light_field, Progress());
  const QString both = text(found) + " for " + text(truth);
  // Of 0.2 % of the pixels, the ends may miss a corner of the slant.
  constexpr double missed = 0.02;
  QVERIFY2(found.min <= truth.min + missed && found.max >= truth.max - missed, qPrintable(both));
  // Each additional shear costs time and gives noise another chance.
  const double wide = most_beyond(id, scale, 0.6);
  QVERIFY2(found.min >= truth.min - wide && found.max <= truth.max + wide, qPrintable(both));
  QVERIFY2(is_narrow(found, truth), qPrintable(both));
}

void DisparityRangeTest::foundRange_ofWideBaselines_data() {
  QTest::addColumn<QString>("id");
  QTest::addColumn<int>("views");
  QTest::addColumn<double>("scale");
  QTest::addColumn<double>("noise");
  // Disparities of up to 7 and 14 px.
  for (const int views : {5, 9, 17}) {
    QTest::addRow("bars to 7, %d views", views) << "bars" << views << 10.0 << 0.0;
    QTest::addRow("slant to 7, %d views", views) << "slant" << views << 7.0 << 3.0;
    QTest::addRow("edge to 14, %d views", views) << "edge" << views << 17.5 << 3.0;
  }
  QTest::newRow("demo to 7, 9 views") << "demo" << 9 << 5.0 << 3.0;
  QTest::newRow("demo to 14, 9 views") << "demo" << 9 << 9.5 << 3.0;
}

void DisparityRangeTest::foundRange_ofWideBaselines() {
  QFETCH(QString, id);
  QFETCH(int, views);
  QFETCH(double, scale);
  QFETCH(double, noise);
  const Scene scene = render(id.toStdString(), 112, 128, {views, views}, scale, noise);
  const Interval truth = true_range(scene);

  const Interval found = find_disparity_range(*scene.light_field, Progress());

  const QString both = text(found) + " for " + text(truth);
  // Of 0.2 % of the pixels, the ends may miss a tip.
  const double missed = 0.03 * truth.length(), wide = most_beyond(id, scale, 0.7);
  QVERIFY2(found.min <= truth.min + missed && found.max >= truth.max - missed, qPrintable(both));
  QVERIFY2(found.min >= truth.min - wide && found.max <= truth.max + wide, qPrintable(both));
  QVERIFY2(is_narrow(found, truth), qPrintable(both));
}

// A fabric of 7.5 px per thread on one half, at d = 1: three views of a row would match at −6.5,
// too.
void DisparityRangeTest::foundRange_leavesOutAliases() {
  const LightField lf =
      make_light_field({9, 9}, 120, 120, 1, [](ViewIndex view, int y, int x, int) {
        const double px = x + view.u - 4, py = y + view.v - 4;
        const double fabric = std::sin(2 * M_PI * px / 7.5) * std::sin(2 * M_PI * py / 7.5);
        const double other = std::sin(0.61 * px) + std::sin(0.53 * py + 0.2 * px);
        const double slow = std::sin(0.05 * px + 0.04 * py);
        return static_cast<float>(0.5 + 0.03 * slow + 0.15 * (y < 60 ? fabric : other));
      });

  const Interval found = find_disparity_range(lf, Progress());

  QVERIFY2(found.min > 0 && found.min < 1 && found.max > 1 && found.max < 2,
           qPrintable(text(found)));
}

// Aliases of faint textures and of noise, and what only smaller views show: a dark or defocused
// background under noise.
void DisparityRangeTest::foundRange_ofRandomScenes_data() {
  QTest::addColumn<QString>("request");
  for (const char* request :
       {"random?seed=5&kind=dark&size=128&grid=3x3", "random?seed=19&size=160&grid=3x3",
        "random?seed=69&kind=uneven&size=192&grid=9x9&noise=5",
        "random?seed=77&kind=dark&size=256&grid=1x9&noise=10",
        "random?seed=7&kind=thin&size=192&grid=5x5"}) {
    QTest::newRow(request) << request;
  }
}

void DisparityRangeTest::foundRange_ofRandomScenes() {
  QFETCH(QString, request);
  const scenes::BuiltinRequest read = scenes::read_request(request.toStdString());
  const Scene scene = scenes::render_builtin(read.scene, read.options, Progress());
  const Interval truth = true_range(scene);

  const Interval found = find_disparity_range(*scene.light_field, Progress());

  const QString both = text(found) + " for " + text(truth);
  const double wide = 1;
  QVERIFY2(share_within(scene, {found.min - 0.3, found.max + 0.3}) > 0.995, qPrintable(both));
  QVERIFY2(found.min >= truth.min - wide && found.max <= truth.max + wide, qPrintable(both));
}

// Nothing but a fabric of 7.5 px per thread, at d = 1: no pixel matches one label alone.
void DisparityRangeTest::foundRange_ofNothingButAPattern() {
  const LightField lf = make_light_field({5, 5}, 96, 96, 1, [](ViewIndex view, int y, int x, int) {
    const double px = x + view.u - 2, py = y + view.v - 2;
    return static_cast<float>(0.5 +
                              0.2 * std::sin(2 * M_PI * px / 7.5) * std::sin(2 * M_PI * py / 7.5));
  });

  const Interval found = find_disparity_range(lf, Progress());

  QVERIFY2(found.min < 1 && found.max > 1, qPrintable(text(found)));
}

// The first and last columns, which hold the ends of the slant, are left by the lines that would
// show them: 5 px of 96, or 0.2 px of disparity, may be missed.
void DisparityRangeTest::foundRange_ofOneRowOfCameras() {
  const Scene scene = render("slant", 64, 96, {1, 9}, 2);
  const Interval found = find_disparity_range(*scene.light_field, Progress());
  QVERIFY2(found.min <= -1.8 && found.min > -2.6 && found.max >= 1.8 && found.max < 2.6,
           qPrintable(text(found)));
}

// A rich plane at 0, and a near strip of weak texture under noise (7 % of the pixels, d = 1.5).
void DisparityRangeTest::foundRange_holdsWhatIsSeenBadly() {
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0, 0.015F);
  const LightField lf =
      make_light_field({9, 9}, 128, 128, 1, [&](ViewIndex view, int y, int x, int) {
        const bool near = y >= 119;
        const double d = near ? 1.5 : 0, px = x + d * (view.u - 4), py = y + d * (view.v - 4);
        const double texture =
            std::sin(0.5 * px) + std::sin(0.47 * py) + std::sin(0.31 * px + 0.2 * py);
        return static_cast<float>(0.5 + (near ? 0.05 : 0.15) * texture) + noise(random);
      });

  const Interval found = find_disparity_range(lf, Progress());

  QVERIFY2(found.max >= 1.5 && found.max < 2.1 && found.min > -0.6, qPrintable(text(found)));
}

void DisparityRangeTest::foundRange_withoutTextureIsDefault() {
  const LightField lf =
      make_light_field({5, 5}, 32, 40, 1, [](ViewIndex, int, int, int) { return 0.7F; });
  QCOMPARE(find_disparity_range(lf, Progress()), (Interval{-1, 1}));
}

void DisparityRangeTest::foundRange_isTheSameForAnyThreadCount() {
  const Scene scene = render("objects", 80, 90, {5, 5});
  QCOMPARE(find_disparity_range(*scene.light_field, Progress(1)),
           find_disparity_range(*scene.light_field, Progress(4)));
}

void DisparityRangeTest::foundRange_ofSmallLightFieldIsFinite() {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> sample;
  const LightField lf =
      make_light_field({3, 3}, 7, 5, 3, [&](ViewIndex, int, int, int) { return sample(random); });
  const Interval found = find_disparity_range(lf, Progress());
  QVERIFY(found.min < found.max && found.min >= -5 && found.max <= 5);
}

void DisparityRangeTest::wantedRange_goesFirst() {
  const Scene scene = render("fronto", 32, 32, {3, 3});
  const LightField lf = with_promised_range(scene, {-0.25, 0.75});
  QCOMPARE(search_range(lf, Interval{-3, 2}, Progress()), (Interval{-3, 2}));
}

void DisparityRangeTest::promisedRange_goesBeforeFound() {
  const Scene scene = render("fronto", 48, 48, {5, 5});
  QCOMPARE(search_range(with_promised_range(scene, {-2.5, 3.5}), {}, Progress()),
           (Interval{-2.5, 3.5}));
  const Interval found = search_range(*scene.light_field, {}, Progress());
  QVERIFY2(found.min < 0.37 && found.max > 0.37 && found.length() < 1, qPrintable(text(found)));
}

void DisparityRangeTest::rangeToBeFound_ignoresThePromise() {
  const Scene scene = render("fronto", 48, 48, {5, 5});
  const LightField lf = with_promised_range(scene, {-2.5, 3.5});

  QCOMPARE(search_range(lf, IntervalOrAuto::found(), Progress()),
           find_disparity_range(lf, Progress()));
}

void DisparityRangeTest::note_tellsOfARangeToBeFound() {
  const Scene scene = render("fronto", 48, 48, {5, 5});
  const LightField promising = with_promised_range(scene, {-0.5, 1});
  const auto is_noted = [](const LightField& lf, const IntervalOrAuto& range) {
    const Estimate estimate = find_estimator("st_ch_l").run(lf, {{"range", range}}, {}, Progress());
    return std::ranges::count(estimate.notes, found_range_note(estimate.range)) == 1;
  };

  QVERIFY(!is_noted(promising, Interval{-1, 1.5}));
  QVERIFY(!is_noted(promising, {}));
  QVERIFY(is_noted(promising, IntervalOrAuto::found()));
  QVERIFY(is_noted(*scene.light_field, IntervalOrAuto::found()));
}

void DisparityRangeTest::note_tellsOfARangeThatEndsAtTheLimit() {
  const Scene near = render("fronto", 36, 36, {5, 5}, 16);  // at 5.92 px; the limit is 6
  const Scene usual = render("fronto", 36, 36, {5, 5});
  QCOMPARE(farthest_found(*near.light_field), 6.0);
  const auto notes = [](const Scene& scene, const IntervalOrAuto& range) {
    const Estimate estimate =
        find_estimator("st_ch_l").run(*scene.light_field, {{"range", range}}, {}, Progress());
    return std::ranges::count(estimate.notes,
                              limited_range_note(*scene.light_field, estimate.range));
  };

  QCOMPARE(notes(near, {}), 1);
  QCOMPARE(notes(near, IntervalOrAuto::found()), 1);
  QCOMPARE(notes(near, Interval{-6, 6}), 0);
  QCOMPARE(notes(usual, IntervalOrAuto::found()), 0);
}

void DisparityRangeTest::note_tellsOfARangeThatHoldsNothing() {
  const Scene scene = render("slant", 64, 64, {5, 5});  // -1 … 1 px
  const auto is_told = [&scene](Interval range) {
    const Estimate estimate =
        find_estimator("st_ch_l").run(*scene.light_field, {{"range", range}}, {}, Progress());
    return std::ranges::any_of(estimate.notes, [](const std::string& note) {
      return note.starts_with("Nothing matches at disparities of");
    });
  };

  QVERIFY(is_told({3, 4}));
  QVERIFY(is_told({-4, -3}));
  QVERIFY(!is_told({0.5, 4}));
  QVERIFY(!is_told({-4, 4}));
}

void DisparityRangeTest::note_tellsWhereNothingMatches() {
  const LightField lf =
      make_light_field({5, 5}, 32, 40, 1, [](ViewIndex, int, int, int) { return 0.7F; });
  const Estimate estimate = find_estimator("plane_pm").run(lf, {}, {}, Progress());
  const auto is_told = [&estimate](const std::string& text) {
    return std::ranges::any_of(estimate.notes, [&text](const std::string& note) {
      return note.find(text) != std::string::npos;
    });
  };
  QVERIFY(is_told("are guesses"));
  QVERIFY(!is_told("nan"));
}

void DisparityRangeTest::foundRange_ofGridTooLargeIsRefused() {
  const LightField lf =
      make_light_field({1, 161}, 8, 8, 1, [](ViewIndex, int, int, int) { return 0.5F; });
  QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)find_disparity_range(lf, Progress()));
}

void DisparityRangeTest::stop_throwsCancelled() {
  const Scene scene = render("fronto", 32, 32, {3, 3});
  std::stop_source source;
  source.request_stop();
  const Progress progress(source.get_token(), nullptr);
  QVERIFY_THROWS_EXCEPTION(Cancelled, (void)find_disparity_range(*scene.light_field, progress));
}

void DisparityRangeTest::coveringShears_reachEveryDisparity_data() {
  QTest::addColumn<double>("min");
  QTest::addColumn<double>("max");
  QTest::addColumn<int>("step");
  for (const int step : {1, 2, 3, 4}) {
    QTest::addRow("symmetric, %d", step) << -1.0 << 1.0 << step;
    QTest::addRow("between, %d", step) << 0.3 << 0.4 << step;
    QTest::addRow("far, %d", step) << 2.1 << 4.7 << step;
    QTest::addRow("negative, %d", step) << -4.9 << -0.1 << step;
  }
}

void DisparityRangeTest::coveringShears_reachEveryDisparity() {
  QFETCH(double, min);
  QFETCH(double, max);
  QFETCH(int, step);
  const TensorSearch search = cover_range({min, max}, step);
  QVERIFY(!search.half_step_shears.empty());
  for (double d = min; d <= max; d += 0.01) {
    const bool covered =
        std::any_of(search.half_step_shears.begin(), search.half_step_shears.end(),
                    [&](int shear) { return std::fabs(d - 0.5 * shear) <= search.limit; });
    QVERIFY2(covered, qPrintable(QString::number(d)));
  }
  for (const int shear : search.half_step_shears) QCOMPARE(shear % step, 0);
}

}  // namespace episcope::in_disparity_range_test

EPISCOPE_TEST(disparity_range_test, DisparityRangeTest)
#include "disparity_range_test.moc"
