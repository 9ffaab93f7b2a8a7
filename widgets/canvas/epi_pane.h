// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/canvas/canvas_geometry.h"

#include <QImage>
#include <QLineF>
#include <QWidget>

#include <optional>

namespace episcope {

/// Shows an EPI with rows several pixels tall, sharing zoom and pan along the image axis with the
/// canvas beside it, aligned with it if both have the same extent along that axis. A horizontal
/// pane lies under the canvas (x to the right, u downwards); a vertical one stands beside it (y
/// downwards, v to the right), or lies on its side (v downwards, y to the right) where it may and
/// is wider than high.
///
/// A line of disparity d has the slope −(d − focus) on a picture sheared by `focus`. Dragging draws
/// a line and measures its disparity; a click asks for the cross-hair; the wheel zooms.
class EpiPane : public QWidget {
  Q_OBJECT

 public:
  explicit EpiPane(Qt::Orientation orientation, QWidget* parent = nullptr);

  /// Picture with one row per view: `[u][x]` of `horizontal_epi` or `[v][y]` of `vertical_epi`, as
  /// `render::shade_samples` shows them. Null = none.
  void setEpi(const QImage& epi);
  [[nodiscard]] bool hasEpi() const { return !epi_.isNull(); }
  /// Cross-hair: pixel along the image axis, and row (u or v) of the current view.
  void setCrossHair(std::optional<int> pixel, int row);
  /// Disparities at the cross-hair, drawn as lines through it; none = no line.
  void setSlopes(std::optional<double> estimate_px, std::optional<double> truth_px);
  /// Disparities of the second surface, where two are visible.
  void setBackgroundSlopes(std::optional<double> estimate_px, std::optional<double> truth_px);
  /// Shear already applied to the picture, px per view step.
  void setFocus(double focus_px);
  void clearMeasurement();
  /// Whether a vertical pane may lie on its side. It may not beside a canvas that it is aligned
  /// with.
  void setMayLie(bool may_lie);
  /// Draws a line of this disparity through the cross-hair, as if drawn by hand.
  void showMeasurement(double disparity_px);

  [[nodiscard]] Qt::Orientation orientation() const { return orientation_; }
  /// Disparity of the line drawn by hand; none without one.
  [[nodiscard]] std::optional<double> measuredDisparity() const { return measured_px_; }
  /// Pixel along the image axis where the line meets the current view; none without a line, or
  /// outside.
  [[nodiscard]] std::optional<int> measuredPixel() const;
  /// Logical pixels per row.
  [[nodiscard]] double rowExtent() const;
  /// Widget position of a continuous EPI point: `along` the image axis, `row` across.
  [[nodiscard]] QPointF positionOf(double along, double row) const;

  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override;

 public slots:
  /// Follows the zoom and pan of the canvas.
  void setCanvasTransform(const episcope::CanvasTransform& transform);

 signals:
  /// The user zoomed or panned the EPI; the canvas should follow.
  void transformChanged(const episcope::CanvasTransform& transform);
  /// The user drew a line of this disparity, px per view step.
  void disparityMeasured(double disparity_px);
  /// The user clicked a pixel along the image axis and a row (u or v).
  void positionClicked(int pixel, int row);
  /// A menu is wanted for a pixel along the image axis, at a place of the screen.
  void menuRequested(int pixel, QPoint place);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;

 private:
  /// Whether the image axis is horizontal.
  [[nodiscard]] bool lies() const;
  /// Converts a transform between the orientations of canvas and pane.
  [[nodiscard]] CanvasTransform turned(const CanvasTransform& transform) const;
  [[nodiscard]] QPointF epiAt(QPointF position) const;
  /// Pixel along the image axis at a widget position; none outside.
  [[nodiscard]] std::optional<int> pixelAt(QPointF position) const;
  /// Line through the cross-hair over all rows, in EPI coordinates.
  [[nodiscard]] QLineF epiLine(double disparity_px) const;
  [[nodiscard]] QLineF slopeLine(double disparity_px) const;
  void paintPicture(QPainter& painter) const;
  void paintLines(QPainter& painter) const;
  void paintLabels(QPainter& painter) const;
  void measure();

  Qt::Orientation orientation_;
  bool may_lie_ = false;
  QImage epi_;
  CanvasTransform transform_;
  std::optional<int> cross_pixel_;
  int cross_row_ = 0;
  std::optional<double> estimate_px_;
  std::optional<double> truth_px_;
  std::optional<double> background_estimate_px_;
  std::optional<double> background_truth_px_;
  double focus_px_ = 0;

  bool pressed_ = false;
  bool drawing_ = false;
  bool panning_ = false;
  QPointF press_position_;
  QPointF last_position_;
  std::optional<QLineF> drawn_;  ///< EPI coordinates: x along, y row.
  std::optional<double> measured_px_;
};

}  // namespace episcope
