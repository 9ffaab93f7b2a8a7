// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"

#include "app/cli/parameter_options.h"
#include "app/session/command_line.h"
#include "engine/disparity/estimator.h"
#include "engine/disparity/registry.h"
#include "engine/io/models/open_options.h"
#include "engine/labeling/labeler.h"
#include "tests/test_main.h"

#include <optional>

namespace episcope::in_arguments_test {

using namespace episcope::cli;

namespace {

/// What a command line of one option leaves in a variable.
template <class T, class Typed>
T parsed(T value, const OptionValue<Typed>& typed, const std::vector<std::string>& arguments) {
  Arguments parser("verb", {"", ""});
  parser.option("-o,--option", value, typed, "");
  (void)parser.parse(arguments);
  return value;
}

/// The sentence about a wrong command line; empty if it is right.
template <class T, class Typed>
QString refusal(T value, const OptionValue<Typed>& typed, const std::string& text) {
  try {
    (void)parsed(value, typed, {"--option", text});
    return {};
  } catch (const UsageError& error) {
    return QString::fromStdString(error.what());
  }
}

}  // namespace

enum class Format { Text, Json, Csv };

class ArgumentsTest : public QObject {
  Q_OBJECT

 private slots:
  void values_areOfTheirTypes() {
    QCOMPARE(parsed(0, integer_value("N", -5, 5), {"--option", "-3"}), -3);
    QCOMPARE(parsed(0.0, real_value("X", 0, 1), {"--option=+.25"}), 0.25);
    QCOMPARE(parsed(Interval{}, interval_value(), {"-o", "-1.5,2"}), (Interval{-1.5, 2}));
    QCOMPARE(parsed(ViewIndex{}, view_value(), {"-o3,4"}), (ViewIndex{3, 4}));
    QCOMPARE(parsed(Extent{}, extent_value("WxH", 9), {"-o", "8×9"}).second, 9);
    QCOMPARE(parsed(Device::Auto, choice_of<Device>(), {"-o", "cuda"}), Device::Cuda);
    QCOMPARE(parsed(std::string(), text_value("FILE"), {"-o", "a", "-o", "b"}), std::string("b"));
  }

  void help_isWrapped() {
    QCOMPARE(wrapped("one two\nthree four\n  - a list\n  - of two", 9),
             std::string("one two\nthree\nfour\n  - a\n    list\n  - of\n    two"));
    QCOMPARE(wrapped("Größe größer\n", 12), std::string("Größe größer\n"));
    QCOMPARE(help_entry("-o", "to write", 8, 80), std::string("  -o    to write\n"));
    QCOMPARE(help_entry("--output", "to write", 4, 9),
             std::string("  --output\n    to\n    write\n"));
    QCOMPARE(help_entry("--what one|two|three|four", "to show", 8, 17),
             std::string("  --what one|two|\n         three|\n         four\n        to show\n"));
    QCOMPARE(help_entry("--a-long-name-alone", "x", 8, 16),
             std::string("  --a-long-name-alone\n        x\n"));
  }

  void values_stayWhereNothingIsGiven() {
    QCOMPARE(parsed(7, integer_value("N", 0, 1), {}), 7);
    QCOMPARE(parsed(std::optional<int>(), integer_value("N", 0, 1), {}), std::optional<int>());
    QCOMPARE(parsed(std::optional<int>(), integer_value("N", 0, 1), {"--option", ""}),
             std::optional<int>());
  }

  void values_areRefusedWithTheirDomain() {
    QCOMPARE(refusal(0, integer_value("N", 0, 5), "6"),
             QString("--option is '6', but must be a whole number from 0 to 5"));
    QCOMPARE(refusal(0, integer_value("N", 0, 5), "1.5"),
             QString("--option is '1.5', but must be a whole number from 0 to 5"));
    QCOMPARE(refusal(0.0, real_value("X", 0, 0.5), "nan"),
             QString("--option is 'nan', but must be a number from 0 to 0.5"));
    QVERIFY(refusal(Interval{}, interval_value(), "2,2").endsWith("A,B with A < B"));
    QVERIFY(refusal(Interval{}, interval_value(), "0,inf").endsWith("A,B with A < B"));
    QVERIFY(refusal(ViewIndex{}, view_value(), "0,-1").contains("both from 0"));
    QVERIFY(refusal(Extent{}, extent_value("WxH", 9), "0x5").contains("from 1 to 9"));
    QCOMPARE(refusal(Device::Auto, choice_of<Device>(), "cudo"),
             QString("there is no value of --option 'cudo'; did you mean 'cuda'?"));
  }

  void britishSpelling_isUnderstood() {
    int column = 0;
    bool is_normalized = false;
    Arguments parser("verb", {"", ""});
    parser.option("--color", column, integer_value("N", 0, 9), "");
    parser.flag("--normalize", is_normalized, "");

    QVERIFY(parser.parse({"--colour=3", "--normalise"}));

    QCOMPARE(column, 3);
    QVERIFY(is_normalized);
  }

  void flags_standForValuesAndExcludeEachOther() {
    Format format = Format::Text;
    const auto parse = [&format](const std::vector<std::string>& arguments) {
      Arguments parser("verb", {"", ""});
      parser.flag("--json", format, Format::Json, "");
      parser.flag("--csv", format, Format::Csv, "");
      parser.exclude_each_other({"--json", "--csv"});
      return parser.parse(arguments);
    };

    QVERIFY(parse({}));
    QCOMPARE(format, Format::Text);
    QVERIFY(parse({"--csv"}));
    QCOMPARE(format, Format::Csv);
    QVERIFY_THROWS_EXCEPTION(UsageError, (void)parse({"--csv", "--json"}));
  }

  void schema_makesOptions_data() {
    QTest::addColumn<std::vector<ParameterDescription>>("descriptions");
    QTest::newRow("reading") << io::open_schema().descriptions();
    QTest::newRow("running") << run_schema().descriptions();
    QTest::newRow("labelling") << labeler_schema().descriptions();
    for (const Estimator& each : registered_estimators()) {
      QTest::newRow(each.info.id.c_str()) << each.parameters;
    }
  }
  void schema_makesOptions() {
    QFETCH(const std::vector<ParameterDescription>, descriptions);
    const auto values = [&](const std::vector<std::string>& arguments) {
      Arguments parser("verb", {"", ""});
      ParameterOptions options;
      options.declare(parser, descriptions);
      (void)parser.parse(arguments);
      return options.values();
    };

    QVERIFY(values({}).empty());
    for (const ParameterDescription& each : descriptions) {
      const std::string preset = to_text(each.default_value);
      for (const std::string& name : {each.key, option_name(each.key)}) {
        const std::string option = "--" + name;
        if (each.is_toggle) {
          QCOMPARE(values({option}), (ParameterSet{{each.key, true}}));
        } else if (!preset.empty()) {
          QCOMPARE(values({option, preset}), (ParameterSet{{each.key, each.default_value}}));
          QVERIFY_THROWS_EXCEPTION(UsageError, (void)values({option, "no such value"}));
        }
      }
    }
  }
};

}  // namespace episcope::in_arguments_test

EPISCOPE_TEST(arguments_test, ArgumentsTest)
#include "arguments_test.moc"
