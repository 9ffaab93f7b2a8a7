// SPDX-License-Identifier: BSD-3-Clause
// The numbers of the window's table are those of the command line, key by key.
#include "tests/app/gui/agreement/command_line.h"
#include "tests/app/gui/agreement/sample_scene.h"
#include "tests/window_test_main.h"
#include "widgets/panels/metric_table.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

#include <map>

namespace episcope::in_numbers_test {

namespace {

/// Numbers of one result, by key: "vmv2013.mse_100".
using Numbers = std::map<QString, double>;

Numbers numbers_in_table(const WindowFixture& f, const std::string& result) {
  const QStringList lines =
      find<MetricTable>(f.window).toCsv().remove('\r').split('\n', Qt::SkipEmptyParts);
  const QStringList keys = lines.value(0).split(',');
  Numbers numbers;
  for (const QString& line : lines.mid(1)) {
    const QStringList cells = line.split(',');
    if (cells.value(0).toStdString() != result) continue;
    for (qsizetype i = 1; i < keys.indexOf("region"); ++i) {  // then it says what was judged
      if (!cells.value(i).isEmpty()) numbers[keys[i]] = cells[i].toDouble();
    }
  }
  return numbers;
}

/// The same of `evaluate`: of a protocol that cannot judge, none. The time is in the table anyway.
Numbers numbers_of_evaluate(AgreementFixture& f, const EstimateEntry& entry) {
  Numbers numbers{{"seconds", entry.estimate->seconds}};
  for (const char* protocol : {"vmv2013", "benchmark2016"}) {
    const CommandLineRun run = run_command_line(
        QStringList{"evaluate", f.exported(entry), "--json", "--protocol", protocol, "--truth"} +
            f.input(),
        f.path("."));
    if (run.exit_code != 0) continue;
    const QJsonObject json = QJsonDocument::fromJson(run.output.toUtf8()).object();
    const QJsonObject result = json["results"][0].toObject();
    for (auto each = result.begin(); each != result.end(); ++each) {
      if (!each->isDouble()) continue;
      const bool is_metric = each.key() != "seconds";
      numbers[is_metric ? QString(protocol) + '.' + each.key() : each.key()] = each->toDouble();
    }
  }
  return numbers;
}

/// What only one side has, and what differs.
QString difference(const Numbers& table, const Numbers& command_line) {
  QStringList texts;
  for (const auto& [key, value] : table) {
    const auto other = command_line.find(key);
    if (other == command_line.end()) {
      texts << key + " stands in the table alone";
    } else if (other->second != value) {
      texts << QString("%1 is %2 in the table, but %3").arg(key).arg(value).arg(other->second);
    }
  }
  for (const auto& [key, value] : command_line) {
    if (!table.contains(key)) texts << key + " is missing in the table";
  }
  return texts.join('\n');
}

}  // namespace

class NumbersTest : public QObject {
  Q_OBJECT

 private slots:
  void table_isThatOfEvaluate_data();
  void table_isThatOfEvaluate();
};

void NumbersTest::table_isThatOfEvaluate_data() {
  QTest::addColumn<const SampleScene*>("sample");
  for (const SampleScene& sample : sample_scenes()) QTest::newRow(sample.name) << &sample;
}

void NumbersTest::table_isThatOfEvaluate() {
  QFETCH(const SampleScene*, sample);
  AgreementFixture f(*sample);
  const bool has_truth = sample->truth != SampleScene::Truth::None;
  const Numbers of_first = numbers_of_evaluate(f, f.first());
  QCOMPARE(of_first.size() > 1, has_truth);
  const bool has_normals = of_first.contains("benchmark2016.mae_planes");
  QVERIFY(sample->has_camera || !has_normals);
  QVERIFY(has_normals || !sample->is_benchmark_form || !sample->has_camera);
  if (!has_truth) return;  // there is no table

  for (const EstimateEntry* entry : {&f.first(), &f.second()}) {
    const Numbers expected = numbers_of_evaluate(f, *entry);
    // The table follows its results in the background.
    const auto of_table = [&] { return numbers_in_table(f, entry->name); };
    (void)QTest::qWaitFor([&] { return of_table() == expected; }, kPatience);
    const QString differences = difference(of_table(), expected);
    QVERIFY2(differences.isEmpty(),
             qPrintable(QString::fromStdString(entry->name) + ":\n" + differences));
  }
}

}  // namespace episcope::in_numbers_test

EPISCOPE_WINDOW_TEST(numbers_test, NumbersTest)
#include "numbers_test.moc"
