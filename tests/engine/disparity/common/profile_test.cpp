// SPDX-License-Identifier: BSD-3-Clause
// The ten methods of the paper, tuned and as published.
#include "engine/disparity/estimator.h"

#include "engine/disparity/registry.h"
#include "engine/scenes/builtin.h"
#include "tests/test_main.h"

#include <cmath>
#include <map>

namespace episcope::in_profile_test {

namespace {

const ParameterSet kPaper{{kProfileKey, std::string(kPaperProfile)}};
constexpr const char* kScenes[] = {"demo", "objects", "bars", "edge"};
constexpr const char* kMethods[] = {"epi_l",   "epi_s",   "epi_c",   "epi_g",   "st_av_l",
                                    "st_av_s", "st_av_g", "st_ch_l", "st_ch_s", "st_ch_g"};

// What stands in for the paper's scenes.
const Scene& scene(const std::string& id) {
  static std::map<std::string, Scene> kept;
  if (const auto found = kept.find(id); found != kept.end()) return found->second;
  scenes::RenderOptions options;
  options.height = 96;
  options.width = 96;
  options.seed = 3;
  options.noise_sigma = 2;  // without any, thin bars leave nothing to smooth
  return kept.emplace(id, scenes::render_builtin(id, options, Progress())).first->second;
}

Estimate run(const std::string& method, const std::string& id, const ParameterSet& values) {
  return find_estimator(method).run(*scene(id).light_field, values,
                                    {.views = ViewSelection::Center}, Progress());
}

// Mean squared error of the center view.
double mse(const std::string& method, const std::string& id) {
  const Estimate estimate = run(method, id, kPaper);
  const ViewIndex view = scene(id).light_field->center();
  const float* const map = estimate.field.disparity.view(view).data;
  const float* const truth = scene(id).truth->field.disparity.view(view).data;
  const std::size_t count = estimate.field.disparity.view_size();
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += std::pow(map[i] - truth[i], 2);
  return sum / static_cast<double>(count);
}

ParameterValue value_of(const Estimate& estimate, const std::string& key) {
  for (const auto& [name, value] : estimate.parameters) {
    if (name == key) return value;
  }
  qFatal("no such parameter");
}

}  // namespace

class ProfileTest : public QObject {
  Q_OBJECT

 private slots:
  void paper_runsAndDiffersFromTuned_data();
  void paper_runsAndDiffersFromTuned();
  void values_areStoredAndGivenOnesWin_data();
  void values_areStoredAndGivenOnesWin();
  void smoothing_helpsAsInThePaper_data();
  void smoothing_helpsAsInThePaper();
  void choice_isTheFirstParameter();
  void otherMethods_haveNone();
};

void add_methods() {
  QTest::addColumn<QString>("method");
  for (const char* method : kMethods) QTest::newRow(method) << method;
}

void ProfileTest::paper_runsAndDiffersFromTuned_data() {
  add_methods();
}

void ProfileTest::paper_runsAndDiffersFromTuned() {
  QFETCH(QString, method);
  const Estimate paper = run(method.toStdString(), "objects", kPaper);
  const Estimate tuned = run(method.toStdString(), "objects", {});
  const float* const a = paper.field.disparity.data();
  const float* const b = tuned.field.disparity.data();
  int differ = 0;
  for (std::size_t i = 0; i < paper.field.disparity.size(); ++i) {
    QVERIFY(a[i] >= paper.range.min - 1e-6 && a[i] <= paper.range.max + 1e-6);
    differ += std::fabs(a[i] - b[i]) > 1e-3F ? 1 : 0;
  }
  QVERIFY2(differ > 900, qPrintable(QString::number(differ)));  // a tenth of the pixels
}

void ProfileTest::values_areStoredAndGivenOnesWin_data() {
  add_methods();
}

void ProfileTest::values_areStoredAndGivenOnesWin() {
  QFETCH(QString, method);
  const Estimator estimator = find_estimator(method.toStdString());
  const ParameterSet preset = preset_values(estimator.parameters, kPaper);
  QVERIFY(!preset.empty());
  const auto& [given, published] = preset.front();
  const auto found = std::ranges::find(estimator.parameters, given, &ParameterDescription::key);
  ParameterSet values{{given, found->default_value}};
  values.insert(values.end(), kPaper.begin(), kPaper.end());

  const Estimate estimate = run(method.toStdString(), "edge", values);

  QVERIFY(value_of(estimate, kProfileKey) == ParameterValue(std::string(kPaperProfile)));
  QVERIFY(value_of(estimate, given) == found->default_value);
  for (std::size_t i = 1; i < preset.size(); ++i) {
    QVERIFY2(value_of(estimate, preset[i].first) == preset[i].second, preset[i].first.c_str());
  }
}

void ProfileTest::smoothing_helpsAsInThePaper_data() {
  QTest::addColumn<QString>("local");
  QTest::addColumn<QString>("smooth");
  for (const char* data : {"epi", "st_av", "st_ch"}) {
    const QString local = QString(data) + "_l", smooth = QString(data) + "_s";
    QTest::newRow(data) << local << smooth;
  }
}

// Figure 7: on every scene.
void ProfileTest::smoothing_helpsAsInThePaper() {
  QFETCH(QString, local);
  QFETCH(QString, smooth);
  for (const char* id : kScenes) {
    const double before = mse(local.toStdString(), id), after = mse(smooth.toStdString(), id);
    QVERIFY2(after <= before, qPrintable(QString("%1: %2, %3").arg(id).arg(before).arg(after)));
  }
}

void ProfileTest::choice_isTheFirstParameter() {
  for (const char* method : kMethods) {
    const ParameterDescription first = find_estimator(method).parameters.front();
    QCOMPARE(first.key, std::string(kProfileKey));
    QVERIFY(first.default_value == ParameterValue(std::string("tuned")));
    QVERIFY(presets_text(first).starts_with("paper sets "));
  }
}

// The paper gives its two-layer method no figures.
void ProfileTest::otherMethods_haveNone() {
  for (const ParameterDescription& parameter : find_estimator("epi_two_layer").parameters) {
    QVERIFY(parameter.key != kProfileKey);
  }
}

}  // namespace episcope::in_profile_test

EPISCOPE_TEST(profile_test, ProfileTest)
#include "profile_test.moc"
