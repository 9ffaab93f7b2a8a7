// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"

#include <QColor>
#include <QCursor>
#include <QImage>
#include <QObject>
#include <QPoint>
#include <QPointF>
#include <QPolygonF>
#include <QRectF>
#include <QTransform>

#include <optional>

class QPainter;

namespace episcope {

/// Ground under the lines of a tool, so that they are visible on any picture.
inline constexpr QColor kToolShadow{0, 0, 0, 170};

/// A press of a mouse button on the picture, in image coordinates (CanvasTransform).
struct ToolPress {
  QPointF at;
  Qt::MouseButton button = Qt::LeftButton;  ///< Left or right.
  Qt::KeyboardModifiers modifiers;
  bool is_double = false;  ///< The second press of a double click.
};

/// Tool of a ViewCanvas. Gets all mouse input except zoom and pan, and emits what the user wants. A
/// gesture lasts from press to release, or until it is ended or cancelled.
class CanvasTool : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;

  virtual void press(const ToolPress& press) = 0;
  virtual void drag(QPointF /*image*/) {}
  /// The mouse moved without a button.
  virtual void hover(QPointF /*image*/) {}
  void release() { end(); }
  /// Ends the gesture like a release, or takes it back; ignores input until the release. Returns
  /// whether there was a gesture.
  virtual bool end() { return false; }
  virtual bool cancel() { return false; }
  /// Another tool, or none, replaces this one.
  virtual void putAway() { end(); }
  /// Ctrl+Shift+wheel, in notches.
  virtual void step(double /*steps*/) {}

  [[nodiscard]] virtual QCursor cursor() const = 0;
  /// Area of the mark around the cursor, with margin, at `scale` logical pixels per image pixel;
  /// empty = no mark. `center` is in widget coordinates.
  [[nodiscard]] virtual QRectF markRect(QPointF /*center*/, double /*scale*/) const { return {}; }
  virtual void paintMark(QPainter& /*painter*/, QPointF /*center*/, double /*scale*/) const {}
  /// Draws the unfinished gesture on the picture.
  virtual void paintShape(QPainter& /*painter*/, const QTransform& /*widget_from_image*/) const {}

 signals:
  /// Cursor or mark changed.
  void changed();
  /// The drawing of `paintShape` changed.
  void shapeChanged();
};

/// Picks points by clicking either button.
class PointTool : public CanvasTool {
  Q_OBJECT

 public:
  using CanvasTool::CanvasTool;

  void press(const ToolPress& press) override { emit pointPicked(press.at); }
  [[nodiscard]] QCursor cursor() const override { return Qt::PointingHandCursor; }

 signals:
  /// Position in image coordinates, between pixels.
  void pointPicked(QPointF image);
};

/// Draws rectangles of whole pixels by dragging either button, from corner to corner.
class RectangleTool : public CanvasTool {
  Q_OBJECT

 public:
  using CanvasTool::CanvasTool;

  void press(const ToolPress& press) override;
  void drag(QPointF image) override;
  bool end() override;
  bool cancel() override;
  [[nodiscard]] QCursor cursor() const override { return Qt::CrossCursor; }

 signals:
  /// Emitted during the drag; may reach beyond the image.
  void rectangleDragged(const episcope::PixelRect& rectangle);
  /// The button was released after a drag.
  void rectangleDrawn(const episcope::PixelRect& rectangle);
  void rectangleCancelled();

 private:
  [[nodiscard]] PixelRect rectangle() const;

  std::optional<QPointF> begin_;  // none between gestures
  QPointF end_;
};

/// Start of a stroke or fill, in image coordinates.
struct StrokeStart {
  QPointF at;
  bool erases = false;
  bool protects_others = false;  ///< Shift was held.
};

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

  /// Ends the gesture and emits it, unless the corners enclose nothing; false if there is none.
  bool close();
  /// Removes the last corner, if there is one.
  void removeCorner();
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
  bool end() override { return close(); }
};

/// Outlines a region corner by corner: a click sets a corner, a double click closes it. The outline
/// survives a change of the view, but belongs to the view where it was begun.
class PolygonTool : public OutlineTool {
  Q_OBJECT

