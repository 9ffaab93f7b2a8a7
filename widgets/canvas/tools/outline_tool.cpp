// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/tools/outline_tool.h"

#include <QPainter>

#include <utility>

namespace episcope {
namespace {

constexpr qsizetype kFewestCorners = 3;
constexpr double kHandle = 3;  // radius of the first corner, logical pixels
constexpr QColor kShadow(0, 0, 0, 170);

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
  start_ = {press.at, press.button == Qt::RightButton, press.modifiers.testFlag(Qt::ShiftModifier)};
  change({press.at});
}

void OutlineTool::addCorner(QPointF image) {
  QPolygonF more = corners_;
  change(more << image);
}

void OutlineTool::removeCorner() {
  QPolygonF fewer = corners_;
  fewer.removeLast();
  change(fewer);
}

void OutlineTool::setNext(const QPolygonF& next) {
  next_ = next;
  emit shapeChanged();
}

void OutlineTool::close() {
  const QPolygonF corners = corners_;
  change({});
  if (corners.size() >= kFewestCorners) emit outlined(corners, start_);
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
  painter.setPen(QPen(kShadow, 3.5));
  painter.drawPolyline(line);
  painter.setPen(QPen(color, 1.6, start_.erases ? Qt::DashLine : Qt::SolidLine));
  painter.drawPolyline(line);
  // What would close it.
  painter.setPen(QPen(color, 1, Qt::DotLine));
  painter.drawLine(line.back(), line.front());
  painter.setPen(QPen(kShadow, 1));
  painter.setBrush(Qt::white);
  painter.drawEllipse(line.front(), kHandle, kHandle);
  painter.restore();
}

}  // namespace episcope

#include "moc_outline_tool.cpp"
