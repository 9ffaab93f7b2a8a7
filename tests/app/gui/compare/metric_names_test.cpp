// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/compare/metric_controller.h"

#include "tests/engine/evaluation/high_res_maps.h"
#include "tests/window_test_main.h"

#include <set>

namespace episcope::in_metric_names_test {

using namespace episcope::test;

class MetricNamesTest : public QObject {
  Q_OBJECT
 private slots:
  // Of every scene of the benchmark, in both resolutions.
  void everyMetric_hasANameAndAHelp() {
    Masks low, in_high;
    for (const char* name :
         {"discontinuities", "planes", "smooth_surfaces", "fine", "fine_surrounding", "plane",
          "foreground_fattening", "foreground_thinning", "background", "boxes", "dots_by_size",
          "low_texture", "high_contrast", "low_contrast", "pyramids", "sphere_in", "sphere_out"}) {
      low[name] = Mask(kSize, kSize, 1, 1);
      in_high[name] = Mask(kHigh, kHigh, 1, 1);
    }
    const MemoryTruth truth(high([](int, int) { return 0; }), in_high);
    std::set<std::string> keys{"runtime_log", "layers_right", "mse_100_foreground",
                               "discontinuities_0070_lowres_background"};
    for (const auto scene :
         {StratifiedScene::None, StratifiedScene::Backgammon, StratifiedScene::Dots,
          StratifiedScene::Pyramids, StratifiedScene::Stripes}) {
      for (const auto& [key, value] :
           judge_high(constant(0), truth, scene, InvalidEstimates::Bad, low).metrics) {
        keys.insert(key);
      }
    }

    std::set<QString> labels;
    std::set<int> ranks;
    for (const std::string& key : keys) {
      const MetricColumn column = metric_column(Protocol::Benchmark2016, key);
      QVERIFY2(!column.label.contains('_') && !column.help.startsWith('\n'), key.c_str());
      labels.insert(column.label);
      ranks.insert(metric_rank(key));
    }
    QVERIFY(keys.size() > 35);
    QCOMPARE(labels.size(), keys.size());
    QCOMPARE(ranks.size(), keys.size());
    QVERIFY(metric_rank("mse_100") < metric_rank("mse_100_lowres"));
    QVERIFY(metric_rank("mse_100_lowres") < metric_rank("badpix_0070"));
  }
};

}  // namespace episcope::in_metric_names_test

EPISCOPE_WINDOW_TEST(metric_names_test, MetricNamesTest)
#include "metric_names_test.moc"
