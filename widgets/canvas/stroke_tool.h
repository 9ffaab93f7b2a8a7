// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/canvas/canvas_tool.h"

#include <QColor>

namespace episcope {

/// Start of a stroke or fill, in image coordinates.
struct StrokeStart {
  QPointF at;
  bool erases = false;
  bool protects_others = false;  ///< Shift was held.
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
  bool end() override;
  bool cancel() override;
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
  void paintTicks(QPainter& painter, QPointF center, double radius) const;

  bool is_eraser_ = false;
  double brush_px_ = 10;
  double eraser_px_ = 20;
  QColor color_;
  bool is_stroking_ = false;
  bool erases_by_button_ = false;
};

/// Fills the region under a click; the right button erases it.
class FillTool : public CanvasTool {
  Q_OBJECT

 public:
  using CanvasTool::CanvasTool;

  void press(const ToolPress& press) override;
  [[nodiscard]] QCursor cursor() const override { return Qt::CrossCursor; }

 signals:
  void fillRequested(const episcope::StrokeStart& start);
};

}  // namespace episcope
