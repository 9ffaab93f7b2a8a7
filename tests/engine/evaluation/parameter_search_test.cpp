// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/parameter_search.h"
#include "tests/test_main.h"

namespace episcope::in_parameter_search_test {

namespace {

const std::optional<double> kNone;

ParameterDescription parameter(const char* key, double standard, std::vector<double> searched) {
  ParameterDescription made;
  made.key = key;
  made.default_value = standard;
  for (const double value : searched) made.searched.emplace_back(value);
  return made;
}

using Points = std::vector<std::optional<std::size_t>>;

}  // namespace

class ParameterSearchTest : public QObject {
  Q_OBJECT
 private slots:
  void grid_isTheProductAndBeginsWithTheDefault() {
    const auto points = search_grid({parameter("a", 2, {1, 2}), parameter("unsearched", 7, {}),
                                     parameter("b", 20, {10, 20, 30})});

    QCOMPARE(points.size(), std::size_t{6});  // the default lies on it
    QVERIFY(points[0] == (ParameterSet{{"a", 2.0}, {"b", 20.0}}));
    QVERIFY(points[1] == (ParameterSet{{"a", 1.0}, {"b", 10.0}}));
    QVERIFY(points[5] == (ParameterSet{{"a", 2.0}, {"b", 30.0}}));
  }

  void defaultBesideTheGrid_isTriedToo() {
    QCOMPARE(search_grid({parameter("a", 3, {1, 2})}).size(), std::size_t{3});
    QCOMPARE(search_grid({parameter("a", 3, {})}), (std::vector<ParameterSet>{{}}));
  }

  void equalParameters_weighScenesAlike() {
    // The second scene is 100 times as hard: by the mean error point 1 would win (51 < 52.5), but
    // it doubles the error of the first scene for 5 % of the second.
    const ParameterChoice choice = choose_parameters({{1, 105}, {2, 100}, {3, 104}});

    QCOMPARE(choice.per_scene, (Points{0, 1}));
    QCOMPARE(choice.equal, std::optional<std::size_t>(0));
    QCOMPARE(choice.leave_one_out, (Points{1, 0}));
  }

  void leaveOneOut_isBlindToItsScene() {
    // Point 1 is best of all scenes together only because of the third one.
    const SearchScores scores{{1, 1, 100}, {2, 2, 1}, {4, 4, 4}};
    const ParameterChoice choice = choose_parameters(scores);

    QCOMPARE(choice.equal, std::optional<std::size_t>(1));
    QCOMPARE(choice.leave_one_out, (Points{1, 1, 0}));
  }

  void points_withAGapAreNotForAll() {
    const ParameterChoice choice =
        choose_parameters({{5, 5, kNone}, {1, kNone, kNone}, {4, 4, kNone}});

    QCOMPARE(choice.per_scene, (Points{1, 2, std::nullopt}));
    QCOMPARE(choice.equal, std::optional<std::size_t>(2));
    QCOMPARE(choice.leave_one_out, (Points{2, 1, std::nullopt}));
  }

  void oneScene_leavesNothingOut() {
    const ParameterChoice choice = choose_parameters({{2}, {1}});

    QCOMPARE(choice.equal, std::optional<std::size_t>(1));
    QCOMPARE(choice.leave_one_out, (Points{std::nullopt}));
  }

  void perfectScores_areCompared() {
    QCOMPARE(choose_parameters({{1, 0}, {0, 0}}).equal, std::optional<std::size_t>(1));
  }

  void equals_takeTheFirst() {
    QCOMPARE(choose_parameters({{3, 1}, {1, 3}}).equal, std::optional<std::size_t>(0));
  }

  void tables_showEveryProtocol() {
    std::vector<SearchResult> results;
    const double scores[2][3] = {{3, 1, 4}, {1, 2, 2}};  // [scene][point]
    for (int scene = 0; scene < 2; ++scene) {
      for (int point = 0; point < 3; ++point) {
        results.push_back(
            {"m", scene == 0 ? "x" : "y", {{"a", 1.0 * point}}, scores[scene][point], 1, ""});
      }
    }

    const auto tables = search_tables(results);

    QCOMPARE(tables.size(), std::size_t{2});
    QCOMPARE(tables[0].table.rows[0],
             (std::vector<std::string>{"m", "1", "1.000", "1.500", "2.500", "2.000", "3", "a 1"}));
    QCOMPARE(tables[1].table.rows[0],
             (std::vector<std::string>{"x", "1.000", "1.000", "3.000", "3.000", "a 1"}));
    QCOMPARE(tables[1].table.rows[1],
             (std::vector<std::string>{"y", "1.000", "2.000", "2.000", "1.000", "a 0"}));
    QVERIFY(search_tables({}).empty());
  }
};

}  // namespace episcope::in_parameter_search_test

EPISCOPE_TEST(parameter_search_test, ParameterSearchTest)
#include "parameter_search_test.moc"
