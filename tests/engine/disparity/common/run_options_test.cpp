// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/estimator.h"

#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

namespace episcope::in_run_options_test {

namespace {

struct Nothing {};

// How many threads a method may use that is run with `options` and a progress of 5 threads.
int threads_seen(const RunOptions& options) {
  int threads = 0;
  const Estimator estimator = make_estimator<Nothing>(
      {.id = "counter", .name = "COUNTER", .summary = "", .reference = ""}, {},
      [&](const LightField&, const Nothing&, ViewSelection, const Progress& progress) {
        threads = progress.threads();
        return Estimate{};
      });
  const LightField light_field =
      test::make_light_field({1, 2}, 4, 4, 1, [](ViewIndex, int, int, int) { return 0.5F; });
  (void)estimator.run(light_field, {}, options, Progress(5));
  return threads;
}

}  // namespace

class RunOptionsTest : public QObject {
  Q_OBJECT

 private slots:
  void schema_goesByNames() {
    const RunOptions options = run_schema().parse(
        {{"views", std::string("center")}, {"device", std::string("cuda")}, {"threads", 3}});

    QCOMPARE(options.views, ViewSelection::Center);
    QCOMPARE(options.device, Device::Cuda);
    QCOMPARE(options.threads, 3);
    QCOMPARE(run_schema().values({}),
             (ParameterSet{
                 {"views", std::string("all")}, {"device", std::string("auto")}, {"threads", 0}}));
  }

  void schema_refusesWhatThereIsNot() {
    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             (void)run_schema().parse({{"device", std::string("gpu")}}));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)run_schema().parse({{"threads", -1}}));
  }

  void threads_areAtMostThoseAskedFor() {
    QCOMPARE(threads_seen({.threads = 2}), 2);
    QCOMPARE(threads_seen({}), 5);
    QCOMPARE(threads_seen({.threads = 8}), 5);
  }
};

}  // namespace episcope::in_run_options_test

EPISCOPE_TEST(run_options_test, RunOptionsTest)
#include "run_options_test.moc"
