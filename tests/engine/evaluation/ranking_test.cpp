// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/benchmark_tables.h"
#include "tests/test_main.h"

namespace episcope::in_ranking_test {

namespace {

const std::optional<double> kNone;

/// Figure 7 of Wanner, Meister, Goldluecke 2013, as printed.
ScoreMatrix figure_7() {
  ScoreMatrix matrix;
  matrix.entries = {"EPI_L",   "EPI_S",   "EPI_C",   "EPI_G",   "ST_AV_L",
                    "ST_AV_S", "ST_AV_G", "ST_CH_L", "ST_CH_S", "ST_CH_G"};
  matrix.scores.resize(matrix.entries.size());
  const std::pair<const char*, std::vector<double>> rows[] = {
      {"buddha", {0.81, 0.57, 0.55, 0.62, 1.20, 0.78, 0.90, 1.01, 0.67, 0.80}},
      {"buddha2", {1.22, 0.87, 0.87, 0.89, 2.26, 1.05, 0.68, 3.08, 1.31, 0.75}},
      {"horses", {3.60, 2.12, 2.21, 2.67, 5.29, 1.85, 1.00, 6.14, 2.12, 1.06}},
      {"medieval", {1.69, 1.15, 1.10, 1.24, 7.22, 0.91, 0.76, 12.14, 1.08, 0.79}},
      {"mona", {1.15, 0.90, 0.82, 0.93, 2.25, 1.05, 0.79, 2.28, 1.02, 0.81}},
      {"papillon", {3.95, 2.26, 2.52, 2.48, 4.84, 2.92, 3.65, 4.85, 2.57, 3.10}},
      {"stillLife", {3.94, 3.06, 2.61, 3.37, 5.08, 4.23, 4.04, 4.48, 3.36, 3.22}},
      {"couple", {0.40, 0.18, 0.16, 0.19, 0.60, 0.24, 0.30, 1.10, 0.24, 0.30}},
      {"cube", {1.27, 0.85, 0.82, 0.87, 1.28, 0.51, 0.56, 2.25, 0.51, 0.55}},
      {"maria", {0.19, 0.10, 0.10, 0.11, 0.34, 0.11, 0.11, 0.51, 0.11, 0.11}},
      {"pyramide", {0.56, 0.38, 0.38, 0.39, 0.72, 0.42, 0.42, 1.30, 0.43, 0.42}},
      {"statue", {0.88, 0.33, 0.29, 0.35, 1.56, 0.21, 0.21, 3.39, 0.29, 0.21}}};
  for (const auto& [scene, row] : rows) {
    matrix.scenes.emplace_back(scene);
    for (std::size_t i = 0; i < row.size(); ++i) matrix.scores[i].emplace_back(row[i]);
  }
  return matrix;
}

BenchmarkResult result(const char* entry, const char* scene, std::optional<double> mse,
                       double seconds = 1, bool all_views = true) {
  BenchmarkResult made;
  made.entry = entry;
  made.scene = scene;
  made.seconds = seconds;
  made.has_all_views = all_views;
  if (mse) made.vmv2013 = {{"mse_100", *mse}};
  return made;
}

}  // namespace

class RankingTest : public QObject {
  Q_OBJECT
 private slots:
  void figure7_givesThePrintedAveragesAndFigure8() {
    const ScoreMatrix matrix = figure_7();
    const Ranking ranking = rank_entries(matrix, 2);

    const double printed[] = {1.64, 1.07, 1.04, 1.18, 2.72, 1.19, 1.12, 3.54, 1.14, 1.01};
    for (std::size_t i = 0; i < matrix.entries.size(); ++i) {
      // The paper averaged unrounded scores.
      QVERIFY2(std::abs(*ranking.averages[i] - printed[i]) <= 0.01, matrix.entries[i].c_str());
    }
    std::vector<std::string> order;
    for (const std::size_t entry : ranking.order) order.push_back(matrix.entries[entry]);
    QCOMPARE(order, (std::vector<std::string>{"ST_CH_G", "EPI_C", "EPI_S", "ST_AV_G", "ST_CH_S",
                                              "EPI_G", "ST_AV_S", "EPI_L", "ST_AV_L", "ST_CH_L"}));
    QCOMPARE(ranking.scenes.size(), std::size_t{12});
  }

  void gaps_leaveTheSceneOutForAll() {
    const ScoreMatrix matrix{{"a", "b"}, {"x", "y", "z"}, {{1, 9, kNone}, {2, kNone, kNone}}};
    const Ranking ranking = rank_entries(matrix, 3);

    QCOMPARE(ranking.scenes, (std::vector<std::size_t>{0}));
    QCOMPARE(ranking.missing, (std::vector<std::size_t>{1}));  // z is nobody's
    QCOMPARE(*ranking.averages[0], 1.0);
    QCOMPARE(ranking.ranks, (std::vector<int>{1, 2}));
  }

  void entriesWithoutScores_areNotRankedAndCostNobodyAScene() {
    const ScoreMatrix matrix{{"empty", "b", "c"}, {"x", "y"}, {{kNone, kNone}, {4, 2}, {1, 1}}};
    const Ranking ranking = rank_entries(matrix, 3);

    QCOMPARE(ranking.scenes.size(), std::size_t{2});
    QCOMPARE(ranking.ranks, (std::vector<int>{0, 2, 1}));
    QCOMPARE(ranking.order, (std::vector<std::size_t>{2, 1, 0}));
    QVERIFY(!ranking.averages[0]);
  }

