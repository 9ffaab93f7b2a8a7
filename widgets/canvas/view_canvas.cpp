// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/view_canvas.h"

#include <QResizeEvent>

#include <algorithm>
#include <cmath>

namespace episcope {

ViewCanvas::ViewCanvas(QWidget* parent) : QWidget(parent) {
  setObjectName("viewCanvas");
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setAccessibleName(tr("View"));
  message_ = tr("Open a light field to see it here.");
}

void ViewCanvas::setPicture(const QImage& picture) {
  if (picture.isNull()) {
    showEmpty();
    return;
  }
  const bool is_new_size = picture.size() != picture_.size();
  picture_ = picture;
  if (state_ != State::Picture) setAccessibleDescription({});
  state_ = State::Picture;
  if (is_new_size) {
    zoomToFit();
    if (hovered_) emit cursorMoved(hovered_ = std::nullopt);
  }
  update();
}

void ViewCanvas::setOverlay(const QImage& overlay) {
  if (overlay.cacheKey() == overlay_.cacheKey()) return;  // it is set anew with every change
  overlay_ = overlay;
  update();
}

void ViewCanvas::setOverlayOpacity(double opacity) {
  overlay_opacity_ = std::clamp(opacity, 0.0, 1.0);
  update();
}

void ViewCanvas::setCrossHair(std::optional<PixelIndex> pixel) {
  if (pixel == cross_hair_) return;
  cross_hair_ = pixel;
  update();
}

void ViewCanvas::setPixelText(PixelText text) {
  pixel_text_ = std::move(text);
  update();
}

void ViewCanvas::setCaption(const QString& caption, Side side) {
  if (caption == caption_ && side == side_) return;
  caption_ = caption;
  side_ = side;
  update();
}

void ViewCanvas::setWipe(double position, const QImage& overlay, const QString& caption) {
  wipe_position_ = std::clamp(position, 0.0, 1.0);
  wipe_overlay_ = overlay;
  wipe_caption_ = caption;
  update();
}

void ViewCanvas::endWipe() {
  wipe_position_ = std::nullopt;
  wipe_overlay_ = {};
  if (gesture_ == Gesture::Wipe) gesture_ = Gesture::None;
  updateCursorShape();
  update();
}

double ViewCanvas::dividerX() const {
  return std::floor(wipe_position_.value_or(0) * width()) + 0.5;
}

bool ViewCanvas::isOnDivider(QPointF position) const {
  constexpr double kReach = 6;
  return wipe_position_ && std::abs(position.x() - dividerX()) <= kReach;
}

void ViewCanvas::setOutline(PixelEdges outline) {
  outline_ = std::move(outline);
  update();
}

void ViewCanvas::setRegion(PixelEdges region) {
  region_ = std::move(region);
  update();
}

void ViewCanvas::setParallaxEnabled(bool enabled) {
  parallax_enabled_ = enabled;
}

void ViewCanvas::showEmpty() {
  showMessage(State::Empty, empty_hint_);
}

void ViewCanvas::setEmptyHint(const QString& hint) {
  empty_hint_ = hint;
  if (state_ == State::Empty) showEmpty();
}

void ViewCanvas::showLoading(const QString& name, double fraction) {
  loading_fraction_ = std::min(fraction, 1.0);
  showMessage(State::Loading, name);
}

void ViewCanvas::showError(const QString& sentence) {
  showMessage(State::Failed, sentence);
}

void ViewCanvas::showMessage(State state, const QString& text) {
  state_ = state;
  message_ = text;
  setAccessibleDescription(text);
  picture_ = {};
  overlay_ = {};
  scribbles_ = {};
  cross_hair_ = std::nullopt;
  outline_.clear();
  endTool();
  gesture_ = Gesture::None;
  if (hovered_) emit cursorMoved(hovered_ = std::nullopt);
  update();
}

std::optional<PixelIndex> ViewCanvas::pixelAt(QPointF position) const {
  if (picture_.isNull()) return std::nullopt;
  const QPointF point = transform_.to_image(position, size());
  const PixelIndex pixel{static_cast<int>(std::floor(point.y())),
                         static_cast<int>(std::floor(point.x()))};
  if (!picture_.rect().contains(pixel.x, pixel.y)) return std::nullopt;
  return pixel;
}

QPointF ViewCanvas::positionOf(PixelIndex pixel) const {
  return transform_.to_widget({pixel.x + 0.5, pixel.y + 0.5}, size());
}

double ViewCanvas::fitScale() const {
  return fit_transform(picture_.size(), size()).scale;
}

QRect ViewCanvas::visiblePixels() const {
  if (picture_.isNull()) return {};
  const QRectF seen(transform_.to_image({0, 0}, size()),
                    transform_.to_image({width() * 1.0, height() * 1.0}, size()));
  return seen.toAlignedRect() & picture_.rect();
}

QSize ViewCanvas::sizeHint() const {
  return {640, 480};
}
QSize ViewCanvas::minimumSizeHint() const {
  return {160, 120};
}

void ViewCanvas::setCanvasTransform(const CanvasTransform& transform) {
  if (transform == transform_) return;
  changeTransform(transform, false);
}

void ViewCanvas::zoomIn() {
  zoomAt(cursor_.value_or(QRectF(rect()).center()), kCanvasZoomStep);
}

void ViewCanvas::zoomOut() {
  zoomAt(cursor_.value_or(QRectF(rect()).center()), 1 / kCanvasZoomStep);
}

void ViewCanvas::zoomToFit() {
  changeTransform(fit_transform(picture_.size(), size()), true);
}

void ViewCanvas::zoomToActualSize() {
  const QPointF anchor = cursor_.value_or(QRectF(rect()).center());
  zoomAt(anchor, 1 / devicePixelRatioF() / transform_.scale);
}

void ViewCanvas::ensureVisible(PixelIndex pixel) {
  if (picture_.isNull()) return;
  constexpr double kBorder = 16;
  const QRectF inside = QRectF(rect()).adjusted(kBorder, kBorder, -kBorder, -kBorder);
  const QPointF position = positionOf(pixel);
  const QPointF nearest(std::clamp(position.x(), inside.left(), inside.right()),
                        std::clamp(position.y(), inside.top(), inside.bottom()));
  if (nearest != position) changeTransform(transform_.panned(nearest - position), false);
}

void ViewCanvas::zoomAt(QPointF anchor, double factor) {
  if (picture_.isNull()) return;
  changeTransform(transform_.zoomed(factor, anchor, size()), false);
}

void ViewCanvas::changeTransform(const CanvasTransform& transform, bool fitted) {
  fitted_ = fitted;
  CanvasTransform bounded = transform;
  // Some of the picture always stays in sight.
  bounded.center.setX(std::clamp(bounded.center.x(), 0.0, std::max(1.0, picture_.width() * 1.0)));
  bounded.center.setY(std::clamp(bounded.center.y(), 0.0, std::max(1.0, picture_.height() * 1.0)));
  if (bounded == transform_) return;
  transform_ = bounded;
  update();
  updateMark();
  emit transformChanged(transform_);
}

void ViewCanvas::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  if (fitted_ && !picture_.isNull()) zoomToFit();
}

}  // namespace episcope

#include "moc_view_canvas.cpp"
