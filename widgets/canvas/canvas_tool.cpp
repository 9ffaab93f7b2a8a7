// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/canvas_tool.h"

#include <QPainter>

#include <algorithm>
#include <cmath>
#include <utility>

namespace episcope {

namespace {

constexpr qsizetype kFewestCorners = 3;
constexpr double kHandle = 3;  // radius of the first corner, logical pixels

StrokeStart start_of(const ToolPress& press) {
  return {press.at, press.button == Qt::RightButton, press.modifiers.testFlag(Qt::ShiftModifier)};
}

}  // namespace

void OutlineTool::setColor(const QColor& color) {
  color_ = color;
  emit shapeChanged();
}

void OutlineTool::change(const QPolygonF& corners) {
  corners_ = corners;
  if (corners_.isEmpty()) next_.clear();
  emit shapeChanged();
  emit cornersChanged();
}

void OutlineTool::begin(const ToolPress& press) {
  start_ = start_of(press);
  change({press.at});
}

void OutlineTool::addCorner(QPointF image) {
  QPolygonF more = corners_;
  change(more << image);
}

void OutlineTool::removeCorner() {
  QPolygonF fewer = corners_;
  if (fewer.isEmpty()) return;
  fewer.removeLast();
  change(fewer);
}

void OutlineTool::setNext(const QPolygonF& next) {
  next_ = next;
  emit shapeChanged();
}

bool OutlineTool::close() {
  if (!isDrawing()) return false;
  const QPolygonF corners = corners_;
  change({});
  if (corners.size() >= kFewestCorners) emit outlined(corners, start_);
  return true;
}

bool OutlineTool::cancel() {
  if (!isDrawing()) return false;
  change({});
  return true;
}

void OutlineTool::paintShape(QPainter& painter, const QTransform& widget_from_image) const {
  if (!isDrawing()) return;
  const QPolygonF line = widget_from_image.map(corners_ + next_);
  const QColor color = start_.erases || !color_.isValid() ? QColor(Qt::white) : color_;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(kToolShadow, 3.5));
  painter.drawPolyline(line);
  painter.setPen(QPen(color, 1.6, start_.erases ? Qt::DashLine : Qt::SolidLine));
  painter.drawPolyline(line);
  // What would close it.
  painter.setPen(QPen(color, 1, Qt::DotLine));
  painter.drawLine(line.back(), line.front());
  painter.setPen(QPen(kToolShadow, 1));
  painter.setBrush(Qt::white);
  painter.drawEllipse(line.front(), kHandle, kHandle);
  painter.restore();
}

void LassoTool::drag(QPointF image) {
  if (isDrawing() && image != corners().back()) addCorner(image);
}

void PolygonTool::press(const ToolPress& press) {
  if (isDrawing() && is_away_) {
    emit pressedAway();
  } else if (!isDrawing()) {
    begin(press);
  } else if (press.is_double) {
    close();  // its first click has set the last corner
  } else {
    addCorner(press.at);
  }
}

void PolygonTool::paintShape(QPainter& painter, const QTransform& widget_from_image) const {
  if (!is_away_) OutlineTool::paintShape(painter, widget_from_image);
}

void PolygonTool::setAway(bool is_away) {
  if (std::exchange(is_away_, is_away) != is_away) emit shapeChanged();
}

void RectangleTool::press(const ToolPress& press) {
  begin_ = end_ = press.at;
}

void RectangleTool::drag(QPointF image) {
  if (!begin_) return;
  end_ = image;
  emit rectangleDragged(rectangle());
}

// Every pixel that the drag touched.
PixelRect RectangleTool::rectangle() const {
  const QRectF between = QRectF(*begin_, end_).normalized();
  return {static_cast<int>(std::floor(between.top())), static_cast<int>(std::floor(between.left())),
          static_cast<int>(std::ceil(between.bottom())),
          static_cast<int>(std::ceil(between.right()))};
}

bool RectangleTool::end() {
  if (!begin_) return false;
  const PixelRect drawn = rectangle();
  const bool is_click = *begin_ == end_;
  begin_.reset();
  if (is_click) {
    emit rectangleCancelled();
  } else {
    emit rectangleDrawn(drawn);
  }
  return true;
}

bool RectangleTool::cancel() {
  if (!begin_) return false;
  begin_.reset();
  emit rectangleCancelled();
  return true;
}

