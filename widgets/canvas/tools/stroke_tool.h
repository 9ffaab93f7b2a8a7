// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/indices.h"

#include <QColor>
#include <QCursor>
#include <QObject>
#include <QPointF>
#include <QRectF>

#include <optional>

class QPainter;

namespace episcope {

/// What the left button does while annotating. The right one always erases.
enum class AnnotationTool { Brush, Eraser, Fill, Pick };

/// How a stroke or a fill begins. Places are in image coordinates, see CanvasTransform.
struct StrokeStart {
  QPointF at;
  bool erases = false;
  bool protects_others = false;  ///< Shift was held.
};

/// The tool in the user's hand: turns presses and drags on a canvas into intents, and shows what
/// would be painted as a ring of the exact size. A ViewCanvas hands it what is not zoom or pan.
class BrushTool : public QObject {
  Q_OBJECT

 public:
  /// Half the side of a ring's surroundings beyond its radius, logical pixels.
  static constexpr double kRingMargin = 4;

  using QObject::QObject;

  void setTool(AnnotationTool tool);
  /// Diameters in image pixels, 1 … 100.
  void setBrushSize(double diameter_px);
  void setEraserSize(double diameter_px);
  /// Colour of the current label, shown in the middle of the ring; invalid = there is none.
  void setColor(const QColor& color);

  [[nodiscard]] AnnotationTool tool() const { return tool_; }
  [[nodiscard]] double brushSize() const { return brush_px_; }
  [[nodiscard]] double eraserSize() const { return eraser_px_; }
  [[nodiscard]] bool isStroking() const { return is_stroking_; }

  /// A button was pressed over the image; the canvas then tells all moves until the release.
  void press(QPointF image, Qt::MouseButton button, Qt::KeyboardModifiers modifiers);
  void drag(QPointF image);
  void release();
  /// Ends the stroke, as a release would, or takes it back; what the hand goes on to do until the
  /// release is passed over. Returns whether there was one.
  bool end();
  bool cancel();
  void step(double steps) { emit sizeStepped(steps); }

  /// Diameter of the ring in image pixels; none for tools without one.
  [[nodiscard]] std::optional<double> ringDiameter() const;
  /// What the ring covers around `center` at `scale` logical pixels an image pixel, with margin.
  [[nodiscard]] QRectF ringRect(QPointF center, double scale) const;
  void paintRing(QPainter& painter, QPointF center, double scale) const;
  [[nodiscard]] QCursor cursor() const;

 signals:
  void strokeStarted(const episcope::StrokeStart& start);
  void strokeExtended(QPointF image);
  void strokeFinished();
  void strokeCancelled();
  void fillRequested(const episcope::StrokeStart& start);
  /// The label under the place is to become the current one.
  void pickRequested(QPointF image);
  /// Ctrl+Shift+wheel: notches, positive = larger.
  void sizeStepped(double steps);
  /// The ring looks different now.
  void changed();

 private:
  [[nodiscard]] bool erases() const;

  AnnotationTool tool_ = AnnotationTool::Brush;
  double brush_px_ = 10;
  double eraser_px_ = 20;
  QColor color_;
  bool is_stroking_ = false;
  bool erases_by_button_ = false;
};

}  // namespace episcope
