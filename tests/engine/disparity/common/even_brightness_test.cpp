// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/view_gain.h"

#include "engine/core/error.h"
#include "engine/disparity/registry.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>

namespace episcope::in_even_brightness_test {

using namespace episcope::test;

namespace {

// 1 − 0.05·(u − 2) + 0.03·(v − 2): of every view another, of the middle one 1.
double gain_of(ViewIndex view) {
  return 1 - 0.05 * (view.u - 2) + 0.03 * (view.v - 2);
}

LightField uneven(const LightField& lf) {
  const ViewStack<float> samples = float_samples(lf);
  return like(lf, [&](ViewIndex view, int y, int x, int c) {
    return static_cast<float>(0.8 * gain_of(view) * samples.view(view).at(y, x, c));
  });
}

double mean_of(const LightField& lf, ViewIndex view) {
  const Image<float> samples = lf.view_as_float(view);
  double sum = 0;
  for (const float sample : samples) sum += sample;
  return sum / static_cast<double>(samples.size());
}

Estimate run(const LightField& lf, const char* method) {
  return find_estimator(method).run(lf, {{"range", IntervalOrAuto(Interval{-1.2, 1.2})}},
                                    {.views = ViewSelection::Center}, Progress());
}

}  // namespace

class EvenBrightnessTest : public QObject {
  Q_OBJECT

 private:
  Scene scene_;
  std::unique_ptr<LightField> uneven_;

 private slots:
  void initTestCase() {
    scene_ = render("edge", 96, 96, {5, 5});
    uneven_ = std::make_unique<LightField>(uneven(*scene_.light_field));
  }

  void gains_areTakenOut() {
    const auto even = EvenViews().of(*uneven_, Progress());

    QVERIFY(even);
    QVERIFY2(even->note.find("evened out") != std::string::npos, even->note.c_str());
    for (int i = 0; i < 25; ++i) {
      const ViewIndex view = uneven_->grid().view_at(i);
      const double ratio =
          mean_of(even->light_field, view) / (0.8 * mean_of(*scene_.light_field, view));
      QVERIFY2(std::abs(ratio - 1) < 0.01, qPrintable(QString::number(ratio)));
    }
  }

  // Live runs a method at every change of a parameter.
  void evenViews_areMadeOnce_andCounted() {
    EvenViews views;
    const auto kept = views.of(*uneven_, Progress());

    QCOMPARE(views.of(*uneven_, Progress()).get(), kept.get());
    QCOMPARE(views.bytes(), kept->light_field.byte_size());
    QCOMPARE(scene_.even->bytes(), std::size_t{0});
  }

  // What was begun and stopped is begun anew.
  void stoppedMeasurement_isNotKept() {
    const LightField other = uneven(*scene_.light_field);
    EvenViews views;
    std::stop_source stop;
    stop.request_stop();
    const Progress stopped(stop.get_token(), {}, 1);

    QVERIFY_THROWS_EXCEPTION(Cancelled, (void)views.of(other, stopped));

    QVERIFY(views.of(other, Progress()));
  }

  void viewsOfOneBrightness_stay() { QVERIFY(!scene_.even->of(*scene_.light_field, Progress())); }

  void whoKeepsThem_hasThemLeft() {
    LightFieldInfo info = uneven_->info();
    info.reading.options = {{kKeepBrightness, true}};
    LightField copy = uneven(*scene_.light_field);

    QVERIFY(!EvenViews().of(LightField(std::move(copy), std::move(info)), Progress()));
  }

  // Without, EPI methods lose most: a gain is a slope of all lines.
  void methods_doNotNoticeGains_data() {
    QTest::addColumn<QString>("method");
    for (const char* method : {"epi_l", "epi_two_layer", "st_ch_l"})
      QTest::newRow(method) << method;
  }
  void methods_doNotNoticeGains() {
    QFETCH(QString, method);
    const QByteArray id = method.toLatin1();
    const Estimate plain = run(*scene_.light_field, id);
    const Estimate found = run(*uneven_, id);

    const DisparityView truth = scene_.truth->field.view({2, 2});
    const double before = errors(plain.field.disparity.view({2, 2}), truth, 4).mse_100;
    const double after = errors(found.field.disparity.view({2, 2}), truth, 4).mse_100;
    // Measured gains are off by up to a hundredth.
    QVERIFY2(after < 1.5 * before + 0.2,
             qPrintable(QString("%1 instead of %2").arg(after).arg(before)));
    QVERIFY(std::ranges::any_of(found.notes, [](const std::string& note) {
      return note.find("evened out") != std::string::npos;
    }));
  }

  void blocks_seeThemEvenToo() {
    const Estimator& estimator = find_estimator("epi_l");

    const BlockwiseRun blocks = estimator.in_blocks(*uneven_, {}, {}, Progress());

    QVERIFY(std::ranges::any_of(blocks.provenance.notes, [](const std::string& note) {
      return note.find("evened out") != std::string::npos;
    }));
  }
};

}  // namespace episcope::in_even_brightness_test

EPISCOPE_TEST(even_brightness_test, EvenBrightnessTest)
#include "even_brightness_test.moc"
