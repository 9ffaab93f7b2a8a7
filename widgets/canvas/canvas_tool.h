// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"

#include <QColor>
#include <QCursor>
#include <QObject>
#include <QPointF>
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

}  // namespace episcope
