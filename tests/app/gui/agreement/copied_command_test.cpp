// SPDX-License-Identifier: BSD-3-Clause
// A run of the window and the line of "Copy as command" give the same maps, for every method.
#include "app/gui/estimate/estimate_controller.h"
#include "app/gui/estimate/result_export.h"
#include "engine/disparity/registry.h"
#include "engine/io/models/result_file.h"
#include "tests/app/gui/agreement/command_line.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/panels/method_panel.h"

#include <QClipboard>
#include <QDir>
#include <QFile>
#include <QGuiApplication>

#include <algorithm>
#include <cstring>

namespace episcope::in_copied_command_test {

namespace {

constexpr GridShape kGrid{5, 5};

scenes::RenderOptions tiny_options() {
  scenes::RenderOptions options;
  options.grid = kGrid;
  options.height = options.width = 32;
  return options;
}

/// A value of three digits, as people type them.
double other_number(const ParameterDescription& parameter) {
  const double preset = std::get<double>(parameter.default_value);
  const auto three_digits = [](double value) { return QString::number(value, 'g', 3).toDouble(); };
  const double less = three_digits(preset * 0.8);
  if (less != preset && less >= parameter.min) return less;
  const double more = three_digits(preset * 1.2);
  return more != preset && more <= parameter.max ? more : parameter.max;
}

int other_integer(const ParameterDescription& parameter) {
  constexpr int kMostWork = 9;  // iterations and labels
  const int preset = std::get<int>(parameter.default_value);
  const auto least = static_cast<int>(parameter.min);
  const int less = std::max(least, std::min(preset - 1, kMostWork));
  return less != preset ? less : preset + 1;
}

std::string other_choice(const ParameterDescription& parameter) {
  const auto& choices = parameter.choices;
  if (choices.empty()) return std::get<std::string>(parameter.default_value);  // a file
  const auto preset = std::ranges::find(choices, std::get<std::string>(parameter.default_value));
  return preset + 1 == choices.end() ? choices.front() : *(preset + 1);
}

/// Another value than the default, but for files.
ParameterValue other_value(const ParameterDescription& parameter) {
  const ParameterValue& preset = parameter.default_value;
  if (const bool* flag = std::get_if<bool>(&preset)) return !*flag;
  if (std::holds_alternative<int>(preset)) return other_integer(parameter);
  if (std::holds_alternative<double>(preset)) return other_number(parameter);
  if (std::holds_alternative<std::string>(preset)) return other_choice(parameter);
  if (std::holds_alternative<ViewOrAuto>(preset)) return ViewOrAuto(ViewIndex{2, 1});
  return IntervalOrAuto(Interval{-1.25, 1.5});
}

ParameterSet other_values(const Estimator& estimator) {
  ParameterSet values;
  for (const auto& each : estimator.parameters) values.emplace_back(each.key, other_value(each));
  return values;
}

template <class T>
bool is_same(const ViewStack<T>& a, const ViewStack<T>& b) {
  return a.grid() == b.grid() && a.first() == b.first() && a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool is_same(const DisparityField& a, const DisparityField& b) {
  return is_same(a.disparity, b.disparity) && is_same(a.valid, b.valid);
}

/// What differs between two results; the time that they took aside.
QString difference(const Estimate& a, const Estimate& b) {
  QStringList parts;
  if (!is_same(a.field, b.field)) parts << "disparity";
  if (!is_same(a.confidence, b.confidence)) parts << "confidence";
  if (!is_same(a.layered.foreground, b.layered.foreground)) parts << "foreground";
  if (!is_same(a.layered.background, b.layered.background)) parts << "background";
  if (!is_same(a.layered.layers, b.layered.layers)) parts << "layers";
  if (!is_same(a.second, b.second)) parts << "second";
  if (a.method != b.method) parts << "method";
  if (a.parameters != b.parameters) parts << "parameters";
  if (!(a.range == b.range)) parts << "range";
  if (a.notes != b.notes) parts << "notes";
  if (a.source_hash != b.source_hash) parts << "samples";
  if (!(a.reading == b.reading)) parts << "reading";
  return parts.join(", ");
}

QString text_of(const ParameterSet& values) {
  QStringList texts;
  for (const auto& [key, value] : values) {
    texts << QString::fromStdString(key + " " + to_text(value));
  }
  return texts.join(", ");
}

class Running : public WindowFixture {
 public:
  Running() { openScene("transparent", tiny_options()); }

  /// What the window exports of the newest result.
  Estimate exported() {
    const QString file = path("exported.h5");
    export_result(window.bench(), window.bench().session.estimates().back(), file);
    [&] {
      QVERIFY(QTest::qWaitFor(
          [&] { return QFile::exists(file) && window.bench().jobs.count() == 0; }, kPatience));
    }();
    return io::read_result(file.toStdString(), kGrid);
  }

  /// What comes of the line in the clipboard.
  Estimate pasted(const std::string& method) {
    QDir().mkpath(path("pasted"));
    const QString line = QGuiApplication::clipboard()->text();
    const CommandLineRun run = run_pasted(line, path("pasted"));
    [&] { QVERIFY2(run.exit_code == 0, qPrintable(line + '\n' + run.error)); }();
    if (run.exit_code != 0) return {};
    return io::read_result(path("pasted").toStdString() + "/" + method + ".h5", kGrid);
  }
};

}  // namespace

class CopiedCommandTest : public QObject {
  Q_OBJECT

