// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/estimate/sweep_plot.h"

#include "engine/core/text/join.h"
#include "engine/disparity/registry.h"
#include "widgets/style/number_text.h"
#include "widgets/style/schema_text.h"

#include <QCoreApplication>

#include <algorithm>
#include <span>

namespace episcope {
namespace {

struct Text {
  Q_DECLARE_TR_FUNCTIONS(episcope::SweepPlot)
};

struct Measured {
  SweepMeasure measure;
  const char* name;
};
// In the order of the lists; what needs ground truth comes first.
constexpr Measured kMeasures[] = {
    {SweepMeasure::MseTimes100,
     QT_TRANSLATE_NOOP("episcope::SweepPlot", "MSE×100, all pixels [px²]")},
    {SweepMeasure::BadPix007, QT_TRANSLATE_NOOP("episcope::SweepPlot", "BadPix 0.07, 2016 [%]")},
    {SweepMeasure::BadPix003, QT_TRANSLATE_NOOP("episcope::SweepPlot", "BadPix 0.03, 2016 [%]")},
    {SweepMeasure::BadPix001, QT_TRANSLATE_NOOP("episcope::SweepPlot", "BadPix 0.01, 2016 [%]")},
    {SweepMeasure::Change, QT_TRANSLATE_NOOP("episcope::SweepPlot", "Change of the map [px]")},
    {SweepMeasure::Seconds, QT_TRANSLATE_NOOP("episcope::SweepPlot", "Time [s]")}};
constexpr int kOfTruth = 4;  // of them

std::span<const Measured> measures_of(const Sweep& sweep) {
  const std::span all(kMeasures);
  return sweep.points.empty() || sweep.has_truth ? all : all.subspan(kOfTruth);
}

}  // namespace

QString axis_text(const ParameterDescription& description) {
  const QString label = schema_text(description.label);
  return description.unit.empty() ? label
                                  : QString("%1 [%2]").arg(label, schema_text(description.unit));
}

QStringList measure_names(const Sweep& sweep) {
  QStringList names;
  for (const Measured& each : measures_of(sweep)) names << Text::tr(each.name);
  return names;
}

Plot plot_of(const Sweep& sweep, int measure) {
  Plot plot;
  const auto measures = measures_of(sweep);
  if (sweep.swept.empty() || measure < 0 || measure >= std::ssize(measures)) return plot;
  for (const ParameterDescription& each : find_estimator(sweep.base.method).parameters) {
    if (each.key == sweep.swept.front().key) plot.x = {axis_text(each), each.logarithmic};
  }
  const Measured& measured = measures[static_cast<std::size_t>(measure)];
  plot.y = {Text::tr(measured.name)};
  for (const SweepLine& line : sweep.lines) {
    PlotSeries& series = plot.series.emplace_back();
    series.name = QString::fromStdString(line.name);
    for (const SweepLine::Place& place : line.places) {
      const auto value = measure_of(sweep.points[place.point], measured.measure);
      series.points.emplace_back(place.x, value.value_or(qQNaN()));
    }
  }
  return plot;
}

std::optional<PlotPlace> place_of(const Sweep& sweep, std::size_t point) {
  for (std::size_t line = 0; line < sweep.lines.size(); ++line) {
    const auto& places = sweep.lines[line].places;
    const auto found = std::ranges::find(places, point, &SweepLine::Place::point);
    if (found == places.end()) continue;
    return PlotPlace{line, static_cast<std::size_t>(found - places.begin())};
  }
  return std::nullopt;
}

std::string name_of(const Sweep& sweep, const SweepPoint& point) {
  return find_estimator(sweep.base.method).info.name + ", " +
         joined(point.point, ", ",
                [](const auto& each) { return each.first + " " + to_text(each.second); });
}

QString text_of(const Sweep& sweep, const SweepPoint& point) {
  QStringList texts{QString::fromStdString(name_of(sweep, point))};
  if (!point.problem.empty()) texts << QString::fromStdString(point.problem);
  if (const auto mse = measure_of(point, SweepMeasure::MseTimes100)) {
    texts << Text::tr("MSE×100 %1").arg(number_text(*mse, 3));
  }
  if (const auto bad = measure_of(point, SweepMeasure::BadPix007)) {
    texts << Text::tr("BadPix %1 %").arg(number_text(*bad, 2));
  }
  if (point.seconds > 0) texts << Text::tr("%1 s").arg(number_text(point.seconds, 2));
  return texts.join(" · ");
}

}  // namespace episcope
