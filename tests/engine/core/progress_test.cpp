// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/core/progress.h"
#include "tests/test_main.h"

#include <thread>
#include <vector>

namespace episcope::in_progress_test {

namespace {

struct Recorder {
  std::vector<ProgressState> states;
  Progress progress{std::stop_token{},
                    [this](const ProgressState& state) { states.push_back(state); }};
};

}  // namespace

class ProgressTest : public QObject {
  Q_OBJECT

 private slots:
  void report_tellsTheFraction() {
    Recorder recorder;

    recorder.progress.report(0.25);
    recorder.progress.report(0.5);

    QCOMPARE(recorder.states.size(), std::size_t{2});
    QCOMPARE(recorder.states[0].fraction, 0.25);
    QCOMPARE(recorder.states[1].fraction, 0.5);
  }

  void fraction_neverFalls() {
    Recorder recorder;

    recorder.progress.report(0.6);
    recorder.progress.report(0.4);
    recorder.progress.step("second stage");

    QCOMPARE(recorder.states.size(), std::size_t{2});
    QCOMPARE(recorder.states[1].fraction, 0.6);
  }

  void reports_areThrottledButTheEndIsNot() {
    Recorder recorder;

    for (int i = 1; i <= 100000; ++i) recorder.progress.report(i / 100000.0);

    QVERIFY(recorder.states.size() <= 1001);
    QVERIFY(recorder.states.size() >= 900);
    QCOMPARE(recorder.states.back().fraction, 1.0);
  }

  void fraction_isClamped() {
    Recorder recorder;

    recorder.progress.report(7);

    QCOMPARE(recorder.states.back().fraction, 1.0);
  }

  void step_keepsItsName() {
    Recorder recorder;

    recorder.progress.step("vertical EPIs");
    recorder.progress.report(0.3);

    QCOMPARE(recorder.states.size(), std::size_t{2});
    QCOMPARE(recorder.states[1].step, std::string("vertical EPIs"));
  }

  void parts_nest() {
    Recorder recorder;

    const Progress half = recorder.progress.part(0.5, 1);
    const Progress quarter = half.part(0, 0.5);
    quarter.report(0.5);
    quarter.report(1);
    half.report(1);

    QCOMPARE(recorder.states.size(), std::size_t{3});
    QCOMPARE(recorder.states[0].fraction, 0.625);
    QCOMPARE(recorder.states[1].fraction, 0.75);
    QCOMPARE(recorder.states[2].fraction, 1.0);
  }

  void stop_reachesEveryCopy() {
    std::stop_source stop;
    const Progress progress(stop.get_token(), nullptr);
    const Progress part = progress.part(0.2, 0.4);
    part.check();
    QVERIFY(!part.stop_requested());

    stop.request_stop();

    QVERIFY(part.stop_requested());
    QVERIFY_THROWS_EXCEPTION(Cancelled, progress.check());
    QVERIFY_THROWS_EXCEPTION(Cancelled, part.check());
  }

  void titles_precedeTheStage() {
    std::string step;
    const Progress progress(std::stop_token{}, [&](const ProgressState& s) { step = s.step; });

    progress.titled("cotton").part(0, 0.5).titled("epi_l").step("reading");

    QCOMPARE(step, std::string("cotton: epi_l: reading"));
  }

  void finish_isAskedApartFromStop() {
    std::stop_source finish;
    const Progress progress(std::stop_token{}, finish.get_token(), {});
    const Progress inner = progress.part(0, 0.5);
    QVERIFY(!inner.finish_requested());

    finish.request_stop();

    QVERIFY(inner.finish_requested());
    QVERIFY(!inner.stop_requested());
    inner.check();
  }

  void threads_areAtLeastOne() {
    QVERIFY(Progress().threads() >= 1);
    QCOMPARE(Progress(3).threads(), 3);
    QCOMPARE(Progress(3).part(0, 0.5).threads(), 3);
    QCOMPARE(Progress(3).on_one_thread().threads(), 1);
  }

  void threads_canOnlyBeLimited() {
    QCOMPARE(Progress(3).limited_to(2).threads(), 2);
    QCOMPARE(Progress(3).limited_to(2).part(0, 0.5).threads(), 2);
    QCOMPARE(Progress(3).limited_to(8).threads(), 3);
    QCOMPARE(Progress(3).limited_to(0).threads(), 3);
  }

  void listener_isCalledOneAtATime() {
    int inside = 0;
    int overlaps = 0;
    const Progress progress(std::stop_token{}, [&](const ProgressState&) {
      overlaps += ++inside != 1;
      --inside;
    });

    {
      std::vector<std::jthread> threads;
      for (int t = 0; t < 4; ++t) {
        threads.emplace_back([&progress] {
          for (int i = 1; i <= 1000; ++i) progress.report(i / 1000.0);
        });
      }
    }

    QCOMPARE(overlaps, 0);
  }
};

}  // namespace episcope::in_progress_test

EPISCOPE_TEST(progress_test, ProgressTest)
#include "progress_test.moc"
