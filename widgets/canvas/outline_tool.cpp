// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/outline_tool.h"

#include <QPainter>

namespace episcope {
namespace {

constexpr qsizetype kFewestCorners = 3;
constexpr double kHandle = 3;  // radius of the first corner, logical pixels

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

bool LassoTool::end() {
  if (!isDrawing()) return false;
  close();
  return true;
}

void PolygonTool::press(const ToolPress& press) {
  if (!isDrawing()) {
    begin(press);
  } else if (press.is_double) {
    closeUp();  // its first click has set the last corner
  } else {
    addCorner(press.at);
  }
}

void PolygonTool::hover(QPointF image) {
  if (isDrawing()) setNext({image});
}

bool PolygonTool::closeUp() {
  if (!isDrawing()) return false;
  close();
  return true;
}

bool PolygonTool::takeBack() {
  if (!isDrawing()) return false;
  removeCorner();
  return true;
}

}  // namespace episcope

#include "moc_outline_tool.cpp"
