// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/plot/plot_chart.h"

#include "widgets/plot/line_plot.h"
#include "widgets/plot/painter_device.h"
#include "widgets/plot/series_look.h"
#include "widgets/style/theme.h"

#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContext2D.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <QColor>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

constexpr float kLineWidth = 1.6F;
constexpr float kMarkerSize = 7;
constexpr int kBorder = 14;           // for what of an axis' last number reaches beyond its end
constexpr double kLegendShare = 0.3;  // of the width, at most, for a name
constexpr double kRoom = 0.05;        // of an axis, beyond the points

void set_color(vtkTextProperty& text, const QColor& color) {
  text.SetColor(color.redF(), color.greenF(), color.blueF());
}

void set_color(vtkPen& pen, const QColor& color) {
  pen.SetColor(static_cast<unsigned char>(color.red()), static_cast<unsigned char>(color.green()),
               static_cast<unsigned char>(color.blue()));
}

bool is_finite(QPointF point) {
  return std::isfinite(point.x()) && std::isfinite(point.y());
}

struct Span {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();

  void add(double value) {
    min = std::min(min, value);
    max = std::max(max, value);
  }
};

Span span_of(const Plot& plot, qreal (QPointF::*coordinate)() const) {
  Span span;
  for (const PlotSeries& series : plot.series) {
    for (const QPointF& point : series.points) {
      if (is_finite(point)) span.add((point.*coordinate)());
    }
  }
  return span;
}

// A little room, so that no point lies on the frame.
Span widened(Span span, bool is_logarithmic) {
  if (is_logarithmic) {
    const double factor = std::pow(span.max / span.min, kRoom) * 1.02;
    return {span.min / factor, span.max * factor};
  }
  const double room =
      span.max > span.min ? kRoom * (span.max - span.min) : std::max(0.5 * std::abs(span.max), 0.5);
  const double least = span.min >= 0 ? std::max(0.0, span.min - room) : span.min - room;
  return {least, span.max + room};
}

}  // namespace

PlotChart::PlotChart()
    : device_(vtkSmartPointer<PainterDevice>::New()),
      context_(vtkSmartPointer<vtkContext2D>::New()),
      scene_(vtkSmartPointer<vtkContextScene>::New()),
      chart_(vtkSmartPointer<vtkChartXY>::New()) {
  scene_->AddItem(chart_);
  chart_->SetAutoSize(false);
  chart_->SetHiddenAxisBorder(kBorder);
  chart_->GetLegend()->SetDragEnabled(false);
  chart_->GetLegend()->SetInline(false);  // beside the lines, never over them
}

PlotChart::~PlotChart() = default;

vtkAxis* PlotChart::axis(int which) const {
  return chart_->GetAxis(which);
}

void PlotChart::setAxis(int which, const PlotAxis& axis_of, bool is_logarithmic,
                        const QPalette& palette) {
  vtkAxis* shown = axis(which);
  shown->SetTitle(axis_of.title.toStdString());
  shown->SetLogScale(is_logarithmic);
  shown->SetBehavior(vtkAxis::FIXED);
  shown->SetTickLabelAlgorithm(vtkAxis::TICK_WILKINSON_EXTENDED);
  shown->GetTitleProperties()->SetBold(0);
  const QColor text = palette.color(QPalette::Text);
  set_color(*shown->GetTitleProperties(), text);
  set_color(*shown->GetLabelProperties(), text);
  set_color(*shown->GetPen(), theme::frame(palette));
  set_color(*shown->GetGridPen(), theme::blend(palette.color(QPalette::Base), text, 0.15));
}

