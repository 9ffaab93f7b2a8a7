// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/epi_pane.h"

#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"

#include <QContextMenuEvent>
#include <QGuiApplication>
#include <QMouseEvent>
#include <QPaintEvent>
#include <QPainter>
#include <QStyleHints>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace episcope {
namespace {

/// Logical pixels for a row, when there are as many as in a 9×9 light field.
constexpr int kRowHint = 10;
constexpr int kRowsHint = 9;

}  // namespace

EpiPane::EpiPane(Qt::Orientation orientation, QWidget* parent)
    : QWidget(parent), orientation_(orientation) {
  const bool is_horizontal = orientation == Qt::Horizontal;
  setObjectName(is_horizontal ? "horizontalEpi" : "verticalEpi");
  setAccessibleName(is_horizontal ? tr("Horizontal EPI") : tr("Vertical EPI"));
  setToolTip(
      tr("Epipolar plane image through the cross-hair. Drag along a line to measure its "
         "disparity; click to move the cross-hair; wheel to zoom."));
  setSizePolicy(is_horizontal ? QSizePolicy::Expanding : QSizePolicy::Preferred,
                is_horizontal ? QSizePolicy::Preferred : QSizePolicy::Expanding);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setCursor(Qt::CrossCursor);
}

void EpiPane::setEpi(const QImage& epi) {
  if (epi.isNull()) clearMeasurement();
  epi_ = epi;
  update();
}

void EpiPane::setCrossHair(std::optional<int> pixel, int row) {
  cross_pixel_ = pixel;
  cross_row_ = row;
  update();
}

void EpiPane::setSlopes(std::optional<double> estimate_px, std::optional<double> truth_px) {
  estimate_px_ = estimate_px;
  truth_px_ = truth_px;
  update();
}

void EpiPane::setBackgroundSlopes(std::optional<double> estimate_px,
                                  std::optional<double> truth_px) {
  background_estimate_px_ = estimate_px;
  background_truth_px_ = truth_px;
  update();
}

void EpiPane::setFocus(double focus_px) {
  if (focus_px == focus_px_) return;
  focus_px_ = focus_px;
  clearMeasurement();  // The line drawn by hand belonged to the other shear.
}

void EpiPane::clearMeasurement() {
  drawn_ = std::nullopt;
  measured_px_ = std::nullopt;
  update();
}

QLineF EpiPane::epiLine(double disparity_px) const {
  const double per_row = -(disparity_px - focus_px_);
  const double x = *cross_pixel_ + 0.5;
  const double row = cross_row_ + 0.5;
  const double end = epi_.height();
  return {x - per_row * row, 0, x + per_row * (end - row), end};
}

void EpiPane::showMeasurement(double disparity_px) {
  if (epi_.isNull() || !cross_pixel_) return;
  drawn_ = epiLine(disparity_px);
  measured_px_ = disparity_px;
  update();
}

std::optional<int> EpiPane::measuredPixel() const {
  if (!measured_px_) return std::nullopt;
  const double rows = cross_row_ + 0.5 - drawn_->y1();
  const double place = std::floor(drawn_->x1() + rows * drawn_->dx() / drawn_->dy());
  const bool is_inside = place >= 0 && place < epi_.width();
  return is_inside ? std::optional(static_cast<int>(place)) : std::nullopt;
}

void EpiPane::setMayLie(bool may_lie) {
  if (std::exchange(may_lie_, may_lie) == may_lie) return;
  updateGeometry();
  update();
}

bool EpiPane::lies() const {
  return orientation_ == Qt::Horizontal || (may_lie_ && width() > height());
}

CanvasTransform EpiPane::turned(const CanvasTransform& transform) const {
  const bool is_turned = orientation_ == Qt::Vertical && lies();
  return is_turned ? CanvasTransform{transform.scale, transform.center.transposed()} : transform;
}

double EpiPane::rowExtent() const {
  if (epi_.isNull()) return kRowHint;
  return 1.0 * (lies() ? height() : width()) / epi_.height();
}