 public:
  using OutlineTool::OutlineTool;

  void press(const ToolPress& press) override;
  void hover(QPointF image) override {
    if (isDrawing() && !is_away_) setNext({image});
  }
  void paintShape(QPainter& painter, const QTransform& widget_from_image) const override;
  /// Tells that another view is shown: the outline is not drawn, and clicks set no corners.
  void setAway(bool is_away);

 signals:
  /// A click in a view that is not the outline's.
  void pressedAway();

 private:
  bool is_away_ = false;
};

/// Brush and eraser: drags are strokes, and a ring shows the exact area. The right button always
/// erases.
class StrokeTool : public CanvasTool {
  Q_OBJECT

 public:
  /// Margin of a ring's mark beyond its radius, logical pixels.
  static constexpr double kRingMargin = 4;

  using CanvasTool::CanvasTool;

  /// Selects the eraser instead of the brush.
  void setErasing(bool erases);
  /// Diameters in image pixels, 1 … 100.
  void setBrushSize(double diameter_px);
  void setEraserSize(double diameter_px);
  /// Color of the current label, shown in the center of the ring; invalid = none.
  void setColor(const QColor& color);

  [[nodiscard]] double brushSize() const { return brush_px_; }
  [[nodiscard]] double eraserSize() const { return eraser_px_; }
  [[nodiscard]] bool isStroking() const { return is_stroking_; }
  /// Diameter of the ring, in image pixels.
  [[nodiscard]] double ringDiameter() const { return erases() ? eraser_px_ : brush_px_; }

  void press(const ToolPress& press) override;
  void drag(QPointF image) override;
  bool end() override { return stop(&StrokeTool::strokeFinished); }
  bool cancel() override { return stop(&StrokeTool::strokeCancelled); }
  void step(double steps) override { emit sizeStepped(steps); }
  [[nodiscard]] QCursor cursor() const override { return Qt::BlankCursor; }
  [[nodiscard]] QRectF markRect(QPointF center, double scale) const override;
  void paintMark(QPainter& painter, QPointF center, double scale) const override;

 signals:
  void strokeStarted(const episcope::StrokeStart& start);
  void strokeExtended(QPointF image);
  void strokeFinished();
  void strokeCancelled();
  /// Notches, positive = larger.
  void sizeStepped(double steps);

 private:
  [[nodiscard]] bool erases() const { return is_eraser_ || erases_by_button_; }
  /// Ends a stroke and tells so; false if there is none.
  bool stop(void (StrokeTool::*told)());
  void paintTicks(QPainter& painter, QPointF center, double radius) const;

  bool is_eraser_ = false;
  double brush_px_ = 10;
  double eraser_px_ = 20;
  QColor color_;
  bool is_stroking_ = false;
  bool erases_by_button_ = false;
};

/// Fills the region under a click, which is shown before; the right button erases it. Dragging to
/// the right or left widens or narrows what is filled at the release.
class FillTool : public CanvasTool {
  Q_OBJECT

 public:
  /// Pixels of the picture that double what is tolerated.
  static constexpr double kDoubling_px = 40;

  using CanvasTool::CanvasTool;

  void press(const ToolPress& press) override;
  void drag(QPointF image) override;
  void hover(QPointF image) override { emit hovered(image); }
  bool end() override;
  bool cancel() override;
  void putAway() override { cancel(); }
  [[nodiscard]] QCursor cursor() const override { return Qt::CrossCursor; }
  void paintShape(QPainter& painter, const QTransform& widget_from_image) const override;

  /// Shows what a click would fill: a picture whose first pixel is at `at`; null = nothing.
  void setPreview(const QImage& preview, QPoint at);
  [[nodiscard]] const QImage& preview() const { return preview_; }

 signals:
  void hovered(QPointF image);
  void pressed(QPointF image);
  /// What is tolerated is to be `factor` times as much as at the press.
  void dragged(double factor);
  void fillRequested(const episcope::StrokeStart& start);
  void cancelled();

 private:
  std::optional<StrokeStart> start_;
  QImage preview_;
  QPoint preview_at_;
};

}  // namespace episcope
