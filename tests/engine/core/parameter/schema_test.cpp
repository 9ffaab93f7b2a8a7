// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/parameter/schema.h"
#include "tests/test_main.h"

namespace episcope::in_schema_test {

namespace {

struct Tuning {
  double scale = 0.8;
  int rounds = 3;
  bool is_weighted = true;
  std::string fusion = "weighted";
  IntervalOrAuto range;
};

const Schema<Tuning>& schema() {
  static const Schema<Tuning> all =
      Schema<Tuning>()
          .real("scale", &Tuning::scale, {"Scale", "Of the filter.", "px"}, {0.1, 5, true})
          .integer("rounds", &Tuning::rounds, {"Rounds", "How often."}, {1, 9})
          .flag("weighted", &Tuning::is_weighted, {"Weighted", "Whether."})
          .choice("fusion", &Tuning::fusion, {"Fusion", "How."}, {"weighted", "best"})
          .interval("range", &Tuning::range, {"Range", "Where.", "px"}, {-20, 20});
  return all;
}

QString error_of(const ParameterSet& values) {
  try {
    static_cast<void>(schema().parse(values));
  } catch (const InvalidInput& error) {
    return QString::fromUtf8(error.what());
  }
  return {};
}

}  // namespace

class SchemaTest : public QObject {
  Q_OBJECT

 private slots:
  void descriptions_sayAllOnce() {
    const auto& all = schema().descriptions();

    QCOMPARE(all.size(), std::size_t{5});
    QCOMPARE(all[0].key, std::string("scale"));
    QCOMPARE(all[0].unit, std::string("px"));
    QCOMPARE(std::get<double>(all[0].default_value), 0.8);
    QCOMPARE(all[0].min, 0.1);
    QCOMPARE(all[0].max, 5.0);
    QVERIFY(all[0].logarithmic && !all[1].logarithmic);
    QCOMPARE(std::get<int>(all[1].default_value), 3);
    QVERIFY(std::get<bool>(all[2].default_value));
    QCOMPARE(all[3].choices, (std::vector<std::string>{"weighted", "best"}));
    QVERIFY(!std::get<IntervalOrAuto>(all[4].default_value));
  }

  void parseOfNothing_givesDefaults() {
    const Tuning tuning = schema().parse({});

    QCOMPARE(tuning.scale, 0.8);
    QCOMPARE(tuning.rounds, 3);
    QCOMPARE(tuning.fusion, std::string("weighted"));
    QVERIFY(!tuning.range);
  }

  void values_roundTrip() {
    Tuning tuning;
    tuning.scale = 1.25;
    tuning.rounds = 7;
    tuning.is_weighted = false;
    tuning.fusion = "best";
    tuning.range = Interval{-1, 2};

    const ParameterSet values = schema().values(tuning);
    const Tuning back = schema().parse(values);

    QCOMPARE(values.size(), std::size_t{5});
    QCOMPARE(values[4].first, std::string("range"));
    QVERIFY(schema().values(back) == values);
    QCOMPARE(back.range->max, 2.0);
  }

  void unknownKey_namesTheNearest() {
    const QString message = error_of({{"scael", ParameterValue(1.0)}});

    QVERIFY2(message.contains("'scael'") && message.contains("'scale'"), qPrintable(message));
  }

  void badValues_areRefused() {
    QVERIFY(error_of({{"scale", ParameterValue(9.0)}}).contains("from 0.1 to 5"));
    QVERIFY(error_of({{"rounds", ParameterValue(2.0)}}).contains("rounds"));
    QVERIFY(
        error_of({{"fusion", ParameterValue(std::string("worst"))}}).contains("weighted, best"));
    QVERIFY(
        error_of({{"range", ParameterValue(IntervalOrAuto(Interval{3, 2}))}}).contains("A < B"));
  }

  void completion_seesWhatWasParsed() {
    Schema<Tuning> completed = schema();
    completed.completed_by([](Tuning& tuning) {
      if (tuning.fusion == "best") tuning.rounds = 1;
    });

    QCOMPARE(completed.parse({{"rounds", 5}}).rounds, 5);
    QCOMPARE(completed.parse({{"rounds", 5}, {"fusion", std::string("best")}}).rounds, 1);
  }

  void searchedValues_haveTheTypeOfTheParameter() {
    Schema<Tuning> searched = schema();

    searched.search("scale", {1, 2.5}).search("rounds", {1, 9}).search("weighted", {0, 1});
    searched.search_choices("fusion", {"best"});

    const auto values = [&](int i) { return searched.descriptions()[i].searched; };
    QVERIFY(values(0) == (std::vector<ParameterValue>{1.0, 2.5}));
    QVERIFY(values(1) == (std::vector<ParameterValue>{1, 9}));
    QVERIFY(values(2) == (std::vector<ParameterValue>{false, true}));
    QVERIFY(values(3) == (std::vector<ParameterValue>{std::string("best")}));
    QVERIFY(values(4).empty());
    QVERIFY_EXCEPTION_THROWN(searched.search("scale", {7}), InvalidInput);
    QVERIFY_EXCEPTION_THROWN(searched.search("scael", {1}), InvalidInput);
    QVERIFY_EXCEPTION_THROWN(searched.search_choices("fusion", {"worst"}), InvalidInput);
  }
};

}  // namespace episcope::in_schema_test

EPISCOPE_TEST(schema_test, SchemaTest)
#include "schema_test.moc"
