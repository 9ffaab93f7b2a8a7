// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/render/region_statistics.h"
#include "engine/render/shade.h"

#include <QWidget>

namespace episcope {

/// A histogram in the colours of its map, with a handle at each end of the colour range. Dragging a
/// handle is an intent to change the range, dragging between them moves both. Setters never emit.
class HistogramView : public QWidget {
  Q_OBJECT

 public:
  explicit HistogramView(QWidget* parent = nullptr);

  /// No counts: nothing but the handles is drawn.
  void setHistogram(const render::Histogram& histogram, const render::Shading& shading);
  [[nodiscard]] const render::Histogram& histogram() const { return histogram_; }
  [[nodiscard]] Interval range() const { return shading_.range; }
  /// Where a value stands, in widget coordinates.
  [[nodiscard]] double xOf(double value) const;

  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override;

 signals:
  void rangeEdited(episcope::Interval range);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

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

}  // namespace episcope
