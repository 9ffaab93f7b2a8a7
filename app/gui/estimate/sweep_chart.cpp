// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/estimate/sweep_chart.h"

#include "engine/disparity/registry.h"
#include "widgets/controls/text.h"

#include <QCoreApplication>

#include <algorithm>
#include <functional>
#include <span>

namespace episcope {

namespace {

struct SweepPlotText {
  Q_DECLARE_TR_FUNCTIONS(episcope::SweepPlot)
};

struct Measured {
  SweepMeasure measure;
  const char* name;
};
// Measures in the order of the lists, first those that need ground truth.
constexpr Measured kMeasures[] = {
    {SweepMeasure::MseTimes100,
     QT_TRANSLATE_NOOP("episcope::SweepPlot", "MSE×100, all pixels [px²]")},
    {SweepMeasure::BadPix007, QT_TRANSLATE_NOOP("episcope::SweepPlot", "BadPix 0.07, 2016 [%]")},
    {SweepMeasure::BadPix003, QT_TRANSLATE_NOOP("episcope::SweepPlot", "BadPix 0.03, 2016 [%]")},
    {SweepMeasure::BadPix001, QT_TRANSLATE_NOOP("episcope::SweepPlot", "BadPix 0.01, 2016 [%]")},
    {SweepMeasure::Change, QT_TRANSLATE_NOOP("episcope::SweepPlot", "Change of the map [px]")},
    {SweepMeasure::Seconds, QT_TRANSLATE_NOOP("episcope::SweepPlot", "Time [s]")}};
constexpr int kOfTruth = 4;  // of them

bool has_points(const Sweep& sweep) {
  return std::ranges::any_of(sweep.scenes, [](const auto& each) { return !each.points.empty(); });
}

std::span<const Measured> measures_of(const Sweep& sweep, bool expects_truth = true) {
  const std::span all(kMeasures);
  const bool is_judged = std::ranges::any_of(sweep.scenes, has_truth);
  return is_judged || (expects_truth && !has_points(sweep)) ? all : all.subspan(kOfTruth);
}

// NaN where there is none, which is not drawn.
using Value = std::function<std::optional<double>(std::size_t point)>;

// As the form names the second parameter; empty with one.
QString line_name(const Sweep& sweep, const SweepLine& line) {
  if (!line.second) return {};
  return labeled_value_text(find_estimator(sweep.base.method).parameters, sweep.swept[1].key,
                            *line.second);
}

void add_line(SweepChart& chart, const SweepLine& line, const QString& name,
              std::optional<std::size_t> scene, const Value& value) {
  PlotSeries& series = chart.plot.series.emplace_back();
  series.name = name;
  auto& places = chart.places.emplace_back();
  for (const SweepLine::Place& place : line.places) {
    series.points.emplace_back(place.x, value(place.point).value_or(qQNaN()));
    places.push_back({scene, place.point});
  }
}

void add_scene(SweepChart& chart, const Sweep& sweep, std::size_t place, SweepMeasure measure,
               bool is_named) {
  const SweepScene& scene = sweep.scenes[place];
  const auto value = [&](std::size_t point) { return measure_of(scene.points[point], measure); };
  for (const SweepLine& line : lines_of(scene.points, sweep.swept)) {
    const QString name = is_named ? QString::fromStdString(scene.name) : line_name(sweep, line);
    add_line(chart, line, name, place, value);
  }
}

void add_mean(SweepChart& chart, const Sweep& sweep, SweepMeasure measure) {
  const auto& all = sweep.scenes.front().points;
  const auto count = static_cast<std::ptrdiff_t>(common_count(sweep.scenes));
  const std::vector<SweepPoint> common(all.begin(), all.begin() + count);
  const auto value = [&](std::size_t point) { return mean_of(sweep.scenes, point, measure); };
  for (const SweepLine& line : lines_of(common, sweep.swept)) {
    const QString name = line_name(sweep, line);
    add_line(chart, line, name.isEmpty() ? SweepPlotText::tr("Mean") : name, std::nullopt, value);
  }
}

// " (10 of 20 runs)" of a sweep that has not been finished; else empty.
QString unfinished_text(const Sweep& sweep) {
  const auto& parameters = find_estimator(sweep.base.method).parameters;
  const auto described = described_under(parameters, sweep.base.parameters);
  const std::size_t planned =
      sweep_points(described, sweep.base.parameters, sweep.swept).size() * sweep.scenes.size();
  const std::size_t done = point_count(sweep);
  return done < planned ? SweepPlotText::tr(" (%1 of %2 runs)").arg(done).arg(planned) : QString();
}

}  // namespace

QString axis_text(const ParameterDescription& description) {
  const QString label = schema_text(description.label);
  return description.unit.empty() ? label
                                  : QString("%1 [%2]").arg(label, schema_text(description.unit));
}

QStringList measure_names(const Sweep& sweep, bool expects_truth) {
  QStringList names;
  for (const Measured& each : measures_of(sweep, expects_truth))
    names << SweepPlotText::tr(each.name);
  return names;
}

QStringList scene_choices(const Sweep& sweep) {
  if (sweep.scenes.size() < 2) return {};
  QStringList names{sweep.swept.size() < 2 ? SweepPlotText::tr("Each and the mean")
                                           : SweepPlotText::tr("Mean")};
  for (const SweepScene& each : sweep.scenes) names << QString::fromStdString(each.name);
  return names;
}

SweepChart chart_of(const Sweep& sweep, int measure, int choice) {
  SweepChart chart;
  const auto measures = measures_of(sweep);
  if (sweep.scenes.empty() || measure < 0 || measure >= std::ssize(measures)) return chart;
  for (const ParameterDescription& each : find_estimator(sweep.base.method).parameters) {
    if (each.key == sweep.swept.front().key) chart.plot.x = {axis_text(each), each.logarithmic};
  }
  const Measured& measured = measures[static_cast<std::size_t>(measure)];
  chart.plot.y = {SweepPlotText::tr(measured.name)};
  const bool is_one = sweep.scenes.size() == 1;
  if (is_one || (choice > 0 && choice <= std::ssize(sweep.scenes))) {
    const int place = is_one ? 0 : choice - 1;
    add_scene(chart, sweep, static_cast<std::size_t>(place), measured.measure, false);
    return chart;
  }
  for (std::size_t i = 0; sweep.swept.size() < 2 && i < sweep.scenes.size(); ++i) {
    add_scene(chart, sweep, i, measured.measure, true);
  }
  add_mean(chart, sweep, measured.measure);
  return chart;
}

std::optional<PlotPlace> place_in(const SweepChart& chart, SweepPlace point) {
  std::optional<PlotPlace> mean;
  for (std::size_t line = 0; line < chart.places.size(); ++line) {
    for (std::size_t i = 0; i < chart.places[line].size(); ++i) {
      const SweepChart::Place& each = chart.places[line][i];
      if (each.point != point.point) continue;
      if (each.scene == point.scene) return PlotPlace{line, i};
      if (!each.scene) mean = {line, i};
    }
  }
  return mean;
}

QString title_of(const Sweep& sweep) {
  const Estimator& estimator = find_estimator(sweep.base.method);
  QStringList parts{QString::fromStdString(estimator.info.name)};
  for (const SweptParameter& each : sweep.swept) {
    parts << parameter_label(estimator.parameters, each.key);
  }
  const QString what = parts.join(", ");
  if (sweep.scenes.size() > 1)
    return SweepPlotText::tr("%1 · %2 light fields").arg(what).arg(sweep.scenes.size()) +
           unfinished_text(sweep);
  return sweep.scenes.empty()
             ? what
             : QString("%1 · %2").arg(what, QString::fromStdString(sweep.scenes.front().name)) +
                   unfinished_text(sweep);
}

QString name_of(const Sweep& sweep, const SweepPoint& point) {
  const Estimator& method = find_estimator(sweep.base.method);
  QStringList texts{QString::fromStdString(method.info.name)};
  for (const auto& [key, value] : point.point) {
    texts << labeled_value_text(method.parameters, key, value);
  }
  return texts.join(", ");
}

QString text_of(const Sweep& sweep, SweepPlace place) {
  const SweepScene& scene = sweep.scenes[place.scene];
  const SweepPoint& point = scene.points[place.point];
  QStringList texts;
  if (sweep.scenes.size() > 1) texts << QString::fromStdString(scene.name);
  texts << name_of(sweep, point);
  if (!point.problem.empty()) texts << QString::fromStdString(point.problem);
  if (const auto mse = measure_of(point, SweepMeasure::MseTimes100)) {
    texts << SweepPlotText::tr("MSE×100 %1").arg(number_text(*mse, 3));
  }
  if (const auto bad = measure_of(point, SweepMeasure::BadPix007)) {
    texts << SweepPlotText::tr("BadPix %1 %").arg(number_text(*bad, 2));
  }
  if (point.seconds > 0) texts << SweepPlotText::tr("%1 s").arg(number_text(point.seconds, 2));
  return texts.join(" · ");
}

}  // namespace episcope
