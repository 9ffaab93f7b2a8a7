// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/canvas/stroke_tool.h"

#include <QPolygonF>

namespace episcope {

/// Outlines a region to paint it, or to erase it if begun with the right button. Base of lasso and
/// polygon.
class OutlineTool : public CanvasTool {
  Q_OBJECT

 public:
  using CanvasTool::CanvasTool;

  /// Line color: the current label's; invalid = no label.
  void setColor(const QColor& color);
  /// Corners set so far, in image coordinates.
  [[nodiscard]] const QPolygonF& corners() const { return corners_; }
  [[nodiscard]] bool isDrawing() const { return !corners_.isEmpty(); }

  bool cancel() override;
  void putAway() override { cancel(); }
  [[nodiscard]] QCursor cursor() const override { return Qt::CrossCursor; }
  void paintShape(QPainter& painter, const QTransform& widget_from_image) const override;

 signals:
  /// The outline was closed; `start` tells how it began.
  void outlined(const QPolygonF& corners, const episcope::StrokeStart& start);
  /// A corner was set or removed, or the gesture ended.
  void cornersChanged();

 protected:
  void begin(const ToolPress& press);
  void addCorner(QPointF image);
  void removeCorner();
  /// Ends the gesture and emits it, unless the corners enclose nothing.
  void close();
  /// Preview of the next corner; empty = none.
  void setNext(const QPolygonF& next);

 private:
  void change(const QPolygonF& corners);

  QPolygonF corners_;
  QPolygonF next_;
  StrokeStart start_;
  QColor color_;
};

/// Outlines a region in one drag, closed by the release.
class LassoTool : public OutlineTool {
  Q_OBJECT

 public:
  using OutlineTool::OutlineTool;

  void press(const ToolPress& press) override { begin(press); }
  void drag(QPointF image) override;
  bool end() override;
};

/// Outlines a region corner by corner: a click sets a corner, a double click closes it. The outline
/// survives a change of the view.
class PolygonTool : public OutlineTool {
  Q_OBJECT

 public:
  using OutlineTool::OutlineTool;

  void press(const ToolPress& press) override;
  void hover(QPointF image) override;
  /// Closes the outline; false if there is none.
  bool closeUp();
  /// Removes the last corner; false if there is no outline.
  bool takeBack();
};

}  // namespace episcope
