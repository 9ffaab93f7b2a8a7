// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/schema.h"
#include "tests/test_main.h"

#include <algorithm>
#include <functional>

namespace episcope::in_schema_test {

namespace {

enum class Fusion { Best, Weighted };

Names<Fusion> names_of(Fusion) {
  return {{Fusion::Weighted, "weighted", "Weighted mean"}, {Fusion::Best, "best"}};
}

struct Tuning {
  double scale = 0.8;
  int rounds = 3;
  bool is_weighted = true;
  Fusion fusion = Fusion::Weighted;
  IntervalOrAuto range = {};
};

Schema<Tuning> tuning_schema() {
  return Schema<Tuning>()
      .real("scale", &Tuning::scale, {"Scale", "Of the filter.", "px"}, {0.1, 5, true})
      .integer("rounds", &Tuning::rounds, {"Rounds", "How often."}, {1, 9})
      .flag("weighted", &Tuning::is_weighted, {"Weighted", "Whether."})
      .choice("fusion", &Tuning::fusion, {"Fusion", "How."})
      .interval("range", &Tuning::range, {"Range", "Where.", "px"}, {-20, 20});
}

const Schema<Tuning>& schema() {
  static const Schema<Tuning> all = tuning_schema();
  return all;
}

// A struct composed of another one, with different defaults.
struct Method {
  bool is_rough = false;
  Tuning tuning{.scale = 2, .fusion = Fusion::Best};
  int labels = 8;
};

Schema<Method> method_schema(Schema<Tuning> tuning = tuning_schema()) {
  return Schema<Method>()
      .toggle("rough", &Method::is_rough, {"Rough", "Only roughly."})
      .part(&Method::tuning, tuning)
      .integer("labels", &Method::labels, {"Labels", "How many."}, {2, 64});
}

QString message_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const InvalidInput& error) {
    return QString::fromUtf8(error.what());
  }
  return {};
}