QPointF EpiPane::positionOf(double along, double row) const {
  const double across = row * rowExtent();
  const QPointF at = turned(transform_).to_widget({along, along}, size());
  return lies() ? QPointF(at.x(), across) : QPointF(across, at.y());
}

QPointF EpiPane::epiAt(QPointF position) const {
  const QPointF image = turned(transform_).to_image(position, size());
  return lies() ? QPointF(image.x(), position.y() / rowExtent())
                : QPointF(image.y(), position.x() / rowExtent());
}

QSize EpiPane::sizeHint() const {
  const QSize hint(480, kRowHint * kRowsHint);
  return orientation_ == Qt::Horizontal || may_lie_ ? hint : hint.transposed();
}

QSize EpiPane::minimumSizeHint() const {
  const QSize least(80, 5 * kRowsHint);
  return orientation_ == Qt::Horizontal || may_lie_ ? least : least.transposed();
}

void EpiPane::setCanvasTransform(const CanvasTransform& transform) {
  if (transform == transform_) return;
  transform_ = transform;
  update();
}

void EpiPane::wheelEvent(QWheelEvent* event) {
  if (epi_.isNull() || event->angleDelta().y() == 0) {
    event->ignore();
    return;
  }
  // Only the shared axis has an anchor here: the other one keeps its middle.
  QPointF anchor = event->position();
  if (lies()) {
    anchor.setY(height() / 2.0);
  } else {
    anchor.setX(width() / 2.0);
  }
  const double factor = wheel_zoom(event->angleDelta().y());
  emit transformChanged(turned(turned(transform_).zoomed(factor, anchor, size())));
  event->accept();
}

void EpiPane::mousePressEvent(QMouseEvent* event) {
  if (epi_.isNull()) return;
  press_position_ = last_position_ = event->position();
  pressed_ = event->button() == Qt::LeftButton;
  drawing_ = false;
  panning_ = event->button() == Qt::MiddleButton;
}

void EpiPane::mouseMoveEvent(QMouseEvent* event) {
  const QPointF position = event->position();
  if (panning_) {
    QPointF delta = position - last_position_;
    (lies() ? delta.ry() : delta.rx()) = 0;
    last_position_ = position;
    emit transformChanged(turned(turned(transform_).panned(delta)));
    return;
  }
  const int start = QGuiApplication::styleHints()->startDragDistance();
  if (!pressed_ || (!drawing_ && (position - press_position_).manhattanLength() < start)) return;
  drawing_ = true;
  drawn_ = QLineF(epiAt(press_position_), epiAt(position));
  measure();
  update();
}

void EpiPane::measure() {
  // A point moves by −(d − focus) along the image axis per row.
  const double rows = drawn_->dy();
  measured_px_ =
      std::abs(rows) >= 0.5 ? std::optional(focus_px_ - drawn_->dx() / rows) : std::nullopt;
}

void EpiPane::mouseReleaseEvent(QMouseEvent* event) {
  const bool was_left = pressed_ && event->button() == Qt::LeftButton;
  pressed_ = false;
  panning_ = false;
  if (was_left && drawing_) {
    if (measured_px_) emit disparityMeasured(*measured_px_);
  } else if (was_left) {
    const int row = static_cast<int>(epiAt(press_position_).y());
    clearMeasurement();
    if (const auto pixel = pixelAt(press_position_)) {
      emit positionClicked(*pixel, std::clamp(row, 0, epi_.height() - 1));
    }
  }
}

std::optional<int> EpiPane::pixelAt(QPointF position) const {
  const int pixel = static_cast<int>(std::floor(epiAt(position).x()));
  return pixel >= 0 && pixel < epi_.width() ? std::optional(pixel) : std::nullopt;
}

void EpiPane::contextMenuEvent(QContextMenuEvent* event) {
  const auto pixel = epi_.isNull() ? std::nullopt : pixelAt(event->pos());
  if (!pixel) return event->ignore();
  emit menuRequested(*pixel, event->globalPos());
}

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
                            {background_truth_px_, tr("ground truth behind"), theme::kTruth},
                            {truth_px_, tr("ground truth"), theme::kTruth},
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

#include "moc_epi_pane.cpp"
