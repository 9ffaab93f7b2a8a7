// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/render/quantity.h"
#include "engine/render/shade.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/number_spin.h"

#include <QString>
#include <QWidget>

#include <array>
#include <optional>

class QGridLayout;
class QLabel;

namespace episcope {

class ElidedLabel;
class HistogramView;
class LinePlot;
struct Plot;

/// Histogram and a few numbers of the visible part of a map. Setters never emit.
class StatisticsPanel : public QWidget {
  Q_OBJECT

 public:
  struct Summary {
    QString title;  ///< "error of EPI_L"
    QString unit;   ///< "px"; may be empty.
    render::RegionStatistics statistics;
    std::optional<double> bad_percent;  ///< Off by more than the threshold.
    render::Shading shading;
  };

  explicit StatisticsPanel(QWidget* parent = nullptr);

  void setSummary(const Summary& summary);
  void setBadThreshold(double threshold_px) { Quietly(threshold_)->setValue(threshold_px); }
  /// Shows why there is no map.
  void clear(const QString& why);
  /// "min −0.120, median …", "–" for unknown numbers.
  [[nodiscard]] QString text() const;

 signals:
  void rangeEdited(episcope::Interval range);
  void badThresholdEdited(double threshold_px);

 private:
  void addThreshold(QGridLayout& layout);

  ElidedLabel* title_;
  HistogramView* histogram_;
  std::array<QLabel*, 6> names_;
  std::array<QLabel*, 6> values_;
  NumberSpin* threshold_;
  QLabel* bad_part_;
};

/// A histogram in the colors of its map, with a handle at each end of the color range. Dragging a
/// handle asks to change the range; dragging between them moves both. Setters never emit.
class HistogramView : public QWidget {
  Q_OBJECT

 public:
  explicit HistogramView(QWidget* parent = nullptr);

  /// Without counts only the handles are drawn.
  void setHistogram(const render::Histogram& histogram, const render::Shading& shading);
  [[nodiscard]] const render::Histogram& histogram() const { return histogram_; }
  [[nodiscard]] Interval range() const { return shading_.range; }
  /// Position of a value in widget coordinates.
  [[nodiscard]] double xOf(double value) const;

  [[nodiscard]] QSize sizeHint() const override { return {240, 96}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {120, 60}; }

 signals:
  void rangeEdited(episcope::Interval range);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent*) override { grip_ = Grip::None; }

 private:
  enum class Grip { None, Min, Max, Both };
  [[nodiscard]] QRectF area() const;
  [[nodiscard]] double valueAt(double x) const;
  [[nodiscard]] Grip gripAt(QPointF position) const;
  void paintBars(QPainter& painter) const;
  void paintHandles(QPainter& painter) const;

  render::Histogram histogram_;
  render::Shading shading_;
  Grip grip_ = Grip::None;
  double pressed_value_ = 0;
  Interval pressed_range_;
};

/// Errors over true disparity: two plots, or why there are none.
class ErrorPlotPanel : public QWidget {
  Q_OBJECT

 public:
  explicit ErrorPlotPanel(QWidget* parent = nullptr);

  void setPlots(const QString& title, const Plot& squares, const Plot& bad);
  /// Shows why there are no plots.
  void clear(const QString& why);

 private:
  QLabel* title_;
  LinePlot* squares_;
  LinePlot* bad_;
};

}  // namespace episcope
