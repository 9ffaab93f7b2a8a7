// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/browse/epi_pane.h"

#include <QGuiApplication>
#include <QMouseEvent>
#include <QStyleHints>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>
#include <utility>

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
    const QPointF point = epiAt(press_position_);
    clearMeasurement();
    const int pixel = static_cast<int>(std::floor(point.x()));
    if (pixel < 0 || pixel >= epi_.width()) return;
    emit positionClicked(pixel, std::clamp(static_cast<int>(point.y()), 0, epi_.height() - 1));
  }
}

}  // namespace episcope

#include "moc_epi_pane.cpp"
