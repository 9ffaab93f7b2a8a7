// SPDX-License-Identifier: BSD-3-Clause

#include "app/benchmark/report.h"
#include "tests/test_main.h"

#include <cmath>

namespace episcope::in_published_test {

namespace {

BenchmarkResult result(const char* scene, const char* entry, double mse_100) {
  BenchmarkResult made;
  made.scene = scene;
  made.entry = entry;
  made.vmv2013 = {{"mse_100", mse_100}};
  return made;
}

}  // namespace

class PublishedTest : public QObject {
  Q_OBJECT

 private slots:
  void averages_followFromTheRows() {
    const PublishedFigures& figures = published_figures();
    QCOMPARE(figures.scenes.size(), std::size_t{12});
    QCOMPARE(figures.algorithms.size(), std::size_t{10});
    for (std::size_t i = 0; i < figures.algorithms.size(); ++i) {
      double sum = 0;
      for (const PublishedScene& scene : figures.scenes) sum += scene.mse_100.at(i);
      const double off = sum / 12 - figures.averages.at(i);
      QVERIFY2(std::fabs(off) <= 0.01, figures.algorithms[i].c_str());
    }
  }

  void figure8_ranksTheAveragesOfFigure7() {
    const PublishedFigures& figures = published_figures();
    QCOMPARE(figures.ranking.size(), figures.algorithms.size());
    double last = 0;
    for (const PublishedAlgorithm& algorithm : figures.ranking) {
      const auto column = std::ranges::find(figures.algorithms, algorithm.name);
      QVERIFY2(column != figures.algorithms.end(), algorithm.name.c_str());
      QCOMPARE(algorithm.mse_100, figures.averages[column - figures.algorithms.begin()]);
      QVERIFY(algorithm.mse_100 >= last);
      last = algorithm.mse_100;
    }
    QVERIFY(figures.find("epi_c")->all_views && figures.find("epi_c")->speed == "medium");
    QVERIFY(!figures.find("epi_two_layer"));
  }

  void names_areFoundHoweverTheyAreWritten() {
    const PublishedFigures& figures = published_figures();
    QCOMPARE(figures.mse_100("stillLife", "EPI_C"), std::optional(2.61));
    QCOMPARE(figures.mse_100("still_life", "epi_c"), std::optional(2.61));
    QCOMPARE(figures.mse_100("mona", "st_ch_g"), std::optional(0.81));
    QCOMPARE(figures.mse_100("monasRoom", "st_ch_g"), std::optional(0.81));
    QCOMPARE(figures.mse_100("buddha2", "epi_l"), std::optional(1.22));
    QVERIFY(!figures.mse_100("transparency", "epi_l"));
    QVERIFY(!figures.mse_100("", "epi_l"));
    QVERIFY(!figures.mse_100("buddha", "epi_two_layer"));
  }

  void table_hasScenesOfThePaperAlone() {
    BenchmarkReport report;
    report.results = {result("Buddha", "epi_s", 1.14), result("cotton", "epi_s", 0.5),
                      result("Buddha", "epi_two_layer", 0.7)};
    const TextTable table = published_table(report).table;

    QCOMPARE(table.rows.size(), std::size_t{1});
    QCOMPARE(table.rows[0], (std::vector<std::string>{"Buddha", "epi_s", "0.570", "1.140", "2.00",
                                                      "fast, all views"}));
  }

  void table_hasTheBestPointOfASearch() {
    BenchmarkReport report;
    report.results = {result("buddha", "epi_s", 1.14)};
    for (const double mse : {1.14, 0.285, 0.9}) {
      report.searched.push_back({"epi_s", "buddha", {{"lambda", mse}}, mse, 1, {}});
    }
    const TextTable table = published_table(report).table;

    QCOMPARE(table.header[5], std::string("P-opt"));
    QCOMPARE(table.rows[0][5], std::string("0.285"));
    QCOMPARE(table.rows[0][6], std::string("0.50"));
  }

  void reports_holdItWhereThePaperHasTheScene() {
    BenchmarkReport with, without;
    with.results = {result("buddha", "epi_s", 1.14)};
    without.results = {result("edge", "epi_s", 1.14)};
    const auto csv = [](const BenchmarkReport& report) {
      return QString::fromStdString(tables_to_csv(report_tables(report)));
    };

    QVERIFY(csv(with).contains("buddha,epi_s,0.570,1.140,2.00"));
    QVERIFY(!csv(without).contains("figure 7 of the paper"));
    QVERIFY(report_to_json(with).find("\"figure_7\": 0.57") != std::string::npos);
    QVERIFY(report_to_json(without).find("figure_7") == std::string::npos);
  }
};

}  // namespace episcope::in_published_test

EPISCOPE_TEST(published_test, PublishedTest)
#include "published_test.moc"