void PlotChart::set(const Plot& plot, const QPalette& palette) {
  chart_->ClearPlots();
  lines_.clear();
  line_names_.clear();
  const Span x = span_of(plot, &QPointF::x), y = span_of(plot, &QPointF::y);
  if (!(x.max >= x.min)) return;
  const bool is_log_x = plot.x.is_logarithmic && x.min > 0;
  const bool is_log_y = plot.y.is_logarithmic && y.min > 0;
  setAxis(vtkAxis::BOTTOM, plot.x, is_log_x, palette);
  setAxis(vtkAxis::LEFT, plot.y, is_log_y, palette);
  left_title_ = plot.y.title;
  const Span wide_x = widened(x, is_log_x), wide_y = widened(y, is_log_y);
  axis(vtkAxis::BOTTOM)->SetUnscaledRange(wide_x.min, wide_x.max);
  axis(vtkAxis::LEFT)->SetUnscaledRange(wide_y.min, wide_y.max);
  for (std::size_t i = 0; i < plot.series.size(); ++i) addLine(plot.series[i], i, palette);
  chart_->SetShowLegend(plot.series.size() > 1);
  auto* legend = chart_->GetLegend();
  set_color(*legend->GetLabelProperties(), palette.color(QPalette::Text));
  const QColor base = palette.color(QPalette::Base);
  legend->GetBrush()->SetColor(static_cast<unsigned char>(base.red()),
                               static_cast<unsigned char>(base.green()),
                               static_cast<unsigned char>(base.blue()), 220);
  set_color(*legend->GetPen(), theme::frame(palette));
}

void PlotChart::addLine(const PlotSeries& series, std::size_t place, const QPalette& palette) {
  vtkNew<vtkDoubleArray> x, y;
  x->SetName("x");
  y->SetName("y");
  for (const QPointF& point : series.points) {
    if (!is_finite(point)) continue;
    x->InsertNextValue(point.x());
    y->InsertNextValue(point.y());
  }
  if (x->GetNumberOfTuples() == 0) return;
  vtkNew<vtkTable> table;
  table->AddColumn(x);
  table->AddColumn(y);
  const SeriesLook look = series_look(place, palette);
  const bool is_line = x->GetNumberOfTuples() > 1;
  auto* line =
      vtkPlotPoints::SafeDownCast(chart_->AddPlot(is_line ? vtkChart::LINE : vtkChart::POINTS));
  line->SetInputData(table, 0, 1);
  lines_.push_back(line);
  line_names_.push_back(series.name);
  set_color(*line->GetPen(), look.color);
  line->SetWidth(kLineWidth);
  line->SetMarkerStyle(look.marker);
  line->SetMarkerSize(kMarkerSize);
}

void PlotChart::fitLegend(const QFontMetrics& metrics, int width) {
  const int room = static_cast<int>(kLegendShare * width);
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const std::string name =
        metrics.elidedText(line_names_[i], Qt::ElideMiddle, room).toStdString();
    if (lines_[i]->GetLabel() != name) lines_[i]->SetLabel(name);
  }
}

// It stands at the middle of its axis, which numbers and title of the other one push upwards. The
// unit, at its end, is kept.
void PlotChart::fitTitle(const QFontMetrics& metrics, int height) {
  const int room = height - 2 * metrics.height() - kBorder;
  const QString title = metrics.elidedText(left_title_, Qt::ElideMiddle, room);
  axis(vtkAxis::LEFT)->SetTitle(title.toStdString());
}

void PlotChart::paint(QPainter& painter, QSize size) {
  height_ = size.height();
  fitLegend(painter.fontMetrics(), size.width());
  fitTitle(painter.fontMetrics(), size.height());
  device_->setPainter(&painter, size.height());
  scene_->SetGeometry(size.width(), size.height());
  chart_->SetSize(
      vtkRectf(0, 0, static_cast<float>(size.width()), static_cast<float>(size.height())));
  painter.setRenderHint(QPainter::Antialiasing);
  context_->Begin(device_);
  scene_->Paint(context_);
  context_->End();
  device_->setPainter(nullptr, 0);
}

QPointF PlotChart::positionOf(QPointF value) const {
  const auto along = [](vtkAxis& axis, double v, int part) {
    if (axis.GetLogScaleActive()) v = std::log10(v);
    const double share = (v - axis.GetMinimum()) / (axis.GetMaximum() - axis.GetMinimum());
    const double begin = axis.GetPoint1()[part], end = axis.GetPoint2()[part];
    return begin + share * (end - begin);
  };
  return {along(*axis(vtkAxis::BOTTOM), value.x(), 0),
          height_ - along(*axis(vtkAxis::LEFT), value.y(), 1)};
}

}  // namespace episcope
