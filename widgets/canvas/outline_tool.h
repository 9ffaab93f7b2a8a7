// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/canvas/stroke_tool.h"

#include <QPolygonF>

namespace episcope {

/// Draws around a region, which is then painted, or erased if it was begun with the right button:
/// what lasso and polygon have in common.
class OutlineTool : public CanvasTool {
  Q_OBJECT

 public:
  using CanvasTool::CanvasTool;

  /// Colour of the current label, in which lines are drawn; invalid = there is none.
  void setColor(const QColor& color);
  /// The corners that were set so far, in image coordinates.
  [[nodiscard]] const QPolygonF& corners() const { return corners_; }
  [[nodiscard]] bool isDrawing() const { return !corners_.isEmpty(); }

  bool cancel() override;
  void putAway() override { cancel(); }
  [[nodiscard]] QCursor cursor() const override { return Qt::CrossCursor; }
  void paintShape(QPainter& painter, const QTransform& widget_from_image) const override;

 signals:
  /// It is closed: `start` tells how it was begun.
  void outlined(const QPolygonF& corners, const episcope::StrokeStart& start);
  /// A corner was set or removed, or the gesture ended.
  void cornersChanged();

 protected:
  void begin(const ToolPress& press);
  void addCorner(QPointF image);
  void removeCorner();
  /// Ends the gesture and tells of it, unless there are too few corners to enclose anything.
  void close();
  /// Where the next corner would be, if it is drawn; empty = not.
  void setNext(const QPolygonF& next);

 private:
  void change(const QPolygonF& corners);

  QPolygonF corners_;
  QPolygonF next_;
  StrokeStart start_;
  QColor color_;
};

/// Draws around a region in one drag; the release closes it.
class LassoTool : public OutlineTool {
  Q_OBJECT

 public:
  using OutlineTool::OutlineTool;

  void press(const ToolPress& press) override { begin(press); }
  void drag(QPointF image) override;
  bool end() override;
};

/// Draws around a region corner by corner: each click sets one, a double click closes it. It stays
/// in hand while other views are shown.
class PolygonTool : public OutlineTool {
  Q_OBJECT

 public:
  using OutlineTool::OutlineTool;

  void press(const ToolPress& press) override;
  void hover(QPointF image) override;
  /// Closes it; false if nothing is drawn.
  bool closeUp();
  /// Takes the last corner back; false if nothing is drawn.
  bool takeBack();
};

}  // namespace episcope
