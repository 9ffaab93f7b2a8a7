// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/browse/epi_pane.h"
#include "widgets/canvas/canvas_text.h"
#include "widgets/style/number_text.h"
#include "widgets/style/theme.h"

#include <QPaintEvent>
#include <QPainter>

#include <algorithm>
#include <cmath>
#include <vector>

namespace episcope {
namespace {

struct Slope {
  QLineF line;
  QColor color;
  Qt::PenStyle style;
};

/// Halos first, so that none hides a line: estimate and truth often lie upon each other.
void draw_slopes(QPainter& painter, const std::vector<Slope>& slopes) {
  painter.setRenderHint(QPainter::Antialiasing);
  for (const auto& slope : slopes) {
    painter.setPen(QPen(QColor(0, 0, 0, 130), 4.5, Qt::SolidLine, Qt::FlatCap));
    painter.drawLine(slope.line);
  }
  for (const auto& slope : slopes) {
    const double width = slope.style == Qt::SolidLine ? 2.5 : 2;
    painter.setPen(QPen(slope.color, width, slope.style, Qt::FlatCap));
    painter.drawLine(slope.line);
  }
  painter.setRenderHint(QPainter::Antialiasing, false);
}

QString disparity_text(double disparity_px) {
  return QString("%1 px").arg(number_text(disparity_px));
}

}  // namespace

void EpiPane::paintEvent(QPaintEvent* event) {
  QPainter painter(this);
  painter.fillRect(event->rect(), theme::kCanvas);
  if (epi_.isNull()) {
    painter.setPen(theme::kCanvasMuted);
    painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap, accessibleName());
    return;
  }
  paintPicture(painter);
  paintLines(painter);
  paintLabels(painter);
}

void EpiPane::paintPicture(QPainter& painter) const {
  const double scale = transform_.scale;
  const int extent = lies() ? width() : height();
  const double start = epiAt({0, 0}).x();
  const int first = std::clamp(static_cast<int>(std::floor(start)), 0, epi_.width());
  const int last = std::clamp(static_cast<int>(std::ceil(start + extent / scale)), 0, epi_.width());
  if (first >= last) return;
  QImage seen = epi_.copy(first, 0, last - first, epi_.height());
  if (scale * devicePixelRatioF() < 1) {
    // Smooth along the image axis only: rows of different views do not mix.
    const int columns = static_cast<int>(std::ceil(seen.width() * scale * devicePixelRatioF()));
    seen = seen.scaled(std::max(1, columns), seen.height(), Qt::IgnoreAspectRatio,
                       Qt::SmoothTransformation);
  }
  const QRectF target(positionOf(first, 0), positionOf(last, epi_.height()));
  if (!lies()) {  // Rows become columns.
    seen = seen.transformed(QTransform(0, 1, 1, 0, 0, 0));
  }
  painter.drawImage(target, seen, QRectF(seen.rect()));
}

QLineF EpiPane::slopeLine(double disparity_px) const {
  const QLineF line = epiLine(disparity_px);
  return {positionOf(line.x1(), line.y1()), positionOf(line.x2(), line.y2())};
}

void EpiPane::paintLines(QPainter& painter) const {
  if (cross_pixel_) {
    const QPointF at = positionOf(*cross_pixel_ + 0.5, cross_row_ + 0.5);
    const double x = std::floor(at.x()) + 0.5;
    const double y = std::floor(at.y()) + 0.5;
    QColor faint = theme::kCrossHair;
    const QLineF through_pixel = lies() ? QLineF(x, 0, x, height()) : QLineF(0, y, width(), y);
    const QLineF through_view = lies() ? QLineF(0, y, width(), y) : QLineF(x, 0, x, height());
    painter.setPen(QPen(faint, 1));
    painter.drawLine(through_pixel);
    faint.setAlpha(110);
    painter.setPen(QPen(faint, 1));
    painter.drawLine(through_view);
  }
  if (epi_.height() == 1) return;  // No slope between views.
  std::vector<Slope> slopes;
  const auto add_slope = [&](std::optional<double> disparity_px, const QColor& color,
                             Qt::PenStyle style) {
    if (cross_pixel_ && disparity_px) slopes.push_back({slopeLine(*disparity_px), color, style});
  };
  add_slope(background_truth_px_, theme::kTruth, Qt::SolidLine);
  add_slope(background_estimate_px_, theme::kEstimate, Qt::DashLine);
  add_slope(truth_px_, theme::kTruth, Qt::SolidLine);
  add_slope(estimate_px_, theme::kEstimate, Qt::DashLine);
  if (drawn_) {
    slopes.push_back(
        {{positionOf(drawn_->x1(), drawn_->y1()), positionOf(drawn_->x2(), drawn_->y2())},
         theme::kMeasured,
         Qt::SolidLine});
  }
  draw_slopes(painter, slopes);
}

void EpiPane::paintLabels(QPainter& painter) const {
  const bool is_horizontal = orientation_ == Qt::Horizontal;
  QFont small = font();
  small.setPointSizeF(small.pointSizeF() * 0.9);
  painter.setFont(small);
  draw_plate(painter, rect(), Qt::AlignLeft | Qt::AlignTop,
             is_horizontal ? tr("u ↓  x →")
             : lies()      ? tr("v ↓  y →")
                           : tr("v →  y ↓"),
             theme::kCanvasText);
  if (epi_.height() == 1) {
    draw_plate(painter, rect(), Qt::AlignRight | Qt::AlignBottom,
               is_horizontal ? tr("one column of views") : tr("one row of views"),
               theme::kCanvasText);
    return;
  }
  struct Legend {
    std::optional<double> value;
    QString name;
    QColor color;
  };
  const Legend legends[] = {{measured_px_, tr("measured"), theme::kMeasured},
                            {background_truth_px_, tr("truth behind"), theme::kTruth},
                            {truth_px_, tr("truth"), theme::kTruth},
                            {background_estimate_px_, tr("estimate behind"), theme::kEstimate},
                            {estimate_px_, tr("estimate"), theme::kEstimate}};
  // From the lower right corner: leftwards in a wide pane, upwards in a tall one.
  QRectF free = rect();
  for (const auto& legend : legends) {
    if (!legend.value) continue;
    const QString value = disparity_text(*legend.value);
    const QRectF plate = draw_plate(painter, free, Qt::AlignRight | Qt::AlignBottom,
                                    lies() ? legend.name + ' ' + value : value, legend.color);
    if (lies()) {
      free.setRight(plate.left());
    } else {
      free.setBottom(plate.top());
    }
  }
}

}  // namespace episcope