  void withoutACommonScene_nobodyIsRanked() {
    const ScoreMatrix matrix{{"a", "b"}, {"x", "y"}, {{1, kNone}, {kNone, 2}}};
    const Ranking ranking = rank_entries(matrix, 3);

    QCOMPARE(ranking.ranks, (std::vector<int>{0, 0}));
    QCOMPARE(ranking.missing.size(), std::size_t{2});
  }

  void ties_shareARankAsShown() {
    const ScoreMatrix matrix{{"a", "b", "c"}, {"x"}, {{0.5104}, {0.5096}, {0.6}}};

    QCOMPARE(rank_entries(matrix, 2).ranks, (std::vector<int>{1, 1, 3}));
    QCOMPARE(rank_entries(matrix, 4).ranks, (std::vector<int>{2, 1, 3}));
  }

  void largerScores_rankFirstWhereTheyAreBetter() {
    const ScoreMatrix matrix{
        {"a", "b", "c"}, {"x"}, {{0.5104}, {0.5096}, {0.6}}, BetterScore::Larger};

    const Ranking ranking = rank_entries(matrix, 2);

    QCOMPARE(ranking.ranks, (std::vector<int>{2, 2, 1}));
    QCOMPARE(ranking.order.front(), std::size_t{2});
  }

  void accuracyTable_isOrderedAndStressesTheBest() {
    const TitledTable titled =
        accuracy_table("t", score_matrix({result("a", "x", 2), result("b", "x", 1),
                                          result("a", "y", 3), result("b", "y", std::nullopt)},
                                         Protocol::Vmv2013, "mse_100"));

    QCOMPARE(titled.table.header, (std::vector<std::string>{"scene", "b", "a"}));
    QCOMPARE(titled.table.rows[0], (std::vector<std::string>{"x", "1.000", "2.000"}));
    QCOMPARE(titled.table.rows[1], (std::vector<std::string>{"y", "–", "3.000"}));
    QCOMPARE(titled.table.rows[2], (std::vector<std::string>{"average", "1.000", "2.000"}));
    QCOMPARE(titled.table.rows[3],
             (std::vector<std::string>{"average of its own scenes", "1.000 (1)", "2.500 (2)"}));
    QCOMPARE(titled.table.rows[4], (std::vector<std::string>{"rank", "1", "2"}));
    QVERIFY(titled.best[0] == std::pair(std::size_t{0}, std::size_t{1}));
    QVERIFY(titled.best[1] == std::pair(std::size_t{1}, std::size_t{2}));
    const QString note = QString::fromStdString(titled.note);
    QVERIFY2(note.contains("1 of 2 scenes") && note.contains("y (b)"), qPrintable(note));
  }

  void overviewTable_classesTheMeanTime() {
    const TitledTable titled = overview_table(
        {result("fast", "x", 1, 4), result("slow", "x", 2, 70, false), result("none", "x", 3, 0),
         result("fast", "y", 1, 5), result("slow", "y", 2, 70, false), result("none", "y", 3, 0)});

    QCOMPARE(titled.table.rows[0],
             (std::vector<std::string>{"fast", "1", "1.000", "fast", "4.50", "yes"}));
    QCOMPARE(titled.table.rows[1],
             (std::vector<std::string>{"slow", "2", "2.000", "slow", "70.00", ""}));
    QCOMPARE(titled.table.rows[2],
             (std::vector<std::string>{"none", "3", "3.000", "not given", "not given", ""}));
  }

  void overviewTable_namesWhatIsJudgedInParts() {
    BenchmarkResult cut = result("cut", "x", 1), whole = result("whole", "x", 2);
    cut.vmv2013.emplace_back("shown", 56.25);
    whole.vmv2013.emplace_back("shown", 100);

    const QString note = QString::fromStdString(overview_table({cut, whole}).note);
    QVERIFY2(note.contains("a part of the pixels alone: cut on x (56.2 %)."), qPrintable(note));
  }

  void tables_leaveOutWhatHasNoScore() {
    const auto tables = benchmark_tables({result("a", "x", 2)});

    QCOMPARE(tables.size(), std::size_t{2});  // no second protocol, no layers
    const auto with_another =
        benchmark_tables({result("a", "x", 2), result("b", "x", std::nullopt)});
    QCOMPARE(with_another[1].table.header, (std::vector<std::string>{"scene", "a"}));
    QCOMPARE(with_another[0].table.rows[1][1], std::string("–"));  // the overview tells of it
    QCOMPARE(results_table({result("a", "x", 2)}).rows[0],
             (std::vector<std::string>{"a", "x", "1.000", "yes", "2.000000", ""}));
  }

  // Official scores and those of the resolution of the views never share a table.
  void scoresOfOtherResolutions_haveTablesOfTheirOwn() {
    BenchmarkResult dots, cotton;
    dots.entry = cotton.entry = "a";
    dots.scene = "dots";
    cotton.scene = "cotton";
    dots.benchmark2016 = {{"mse_100_lowres", 3}};
    cotton.benchmark2016 = {{"mse_100", 2}};

    const auto both = benchmark_tables({dots, cotton});
    const auto one = benchmark_tables({cotton});

    QCOMPARE(both.size(), std::size_t{3});
    QCOMPARE(both[1].table.rows[0], (std::vector<std::string>{"cotton", "2.000"}));
    QCOMPARE(both[2].table.rows[0], (std::vector<std::string>{"dots", "3.000"}));
    QCOMPARE(one.size(), std::size_t{2});
  }
};

}  // namespace episcope::in_ranking_test

EPISCOPE_TEST(ranking_test, RankingTest)
#include "ranking_test.moc"
