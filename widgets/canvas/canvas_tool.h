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

/// Drawn under the lines of a tool, so that they are seen on any picture.
inline constexpr QColor kToolShadow{0, 0, 0, 170};

/// A press of a button over the picture. Places are in image coordinates, see CanvasTransform.
struct ToolPress {
  QPointF at;
  Qt::MouseButton button = Qt::LeftButton;  ///< Left or right.
  Qt::KeyboardModifiers modifiers;
  bool is_double = false;  ///< The second press of a double click.
};

/// A tool that the mouse of a ViewCanvas is given to: it is handed whatever is not zoom or pan, and
/// tells its host by signals of its own what the user wants. A gesture lasts from a press to the
/// release, or until it is ended or cancelled.
class CanvasTool : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;

  virtual void press(const ToolPress& press) = 0;
  virtual void drag(QPointF /*image*/) {}
  /// The mouse moves without a button.
  virtual void hover(QPointF /*image*/) {}
  void release() { end(); }
  /// Ends the gesture, as a release would, or takes it back; what the hand goes on to do until the
  /// release is ignored. Returns whether there was one.
  virtual bool end() { return false; }
  virtual bool cancel() { return false; }
  /// Another tool is taken, or none.
  virtual void putAway() { end(); }
  /// Ctrl+Shift+wheel, in notches.
  virtual void step(double /*steps*/) {}

  [[nodiscard]] virtual QCursor cursor() const = 0;
  /// What the tool draws around the cursor, with margin, at `scale` logical pixels an image pixel;
  /// empty = nothing. `center` is in widget coordinates.
  [[nodiscard]] virtual QRectF markRect(QPointF /*center*/, double /*scale*/) const { return {}; }
  virtual void paintMark(QPainter& /*painter*/, QPointF /*center*/, double /*scale*/) const {}
  /// Draws what the gesture has drawn on the picture so far.
  virtual void paintShape(QPainter& /*painter*/, const QTransform& /*widget_from_image*/) const {}

 signals:
  /// Cursor or mark look different now.
  void changed();
  /// Likewise what `paintShape` draws.
  void shapeChanged();
};

/// Picks points by clicks of either button.
class PointTool : public CanvasTool {
  Q_OBJECT

 public:
  using CanvasTool::CanvasTool;

  void press(const ToolPress& press) override { emit pointPicked(press.at); }
  [[nodiscard]] QCursor cursor() const override { return Qt::PointingHandCursor; }

 signals:
  /// In image coordinates, between pixels.
  void pointPicked(QPointF image);
};

/// Draws rectangles of whole pixels by drags of either button, from corner to corner.
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
  /// While it is drawn; may reach beyond the image.
  void rectangleDragged(const episcope::PixelRect& rectangle);
  /// The button was released; not after a click.
  void rectangleDrawn(const episcope::PixelRect& rectangle);
  void rectangleCancelled();

 private:
  [[nodiscard]] PixelRect rectangle() const;

  std::optional<QPointF> begin_;  // none between gestures
  QPointF end_;
};

}  // namespace episcope
