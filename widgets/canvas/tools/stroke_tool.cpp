// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/tools/stroke_tool.h"

#include <QPainter>

#include <algorithm>
#include <cmath>
#include <utility>

namespace episcope {
namespace {

constexpr double kMinSize = 1;
constexpr double kMaxSize = 100;
constexpr double kSmallRing =
    9;  // logical pixels, below which the middle is marked around the ring

}  // namespace

void BrushTool::setTool(AnnotationTool tool) {
  if (tool == tool_) return;
  end();
  tool_ = tool;
  emit changed();
}

void BrushTool::setBrushSize(double diameter_px) {
  brush_px_ = std::clamp(diameter_px, kMinSize, kMaxSize);
  emit changed();
}

void BrushTool::setEraserSize(double diameter_px) {
  eraser_px_ = std::clamp(diameter_px, kMinSize, kMaxSize);
  emit changed();
}

void BrushTool::setColor(const QColor& color) {
  color_ = color;
  emit changed();
}

bool BrushTool::erases() const {
  return tool_ == AnnotationTool::Eraser || erases_by_button_;
}

void BrushTool::press(QPointF image, Qt::MouseButton button, Qt::KeyboardModifiers modifiers) {
  end();
  erases_by_button_ = button == Qt::RightButton;
  const StrokeStart start{image, erases(), modifiers.testFlag(Qt::ShiftModifier)};
  if (tool_ == AnnotationTool::Pick) {
    erases_by_button_ = false;
    emit pickRequested(image);
  } else if (tool_ == AnnotationTool::Fill) {
    erases_by_button_ = false;
    emit fillRequested(start);
  } else {
    is_stroking_ = true;
    emit changed();
    emit strokeStarted(start);
  }
}

void BrushTool::drag(QPointF image) {
  if (is_stroking_) emit strokeExtended(image);
}

void BrushTool::release() {
  end();
}

bool BrushTool::end() {
  if (!std::exchange(is_stroking_, false)) return false;
  erases_by_button_ = false;
  emit strokeFinished();
  emit changed();
  return true;
}

bool BrushTool::cancel() {
  if (!std::exchange(is_stroking_, false)) return false;
  erases_by_button_ = false;
  emit strokeCancelled();
  emit changed();
  return true;
}

std::optional<double> BrushTool::ringDiameter() const {
  if (erases()) return eraser_px_;
  return tool_ == AnnotationTool::Brush ? std::optional(brush_px_) : std::nullopt;
}

QRectF BrushTool::ringRect(QPointF center, double scale) const {
  const double reach =
      std::max(ringDiameter().value_or(0) * scale / 2, kSmallRing) + 2 * kRingMargin;
  return {center.x() - reach, center.y() - reach, 2 * reach, 2 * reach};
}

void BrushTool::paintRing(QPainter& painter, QPointF center, double scale) const {
  const auto diameter_px = ringDiameter();
  if (!diameter_px) return;
  const double radius = *diameter_px * scale / 2;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(Qt::NoBrush);
  QPen pen(Qt::white, 1.2, erases() ? Qt::DashLine : Qt::SolidLine);
  painter.setPen(QPen(QColor(0, 0, 0, 170), 3));
  painter.drawEllipse(center, radius, radius);
  painter.setPen(pen);
  painter.drawEllipse(center, radius, radius);
  if (radius < kSmallRing / 2) {
    // A tiny ring is hard to find: four ticks point at it.
    for (const QPointF& way : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)}) {
      const QLineF tick(center + way * (radius + 3), center + way * (radius + 3 + kSmallRing));
      painter.setPen(QPen(QColor(0, 0, 0, 170), 3));
      painter.drawLine(tick);
      painter.setPen(QPen(Qt::white, 1.2));
      painter.drawLine(tick);
    }
  } else if (!erases() && color_.isValid()) {
    painter.setPen(QPen(QColor(0, 0, 0, 170), 1));
    painter.setBrush(color_);
    painter.drawEllipse(center, 3, 3);
  }
  painter.restore();
}

QCursor BrushTool::cursor() const {
  if (ringDiameter()) return Qt::BlankCursor;
  return tool_ == AnnotationTool::Pick ? Qt::PointingHandCursor : Qt::CrossCursor;
}

}  // namespace episcope
