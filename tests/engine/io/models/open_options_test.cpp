// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/open_options.h"
#include "engine/core/error.h"
#include "engine/io/models/reader.h"
#include "tests/test_main.h"

#include <set>

namespace episcope::in_open_options_test {

namespace {

/// Texts of values that are not automatic, as on a command line.
std::vector<std::string> other_texts(const ParameterDescription& option) {
  const ParameterValue& preset = option.default_value;
  if (std::holds_alternative<bool>(preset)) return {"true"};
  if (std::holds_alternative<int>(preset)) return {"7", to_text(option.max)};
  if (std::holds_alternative<double>(preset)) {
    return {"0.1", option.min < 0 ? "-2" : "2.5", to_text(option.max)};
  }
  if (option.choices.empty()) return {"view_{row}_{col}.png", "it's *{index}.tif"};
  std::vector<std::string> texts;
  for (const std::string& choice : option.choices) {
    if (choice != std::get<std::string>(preset)) texts.push_back(choice);
  }
  return texts;
}

QString refusal_of(const ParameterSet& options) {
  try {
    (void)io::open_schema().parse(options);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

}  // namespace

class OpenOptionsTest : public QObject {
  Q_OBJECT

 private slots:
  void givenOption_readsBack_data();
  void givenOption_readsBack();
  void allOptions_readBackTogether();
  void automaticOptions_areNotGiven();
  void wholeLensletOfAnOlderFile_isRead();
  void unknownOption_isRefusedByName();
  void wrongValue_isRefusedByName();
  void readers_nameOptionsThatThereAre();
};

void OpenOptionsTest::givenOption_readsBack_data() {
  QTest::addColumn<QString>("key");
  QTest::addColumn<QString>("text");
  for (const ParameterDescription& option : io::open_schema().descriptions()) {
    for (const std::string& text : other_texts(option)) {
      QTest::newRow((option.key + " " + text).c_str())
          << QString::fromStdString(option.key) << QString::fromStdString(text);
    }
  }
}

void OpenOptionsTest::givenOption_readsBack() {
  QFETCH(QString, key);
  QFETCH(QString, text);
  const Schema<io::OpenOptions> schema = io::open_schema();
  const std::string name = key.toStdString();

  const ParameterSet given{{name, parse_parameter(schema.description(name), text.toStdString())}};

  QVERIFY(io::given_options(schema.parse(given)) == given);
  QCOMPARE(QString::fromStdString(to_text(given.front().second)), text);
}

void OpenOptionsTest::allOptions_readBackTogether() {
  const Schema<io::OpenOptions> schema = io::open_schema();
  ParameterSet given;
  for (const ParameterDescription& option : schema.descriptions()) {
    given.emplace_back(option.key, parse_parameter(option, other_texts(option).front()));
  }

  QVERIFY(io::given_options(schema.parse(given)) == given);
}

void OpenOptionsTest::automaticOptions_areNotGiven() {
  QVERIFY(io::given_options({}).empty());
  QVERIFY(io::given_options(io::open_schema().parse({})).empty());
}

void OpenOptionsTest::wholeLensletOfAnOlderFile_isRead() {
  const ParameterSet stored{{"lenslet", 14}, {"frame", 2}};

  const io::OpenOptions options = io::open_schema().parse(io::stored_options(stored));

  QCOMPARE(options.lenslet, 14.0);
  QCOMPARE(options.frame, 2);
}

void OpenOptionsTest::unknownOption_isRefusedByName() {
  const QString sentence = refusal_of({{"snak", true}});

  QVERIFY2(sentence.contains("'snak'") && sentence.contains("did you mean 'snake'"),
           qPrintable(sentence));
}

void OpenOptionsTest::wrongValue_isRefusedByName() {
  const QString of_choice = refusal_of({{"flip", std::string("sideways")}});
  QVERIFY2(of_choice.contains("flip") && of_choice.contains("sideways"), qPrintable(of_choice));

  const QString of_number = refusal_of({{Reading::kFocus, 1e6}});
  QVERIFY2(of_number.contains("focus"), qPrintable(of_number));

  const QString of_type = refusal_of({{"snake", 1.5}});
  QVERIFY2(of_type.contains("snake"), qPrintable(of_type));
}

void OpenOptionsTest::readers_nameOptionsThatThereAre() {
  const Schema<io::OpenOptions> schema = io::open_schema();
  std::set<std::string> named;
  std::set<std::string> ids;

  for (const io::Reader& reader : io::readers()) {
    QVERIFY2(ids.insert(reader.id).second, reader.id);
    QCOMPARE(io::reader_named(reader.id), &reader);
    QVERIFY2(reader.has_option("flip"), reader.id);
    QVERIFY2(!reader.has_option("snak"), reader.id);
    QVERIFY2(!reader.has_option(Reading::kFocus), reader.id);  // that of all
    QVERIFY2(reader.has_option("equalize"), reader.id);
    QVERIFY2(reader.has_option("no-equalize"), reader.id);
    for (const ParameterDescription& option : schema.descriptions()) {
      if (reader.has_option(option.key)) named.insert(option.key);
    }
    for (const char* key : reader.options) QCOMPARE(schema.description(key).key, std::string(key));
  }

  // Every option means something to somebody.
  for (const ParameterDescription& option : schema.descriptions()) {
    QVERIFY2(named.contains(option.key) || option.key == Reading::kFocus, option.key.c_str());
  }
}

}  // namespace episcope::in_open_options_test

EPISCOPE_TEST(open_options_test, OpenOptionsTest)
#include "open_options_test.moc"
