// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/compare/histogram_view.h"

#include "widgets/style/theme.h"

#include <QMouseEvent>
#include <QPainter>
#include <QPolygonF>

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

constexpr double kHandleHeight = 9;
constexpr double kHandleHalfWidth = 6;
constexpr double kReach = 7;           // of the mouse to a handle, logical pixels
constexpr double kLeastShare = 0.005;  // of the axis that a range keeps

}  // namespace

HistogramView::HistogramView(QWidget* parent) : QWidget(parent) {
  setObjectName("histogramView");
  setMouseTracking(true);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setToolTip(tr("Visible values. Drag the handles to change the colour range."));
}

void HistogramView::setHistogram(const render::Histogram& histogram,
                                 const render::Shading& shading) {
  // While a handle is dragged the axis stays, or the handle would run away from the hand.
  if (grip_ == Grip::None || histogram_.counts.empty()) histogram_ = histogram;
  shading_ = shading;
  update();
}

QRectF HistogramView::area() const {
  return QRectF(rect()).adjusted(kHandleHalfWidth, 1, -kHandleHalfWidth, -kHandleHeight - 2);
}

double HistogramView::xOf(double value) const {
  const double length = histogram_.axis.length();
  if (!(length > 0)) return area().left();
  return area().left() + (value - histogram_.axis.min) / length * area().width();
}

double HistogramView::valueAt(double x) const {
  return histogram_.axis.min +
         (x - area().left()) / std::max(1.0, area().width()) * histogram_.axis.length();
}

QSize HistogramView::sizeHint() const {
  return {240, 96};
}
QSize HistogramView::minimumSizeHint() const {
  return {120, 60};
}

void HistogramView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(area(), theme::kCanvas);
  if (histogram_.counts.empty()) {
    painter.setPen(theme::kCanvasMuted);
    painter.drawText(area(), Qt::AlignCenter, tr("No visible values"));
    return;
  }
  paintBars(painter);
  paintHandles(painter);
}

void HistogramView::paintBars(QPainter& painter) const {
  const auto most = *std::max_element(histogram_.counts.begin(), histogram_.counts.end());
  if (most == 0) return;
  const QRectF inside = area();
  const double width = inside.width() / static_cast<double>(histogram_.counts.size());
  QPolygonF outline;  // bars as dark as the ground have nothing else
  for (std::size_t i = 0; i < histogram_.counts.size(); ++i) {
    const double left = inside.left() + static_cast<double>(i) * width;
    if (histogram_.counts[i] == 0) {
      outline << QPointF(left, inside.bottom()) << QPointF(left + width, inside.bottom());
      continue;
    }
    // By the square root: small heaps, which errors are, stay in sight beside a large one.
    const double part = std::sqrt(histogram_.counts[i] / static_cast<double>(most));
    const double height = std::max(1.0, part * (inside.height() - 2));
    const auto [red, green, blue] =
        shading_.map.color(valueAt(left + width / 2), shading_.range.min, shading_.range.max);
    painter.fillRect(QRectF(left, inside.bottom() - height, width + 0.5, height),
                     QColor(red, green, blue));
    const double top = inside.bottom() - height;
    outline << QPointF(left, top) << QPointF(left + width, top);
  }
  painter.setPen(theme::kCanvasMuted);
  painter.drawPolyline(outline);
}

void HistogramView::paintHandles(QPainter& painter) const {
  const QRectF inside = area();
  painter.setRenderHint(QPainter::Antialiasing);
  for (const double value : {shading_.range.min, shading_.range.max}) {
    const double x = std::clamp(xOf(value), inside.left(), inside.right());
    painter.setPen(QPen(QColor(255, 255, 255, 200), 1, Qt::DashLine));
    painter.drawLine(QLineF(x, inside.top(), x, inside.bottom()));
    painter.setPen(QPen(palette().color(QPalette::WindowText), 1));
    painter.setBrush(palette().color(QPalette::Button));
    const double top = inside.bottom() + 1;
    painter.drawPolygon(
        QPolygonF({QPointF(x, top), QPointF(x + kHandleHalfWidth - 1, top + kHandleHeight - 1),
                   QPointF(x - kHandleHalfWidth + 1, top + kHandleHeight - 1)}));
  }
}

HistogramView::Grip HistogramView::gripAt(QPointF position) const {
  if (histogram_.counts.empty()) return Grip::None;
  const double min = std::clamp(xOf(shading_.range.min), area().left(), area().right());
  const double max = std::clamp(xOf(shading_.range.max), area().left(), area().right());
  const double to_min = std::abs(position.x() - min);
  const double to_max = std::abs(position.x() - max);
  if (std::min(to_min, to_max) <= kReach) return to_min < to_max ? Grip::Min : Grip::Max;
  return position.x() > min && position.x() < max ? Grip::Both : Grip::None;
}

void HistogramView::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  grip_ = gripAt(event->position());
  pressed_value_ = valueAt(event->position().x());
  pressed_range_ = shading_.range;
}

void HistogramView::mouseMoveEvent(QMouseEvent* event) {
  const Grip hovered = grip_ == Grip::None ? gripAt(event->position()) : grip_;
  setCursor(hovered == Grip::None   ? Qt::ArrowCursor
            : hovered == Grip::Both ? Qt::OpenHandCursor
                                    : Qt::SizeHorCursor);
  if (grip_ == Grip::None) return;
  const double moved = valueAt(event->position().x()) - pressed_value_;
  const double least = kLeastShare * histogram_.axis.length();
  Interval range = pressed_range_;
  if (grip_ != Grip::Max) range.min += moved;
  if (grip_ != Grip::Min) range.max += moved;
  if (grip_ == Grip::Min) range.min = std::min(range.min, range.max - least);
  if (grip_ == Grip::Max) range.max = std::max(range.max, range.min + least);
  shading_.range = range;
  update();
  emit rangeEdited(range);
}

void HistogramView::mouseReleaseEvent(QMouseEvent*) {
  grip_ = Grip::None;
}

}  // namespace episcope

#include "moc_histogram_view.cpp"