namespace {

constexpr double kMinSize = 1;
constexpr double kMaxSize = 100;
constexpr double kSmallRing = 9;  // logical pixels, below which ticks point at the ring
constexpr double kTickGap = 3;  // logical pixels from the ring to its ticks, as long as kSmallRing

bool has_ticks(double radius) {
  return radius < kSmallRing / 2;
}

}  // namespace

void StrokeTool::setErasing(bool erases) {
  if (erases == is_eraser_) return;
  end();
  is_eraser_ = erases;
  emit changed();
}

void StrokeTool::setBrushSize(double diameter_px) {
  brush_px_ = std::clamp(diameter_px, kMinSize, kMaxSize);
  emit changed();
}

void StrokeTool::setEraserSize(double diameter_px) {
  eraser_px_ = std::clamp(diameter_px, kMinSize, kMaxSize);
  emit changed();
}

void StrokeTool::setColor(const QColor& color) {
  color_ = color;
  emit changed();
}

void StrokeTool::press(const ToolPress& press) {
  end();
  erases_by_button_ = press.button == Qt::RightButton;
  is_stroking_ = true;
  emit changed();
  emit strokeStarted({press.at, erases(), press.modifiers.testFlag(Qt::ShiftModifier)});
}

void StrokeTool::drag(QPointF image) {
  if (is_stroking_) emit strokeExtended(image);
}

bool StrokeTool::stop(void (StrokeTool::*told)()) {
  if (!std::exchange(is_stroking_, false)) return false;
  erases_by_button_ = false;
  emit(this->*told)();
  emit changed();
  return true;
}

QRectF StrokeTool::markRect(QPointF center, double scale) const {
  const double radius = ringDiameter() * scale / 2;
  const double reach = radius + (has_ticks(radius) ? kTickGap + kSmallRing : 0) + kRingMargin;
  return {center.x() - reach, center.y() - reach, 2 * reach, 2 * reach};
}

void StrokeTool::paintMark(QPainter& painter, QPointF center, double scale) const {
  const double radius = ringDiameter() * scale / 2;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(kToolShadow, 3));
  painter.drawEllipse(center, radius, radius);
  painter.setPen(QPen(Qt::white, 1.2, erases() ? Qt::DashLine : Qt::SolidLine));
  painter.drawEllipse(center, radius, radius);
  if (has_ticks(radius)) {
    paintTicks(painter, center, radius);
  } else if (!erases() && color_.isValid()) {
    painter.setPen(QPen(kToolShadow, 1));
    painter.setBrush(color_);
    painter.drawEllipse(center, 3, 3);
  }
  painter.restore();
}

// A tiny ring is hard to find: four ticks point at it.
void StrokeTool::paintTicks(QPainter& painter, QPointF center, double radius) const {
  for (const QPointF& way : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)}) {
    const double begin = radius + kTickGap;
    const QLineF tick(center + way * begin, center + way * (begin + kSmallRing));
    painter.setPen(QPen(kToolShadow, 3));
    painter.drawLine(tick);
    painter.setPen(QPen(Qt::white, 1.2));
    painter.drawLine(tick);
  }
}

void FillTool::press(const ToolPress& press) {
  start_ = start_of(press);
  emit pressed(press.at);
}

void FillTool::drag(QPointF image) {
  if (start_) emit dragged(std::exp2((image.x() - start_->at.x()) / kDoubling_px));
}

bool FillTool::end() {
  const auto start = std::exchange(start_, std::nullopt);
  if (start) emit fillRequested(*start);
  return start.has_value();
}

bool FillTool::cancel() {
  const bool was_filling = std::exchange(start_, std::nullopt).has_value();
  setPreview({}, {});
  if (was_filling) emit cancelled();
  return was_filling;
}

void FillTool::setPreview(const QImage& preview, QPoint at) {
  if (preview.isNull() && preview_.isNull()) return;
  preview_ = preview;
  preview_at_ = at;
  emit shapeChanged();
}

void FillTool::paintShape(QPainter& painter, const QTransform& widget_from_image) const {
  if (preview_.isNull()) return;
  painter.setRenderHint(QPainter::SmoothPixmapTransform, false);
  painter.drawImage(widget_from_image.mapRect(QRectF(preview_at_, QSizeF(preview_.size()))),
                    preview_);
}

}  // namespace episcope

#include "moc_canvas_tool.cpp"
