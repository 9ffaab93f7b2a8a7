// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/benchmark_tables.h"
#include "tests/test_main.h"

namespace episcope::in_label_tables_test {

namespace {

using Cells = std::vector<std::string>;

BenchmarkResult result(const char* entry, const char* scene, double accuracy, double iou) {
  BenchmarkResult made;
  made.entry = entry;
  made.scene = scene;
  made.seconds = 2;
  made.labels = {{"accuracy_all_views", accuracy}, {"miou", iou}, {"iou_label_3", iou}};
  return made;
}

const TitledTable* find_table(const std::vector<TitledTable>& tables, const std::string& part) {
  const auto found = std::ranges::find_if(tables, [&](const TitledTable& table) {
    return table.title.find(part) != std::string::npos;
  });
  return found == tables.end() ? nullptr : &*found;
}

}  // namespace

class LabelTablesTest : public QObject {
  Q_OBJECT

 private slots:
  // Half of the pixels of label 1 are taken for label 2.
  void metrics_areSharesByKey() {
    LabelQuality all, center;
    all.all.confusion = {{{1, 1}, 5}, {{1, 2}, 5}, {{2, 2}, 10}};
    center.all.confusion = {{{1, 1}, 1}};

    const Metrics metrics = label_metrics(all, center, 0.9);

    QCOMPARE(*find_metric(metrics, "accuracy_all_views"), 0.75);
    QCOMPARE(*find_metric(metrics, "accuracy_center"), 1.0);
    QCOMPARE(*find_metric(metrics, "macc"), 0.75);
    QCOMPARE(*find_metric(metrics, "miou"), (0.5 + 10.0 / 15) / 2);
    QCOMPARE(*find_metric(metrics, "accuracy_label_1"), 0.5);
    QCOMPARE(*find_metric(metrics, "iou_label_2"), 10.0 / 15);
    QCOMPARE(*find_metric(metrics, "consistency"), 0.9);
    QVERIFY(!find_metric(metrics, "boundary_accuracy") && !find_metric(metrics, "thin_iou"));
  }

  void tables_putTheLargestFirst() {
    const auto tables = label_tables({result("a", "x", 0.5, 0.4), result("b", "x", 0.75, 0.6),
                                      result("a", "y", 1, 0.5), result("b", "y", 0.875, 0.5)});

    const TitledTable& accuracy = *find_table(tables, "Accuracy:");
    QCOMPARE(accuracy.table.header, (Cells{"scene", "b", "a"}));
    QCOMPARE(accuracy.table.rows[0], (Cells{"x", "75.000", "50.000"}));
    QCOMPARE(accuracy.table.rows[2], (Cells{"average", "81.250", "75.000"}));
    QCOMPARE(accuracy.table.rows[3], (Cells{"rank", "1", "2"}));
    QVERIFY(accuracy.best[0] == std::pair(std::size_t{0}, std::size_t{1}));
    QVERIFY(accuracy.best[1] == std::pair(std::size_t{1}, std::size_t{2}));
    const Cells& first = tables[0].table.rows[0];
    QCOMPARE((Cells{first[0], first[1], first[2], first.back()}),
             (Cells{"b", "1", "81.250", "2.00"}));
  }

  void tables_haveEveryLabelOfAScene() {
    const auto tables = label_tables({result("a", "x", 0.5, 0.4), result("a", "garden", 1, 0.6)});

    const TitledTable* const of_scene = find_table(tables, "garden: ");
    QVERIFY(of_scene != nullptr);
    QCOMPARE(of_scene->table.header, (Cells{"label", "a"}));
    QCOMPARE(of_scene->table.rows[0], (Cells{"label 3", "60.000"}));
  }

  void tables_leaveOutWhatIsNotKnown() {
    BenchmarkResult disparity;
    disparity.entry = "epi_l";
    disparity.scene = "x";

    QVERIFY(label_tables({disparity}).empty());
    const auto tables = label_tables({disparity, result("a", "x", 0.5, 0.4)});
    QVERIFY(find_table(tables, "Boundary") == nullptr);
    QCOMPARE(tables[0].table.rows.size(), std::size_t{1});
  }
};

}  // namespace episcope::in_label_tables_test

EPISCOPE_TEST(label_tables_test, LabelTablesTest)
#include "label_tables_test.moc"
