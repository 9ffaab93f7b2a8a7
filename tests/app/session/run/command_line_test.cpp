// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/command_line.h"

#include "engine/disparity/registry.h"
#include "engine/io/models/open_options.h"
#include "tests/test_main.h"

namespace episcope::in_command_line_test {

namespace {

// Defaults of EPI_L with one of its numbers moved to the lower end of its domain.
std::pair<ParameterSet, std::string> one_changed() {
  ParameterSet values;
  std::string change;
  for (const ParameterDescription& each : find_estimator("epi_l").parameters) {
    ParameterValue value = each.default_value;
    if (change.empty() && std::holds_alternative<double>(value) &&
        std::get<double>(value) != each.min) {
      value = each.min;
      change = " --" + option_name(each.key) + "=" + to_text(value);
    }
    values.emplace_back(each.key, value);
  }
  return {values, change};
}

}  // namespace

class CommandLineTest : public QObject {
  Q_OBJECT

 private slots:
  void word_isQuotedWhereItMust_data();
  void word_isQuotedWhereItMust();
  void defaults_areLeftOut();
  void autoOfAFile_isLeftOut();
  void changedValue_isNamed();
  void unknownMethod_namesEveryValue();
  void estimateOfOneView_saysSo();
  void overruledConventions_areNamed();
  void readingOptions_readBack();
};

void CommandLineTest::word_isQuotedWhereItMust_data() {
  QTest::addColumn<QString>("word");
  QTest::addColumn<QString>("quoted");
  QTest::newRow("plain") << "/data/still_life-2.h5"
                         << "/data/still_life-2.h5";
  QTest::newRow("empty") << ""
                         << "''";
  QTest::newRow("space") << "my scene"
                         << "'my scene'";
  QTest::newRow("quote") << "it's"
                         << "'it'\\''s'";
  QTest::newRow("variable") << "$HOME"
                            << "'$HOME'";
}

void CommandLineTest::word_isQuotedWhereItMust() {
  QFETCH(QString, word);
  QFETCH(QString, quoted);

  QCOMPARE(QString::fromStdString(shell_quoted(word.toStdString())), quoted);
}

void CommandLineTest::defaults_areLeftOut() {
  ParameterSet defaults;
  for (const auto& each : find_estimator("epi_l").parameters) {
    defaults.emplace_back(each.key, each.default_value);
  }

  QCOMPARE(command_line_for("epi_l", defaults, ViewSelection::All, "demo"),
           std::string("episcope-cli estimate epi_l demo -o epi_l.h5 --views all"));
}

void CommandLineTest::autoOfAFile_isLeftOut() {
  // Result files store "auto" without its type.
  const ParameterSet read{{"range", IntervalOrAuto()}, {"view", IntervalOrAuto()}};

  QVERIFY(changed_parameters("st_av_l", read).empty());
}

void CommandLineTest::changedValue_isNamed() {
  const auto [values, change] = one_changed();
  QVERIFY(!change.empty());

  QCOMPARE(command_line_for("epi_l", values, ViewSelection::All, "my scene"),
           "episcope-cli estimate epi_l 'my scene' -o epi_l.h5 --views all" + change);
}

void CommandLineTest::unknownMethod_namesEveryValue() {
  const ParameterSet values = {{"a", 1}, {"range", IntervalOrAuto(Interval{-1.5, 2})}};

  QCOMPARE(command_line_for("theirs", values, ViewSelection::All, "x"),
           std::string("episcope-cli estimate theirs x -o theirs.h5 --views all --a=1 "
                       "--range=-1.5,2"));
}

void CommandLineTest::estimateOfOneView_saysSo() {
  Estimate estimate;
  estimate.method = "theirs";
  estimate.field.disparity = ViewStack<float>({1, 1}, 2, 2, 1, {4, 4});

  QCOMPARE(command_line_for(estimate, "x"),
           std::string("episcope-cli estimate theirs x -o theirs.h5 --views center"));
}

void CommandLineTest::overruledConventions_areNamed() {
  const ParameterSet reading = {{"flip", "both"},
                                {"units", "without-width"},
                                {"pattern", "a {row} {col}.png"},
                                {"snake", true},
                                {"focus", -0.25}};
  QCOMPARE(reading_options_text({}), std::string());
  QCOMPARE(
      command_line_for("epi_l", {}, ViewSelection::All, "x", reading),
      std::string("episcope-cli estimate epi_l x -o epi_l.h5 --views all --flip=both "
                  "--units=without-width --pattern='a {row} {col}.png' --snake --focus=-0.25"));
}

void CommandLineTest::readingOptions_readBack() {
  const Schema<io::OpenOptions> schema = io::open_schema();
  const ParameterSet given{{"flip", std::string("both")},
                           {"units", std::string("without-width")},
                           {"pattern", std::string("view_{row}_{col}.png")},
                           {"snake", true},
                           {"grid", std::string("1x49")},
                           {"crop", std::string("9x9")},
                           {"mosaic", std::string("lenslets")},
                           {"lenslet", 15.38},
                           {"dataset", std::string("s/LF")},
                           {"axes", std::string("vuyxc")},
                           {"frame", 3},
                           {Reading::kFocus, -0.1},
                           {"levels", std::string("0,1023")},
                           {"equalize", true},
                           {"no-equalize", true}};
  QCOMPARE(given.size(), schema.descriptions().size());

  const QString text = QString::fromStdString(reading_options_text(given)).remove('\'');

  ParameterSet read;
  for (const QString& word : text.split(' ', Qt::SkipEmptyParts)) {
    QVERIFY2(word.startsWith("--"), qPrintable(word));
    const std::string key = word.section('=', 0, 0).mid(2).toStdString();
    const std::string value = word.contains('=') ? word.section('=', 1).toStdString() : "true";
    read.emplace_back(key, parse_parameter(schema.description(key), value));
  }
  QVERIFY(read == given);
  QVERIFY(io::given_options(schema.parse(read)) == given);
}

}  // namespace episcope::in_command_line_test

EPISCOPE_CORE_TEST(command_line_test, CommandLineTest)
#include "command_line_test.moc"