 private slots:
  void everyMethod_runsAsItsCopiedLine_data();
  void everyMethod_runsAsItsCopiedLine();
  void conventions_areInTheCopiedLine();
};

void CopiedCommandTest::everyMethod_runsAsItsCopiedLine_data() {
  QTest::addColumn<QString>("method");
  QTest::addColumn<bool>("has_defaults");
  QTest::addColumn<bool>("all_views");
  for (const Estimator& estimator : registered_estimators()) {
    const QString id = QString::fromStdString(estimator.info.id);
    QTest::newRow(qPrintable(id + " with defaults")) << id << true << false;
    QTest::newRow(qPrintable(id + " with other parameters")) << id << false << false;
  }
  QTest::newRow("epi_s of all views") << QString("epi_s") << false << true;
}

void CopiedCommandTest::everyMethod_runsAsItsCopiedLine() {
  QFETCH(QString, method);
  QFETCH(bool, has_defaults);
  QFETCH(bool, all_views);
  Running f;
  const Estimator estimator = find_estimator(method.toStdString());
  auto& panel = find<MethodPanel>(f.window);
  const ParameterSet values = has_defaults ? ParameterSet() : other_values(estimator);
  panel.setRequest({estimator.info.id, values, all_views});
  if (!has_defaults) QCOMPARE(text_of(panel.request().values), text_of(other_values(estimator)));

  f.runAndWait();
  const Estimate of_window = f.exported();
  find<EstimateController>(f.window).copyCommand();
  const Estimate of_line = f.pasted(estimator.info.id);

  QCOMPARE(difference(of_window, of_line), QString());
  QCOMPARE(of_window.field.disparity.grid().count() > 1, all_views);
}

void CopiedCommandTest::conventions_areInTheCopiedLine() {
  Running f;
  const auto before = f.window.bench().session.scene();
  f.window.bench().opener.reopenWith({{"flip", std::string("u")}, {"focus", 0.5}});
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().session.scene() != before, kScenePatience);
  find<MethodPanel>(f.window).setRequest({"epi_l", {{"fusion_power", 1}}, true});

  f.runAndWait();
  const Estimate of_window = f.exported();
  find<EstimateController>(f.window).copyCommand();
  const Estimate of_line = f.pasted("epi_l");

  QCOMPARE(difference(of_window, of_line), QString());
  QCOMPARE(of_line.reading.options.size(), 2U);
}

}  // namespace episcope::in_copied_command_test

EPISCOPE_WINDOW_TEST(copied_command_test, CopiedCommandTest)
#include "copied_command_test.moc"