QString error_of(const ParameterSet& values) {
  return message_of([&] { static_cast<void>(schema().parse(values)); });
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
    QVERIFY(!std::get<IntervalOrAuto>(all[4].default_value));
  }

  void choices_goByTheirNames() {
    const ParameterDescription& fusion = schema().descriptions()[3];

    QCOMPARE(fusion.choices, (std::vector<std::string>{"weighted", "best"}));
    QCOMPARE(fusion.choice_labels, (std::vector<std::string>{"Weighted mean", "best"}));
    QCOMPARE(std::get<std::string>(fusion.default_value), std::string("weighted"));
    QCOMPARE(schema().parse({{"fusion", std::string("best")}}).fusion, Fusion::Best);
  }

  void names_leadToValuesAndBack() {
    QCOMPARE(name_of(Fusion::Best), std::string("best"));
    QCOMPARE(value_named<Fusion>("best"), Fusion::Best);
    QCOMPARE(all_names<Fusion>(), (std::vector<std::string>{"weighted", "best"}));
    QCOMPARE(message_of([] { static_cast<void>(value_named<Fusion>("wieghted")); }),
             QString("there is no value 'wieghted'; did you mean 'weighted'?"));
    QCOMPARE(message_of([] { static_cast<void>(value_named<Fusion>("zzzzzzzzzzzz")); }),
             QString("there is no value 'zzzzzzzzzzzz'"));
  }

  void parseOfNothing_givesDefaults() {
    const Tuning tuning = schema().parse({});

    QCOMPARE(tuning.scale, 0.8);
    QCOMPARE(tuning.rounds, 3);
    QCOMPARE(tuning.fusion, Fusion::Weighted);
    QVERIFY(!tuning.range);
  }

  void values_roundTrip() {
    Tuning tuning;
    tuning.scale = 1.25;
    tuning.rounds = 7;
    tuning.is_weighted = false;
    tuning.fusion = Fusion::Best;
    tuning.range = Interval{-1, 2};

    const ParameterSet values = schema().values(tuning);
    const Tuning back = schema().parse(values);

    QCOMPARE(values.size(), std::size_t{5});
    QCOMPARE(values[3].second, ParameterValue(std::string("best")));
    QCOMPARE(values[4].first, std::string("range"));
    QVERIFY(schema().values(back) == values);
    QCOMPARE(back.range->max, 2.0);
  }

  void unknownKey_namesTheNearest() {
    const QString message = error_of({{"scael", ParameterValue(1.0)}});

    QCOMPARE(message, QString("there is no parameter 'scael'; did you mean 'scale'?"));
  }

  void badValues_areRefused() {
    QVERIFY(error_of({{"scale", ParameterValue(9.0)}}).contains("from 0.1 to 5"));
    QVERIFY(error_of({{"rounds", ParameterValue(2.0)}}).contains("rounds"));
    QCOMPARE(error_of({{"fusion", ParameterValue(std::string("worst"))}}),
             QString("parameter fusion is 'worst', but must be one of weighted, best"));
    QVERIFY(error_of({{"fusion", ParameterValue(1)}}).contains("of the type of its default"));
    QVERIFY(
        error_of({{"range", ParameterValue(IntervalOrAuto(Interval{3, 2}))}}).contains("A < B"));
  }

  void toggle_isAFlagOfABareName() {
    const ParameterDescription rough = method_schema().descriptions()[0];

    QVERIFY(rough.is_toggle && !schema().descriptions()[2].is_toggle);
    QCOMPARE(rough.default_value, ParameterValue(false));
    QCOMPARE(to_text(parse_parameter(rough, "true")), std::string("true"));
    QVERIFY(method_schema().parse({{"rough", true}}).is_rough);
  }

  void part_standsWhereItWasPut() {
    const Schema<Method> whole = method_schema();

    std::vector<std::string> keys;
    for (const auto& each : whole.descriptions()) keys.push_back(each.key);

    QCOMPARE(keys, (std::vector<std::string>{"rough", "scale", "rounds", "weighted", "fusion",
                                             "range", "labels"}));
  }

  void part_takesTheDefaultsOfTheWhole() {
    const auto all = method_schema().descriptions();
    const Method method = method_schema().parse({});

    QCOMPARE(std::get<double>(all[1].default_value), 2.0);
    QCOMPARE(std::get<int>(all[2].default_value), 3);
    QCOMPARE(std::get<std::string>(all[4].default_value), std::string("best"));
    QCOMPARE(all[1].max, 5.0);
    QCOMPARE(all[4].choice_labels, schema().descriptions()[3].choice_labels);
    QCOMPARE(method.tuning.scale, 2.0);
    QCOMPARE(method.tuning.fusion, Fusion::Best);
  }

  void part_isReadAndWritten() {
    const ParameterSet given{{"scale", 1.5}, {"fusion", std::string("weighted")}, {"labels", 16}};

    const Method method = method_schema().parse(given);
    const ParameterSet values = method_schema().values(method);

    QCOMPARE(method.tuning.scale, 1.5);
    QCOMPARE(method.tuning.fusion, Fusion::Weighted);
    QCOMPARE(method.labels, 16);
    QCOMPARE(values.size(), std::size_t{7});
    for (const auto& each : given) QVERIFY(std::ranges::find(values, each) != values.end());
    QCOMPARE(message_of([] {
               static_cast<void>(method_schema().parse({{"scale", 9.0}}));
             }),
             QString("parameter scale is 9, but must be a number from 0.1 to 5"));
  }

  void part_leavesSearchedValuesBehind() {
    Schema<Tuning> searched = tuning_schema();
    searched.search("scale", {1, 2});

    Schema<Method> whole = method_schema(searched);
    whole.search("rounds", {1, 9});

    QVERIFY(whole.descriptions()[1].searched.empty());
    QVERIFY(whole.descriptions()[2].searched == (std::vector<ParameterValue>{1, 9}));
  }

  void preset_changesDefaultsAndGivenValuesWin() {
    Schema<Tuning> with_preset = schema();
    with_preset.preset("fusion", "best", {{"rounds", 7}});
    const std::pair<std::string, ParameterValue> best{"fusion", std::string("best")};

    QCOMPARE(with_preset.parse({}).rounds, Tuning{}.rounds);
    QCOMPARE(with_preset.parse({best}).rounds, 7);
    QCOMPARE(with_preset.parse({best, {"rounds", 5}}).rounds, 5);
    QCOMPARE(with_preset.parse({{"rounds", 5}, best}).rounds, 5);
  }

  void preset_ofAPartIsJoinedByThatOfTheWhole() {
    Schema<Tuning> part = schema();
    part.preset("fusion", "best", {{"rounds", 7}});
    Schema<Method> whole = method_schema(part);
    whole.preset("fusion", "best", {{"labels", 3}}).preset("fusion", "best", {{"rounds", 8}});

    const Method method = whole.parse({{"fusion", std::string("best")}});

    QCOMPARE(method.tuning.rounds, 8);
    QCOMPARE(method.labels, 3);
  }

  void preset_isCheckedWhenItIsDeclared() {
    Schema<Tuning> wrong = schema();

    QVERIFY_THROWS_EXCEPTION(InvalidInput, wrong.preset("fusion", "best", {{"scale", 9.0}}));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, wrong.preset("fusion", "worst", {{"rounds", 7}}));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, wrong.preset("rounds", "best", {{"scale", 1.0}}));
  }

  void describedUnder_hasTheDefaultsAndSearchedValuesOfThePreset() {
    Schema<Tuning> with_preset = schema();
    with_preset.search("scale", {1, 2}).search("rounds", {1, 9});
    with_preset.preset("fusion", "best", {{"rounds", 7}, {"scale", 3.0}});
    with_preset.preset_search("fusion", "best", "scale", {3, 4});

    const auto plain = described_under(with_preset.descriptions(), {});
    const auto best =
        described_under(with_preset.descriptions(), {{"fusion", std::string("best")}});

    const auto named = [](const auto& all, const char* key) {
      return *std::ranges::find(all, key, &ParameterDescription::key);
    };
    QVERIFY(named(plain, "rounds").default_value == ParameterValue(Tuning{}.rounds));
    QCOMPARE(named(plain, "rounds").searched.size(), std::size_t{2});
    QVERIFY(named(best, "rounds").default_value == ParameterValue(7));
    QVERIFY(named(best, "rounds").searched.empty());
    QVERIFY(named(best, "scale").searched == (std::vector<ParameterValue>{3.0, 4.0}));
    QVERIFY(named(best, "fusion").default_value == named(plain, "fusion").default_value);
  }

  void beginWith_movesAParameterToTheFront() {
    Schema<Tuning> moved = schema();
    moved.begin_with("fusion");

    QCOMPARE(moved.descriptions().front().key, std::string("fusion"));
    QCOMPARE(moved.descriptions()[1].key, schema().descriptions().front().key);
    QCOMPARE(moved.values(Tuning{}).front().first, std::string("fusion"));
    QCOMPARE(moved.parse({{"rounds", 5}}).rounds, 5);
  }

  void searchedValues_haveTheTypeOfTheParameter() {
    Schema<Tuning> searched = schema();

    searched.search("scale", {1, 2.5}).search("rounds", {1, 9}).search("weighted", {0, 1});

    const auto& all = searched.descriptions();
    QVERIFY(all[0].searched == (std::vector<ParameterValue>{1.0, 2.5}));
    QVERIFY(all[1].searched == (std::vector<ParameterValue>{1, 9}));
    QVERIFY(all[2].searched == (std::vector<ParameterValue>{false, true}));
    QVERIFY(all[3].searched.empty());
    QVERIFY(all[4].searched.empty());
    QVERIFY_THROWS_EXCEPTION(InvalidInput, searched.search("scale", {7}));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, searched.search("scael", {1}));
  }
};

}  // namespace episcope::in_schema_test

EPISCOPE_TEST(schema_test, SchemaTest)
#include "schema_test.moc"
