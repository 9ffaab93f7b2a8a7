// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkSmartPointer.h>

#include <QPalette>
#include <QPointF>
#include <QSize>
#include <QString>

#include <vector>

class QFontMetrics;
class QPainter;
class vtkAxis;
class vtkChartXY;
class vtkContext2D;
class vtkContextScene;
class vtkPlot;

namespace episcope {

class PainterDevice;
struct Plot;
struct PlotAxis;
struct PlotSeries;

/// The chart of a plot.
class PlotChart {
 public:
  PlotChart();
  ~PlotChart();
  PlotChart(const PlotChart&) = delete;
  PlotChart& operator=(const PlotChart&) = delete;

  void set(const Plot& plot, const QPalette& palette);
  /// Draws in the font of the painter.
  void paint(QPainter& painter, QSize size);
  /// Where a point of these values was drawn last, y downwards.
  [[nodiscard]] QPointF positionOf(QPointF value) const;

 private:
  void addLine(const PlotSeries& series, std::size_t place, const QPalette& palette);
  /// Shortens the names in the legend, which would take the room of the lines.
  void fitLegend(const QFontMetrics& metrics, int width);
  /// Shortens the title of the upright axis to its length.
  void fitTitle(const QFontMetrics& metrics, int height);
  void setAxis(int which, const PlotAxis& axis, bool is_logarithmic, const QPalette& palette);
  [[nodiscard]] vtkAxis* axis(int which) const;

  vtkSmartPointer<PainterDevice> device_;
  vtkSmartPointer<vtkContext2D> context_;
  vtkSmartPointer<vtkContextScene> scene_;
  vtkSmartPointer<vtkChartXY> chart_;
  std::vector<vtkPlot*> lines_;      // of the chart
  std::vector<QString> line_names_;  // in full
  QString left_title_;               // in full
  int height_ = 0;
};

}  // namespace episcope
