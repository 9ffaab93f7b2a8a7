// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/view_canvas.h"
#include "widgets/style/theme.h"

#include <QLineF>
#include <QPainter>

#include <utility>

namespace episcope {
namespace {

// Logical pixels.
constexpr double kReach = 8;
constexpr double kRadius = 4;
constexpr double kLargeRadius = 7;

void draw_mark(QPainter& painter, const CanvasMark& mark, QPointF at,
               const std::optional<QPointF>& wanted) {
  const QColor color = mark.is_emphasised ? theme::kCrossHair : theme::kEstimate;
  const double radius = mark.is_emphasised ? kLargeRadius : kRadius;
  const QPointF text = at + QPointF(radius + 3, -radius);
  painter.setBrush(Qt::NoBrush);
  for (const bool is_halo : {true, false}) {
    painter.setPen(QPen(is_halo ? QColor(0, 0, 0, 170) : color, is_halo ? 4 : 2));
    if (wanted) painter.drawLine(at, *wanted);
    painter.drawEllipse(at, radius, radius);
    painter.drawPoint(at);
  }
  painter.setPen(QColor(0, 0, 0, 200));
  for (const QPointF shift : {QPointF(1, 1), QPointF(-1, 1), QPointF(1, -1), QPointF(-1, -1)}) {
    painter.drawText(text + shift, mark.name);
  }
  painter.setPen(color);
  painter.drawText(text, mark.name);
}

}  // namespace

void ViewCanvas::setMarks(std::vector<CanvasMark> marks) {
  if (marks == marks_) return;
  marks_ = std::move(marks);
  update();
}

std::optional<int> ViewCanvas::markAt(QPointF position) const {
  std::optional<int> nearest;
  double least = kReach;
  for (std::size_t i = 0; i < marks_.size(); ++i) {
    const QPointF at = transform_.to_widget(marks_[i].at, size());
    const double distance = QLineF(at, position).length();
    if (distance > least) continue;
    least = distance;
    nearest = static_cast<int>(i);
  }
  return nearest;
}

// What is emphasised lies over the others.
void ViewCanvas::paintMarks(QPainter& painter) const {
  if (marks_.empty()) return;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  for (const bool is_emphasised : {false, true}) {
    for (const CanvasMark& mark : marks_) {
      if (mark.is_emphasised != is_emphasised) continue;
      std::optional<QPointF> wanted;
      if (mark.wanted) wanted = transform_.to_widget(*mark.wanted, size());
      draw_mark(painter, mark, transform_.to_widget(mark.at, size()), wanted);
    }
  }
  painter.restore();
}

}  // namespace episcope
