// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/stroke_tool.h"

#include <QPainter>

#include <algorithm>
#include <utility>

namespace episcope {
namespace {

constexpr double kMinSize = 1;
constexpr double kMaxSize = 100;
constexpr double kSmallRing = 9;  // logical pixels, below which ticks point at the ring

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

bool StrokeTool::end() {
  if (!std::exchange(is_stroking_, false)) return false;
  erases_by_button_ = false;
  emit strokeFinished();
  emit changed();
  return true;
}

bool StrokeTool::cancel() {
  if (!std::exchange(is_stroking_, false)) return false;
  erases_by_button_ = false;
  emit strokeCancelled();
  emit changed();
  return true;
}

QRectF StrokeTool::markRect(QPointF center, double scale) const {
  const double reach = std::max(ringDiameter() * scale / 2, kSmallRing) + 2 * kRingMargin;
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
  if (radius < kSmallRing / 2) {
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
    const QLineF tick(center + way * (radius + 3), center + way * (radius + 3 + kSmallRing));
    painter.setPen(QPen(kToolShadow, 3));
    painter.drawLine(tick);
    painter.setPen(QPen(Qt::white, 1.2));
    painter.drawLine(tick);
  }
}

void FillTool::press(const ToolPress& press) {
  emit fillRequested(
      {press.at, press.button == Qt::RightButton, press.modifiers.testFlag(Qt::ShiftModifier)});
}

}  // namespace episcope

#include "moc_stroke_tool.cpp"
