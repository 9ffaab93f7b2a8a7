// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/view_canvas.h"

#include "widgets/canvas/canvas_tool.h"

#include <QApplication>
#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QResizeEvent>
#include <QStyleHints>
#include <QTabletEvent>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>

namespace episcope {

ViewCanvas::ViewCanvas(QWidget* parent) : QWidget(parent) {
  setObjectName("viewCanvas");
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setAccessibleName(tr("View"));
  message_ = empty_hint_;
}

void ViewCanvas::setPicture(const QImage& picture) {
  if (picture.isNull()) {
    showEmpty();
    return;
  }
  const bool is_new_size = picture.size() != picture_.size();
  picture_ = picture;
  makeGrey();
  if (state_ != State::Picture) setAccessibleDescription({});
  state_ = State::Picture;
  if (is_new_size) {
    zoomToFit();
    if (hovered_) emit cursorMoved(hovered_ = std::nullopt);
    emit pictureResized();
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

void ViewCanvas::setGreyUnderOverlay(bool is_grey) {
  if (std::exchange(is_grey_under_overlay_, is_grey) == is_grey) return;
  makeGrey();
  update();
}

void ViewCanvas::makeGrey() {
  if (!is_grey_under_overlay_ || picture_.isNull()) {
    grey_picture_ = {};
    return;
  }
  grey_picture_ = picture_.convertToFormat(QImage::Format_ARGB32_Premultiplied);
  for (int y = 0; y < grey_picture_.height(); ++y) {
    auto* row = reinterpret_cast<QRgb*>(grey_picture_.scanLine(y));
    std::transform(row, row + grey_picture_.width(), row, [](QRgb pixel) {
      const int grey = qGray(pixel);
      return qRgba(grey, grey, grey, qAlpha(pixel));
    });
  }
}

const QImage& ViewCanvas::pictureUnder(const QImage& overlay) const {
  return overlay.isNull() || grey_picture_.isNull() ? picture_ : grey_picture_;
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

void ViewCanvas::setEmptyHint(const QString& hint) {
  empty_hint_ = hint;
  if (state_ == State::Empty) showEmpty();
}

void ViewCanvas::showLoading(const QString& name, double fraction) {
  loading_fraction_ = std::min(fraction, 1.0);
  showMessage(State::Loading, name);
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

QRect ViewCanvas::visiblePixels() const {
  if (picture_.isNull()) return {};
  const QRectF seen(transform_.to_image({0, 0}, size()),
                    transform_.to_image({width() * 1.0, height() * 1.0}, size()));
  return seen.toAlignedRect() & picture_.rect();
}

void ViewCanvas::setCanvasTransform(const CanvasTransform& transform) {
  if (transform == transform_) return;
  changeTransform(transform, false);
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

namespace {

/// Way of the hand for one view step of parallax, logical pixels.
constexpr double kParallaxStep = 32;
constexpr double kWheelNotch = 120;

}  // namespace

bool ViewCanvas::event(QEvent* event) {
  // Held, Space pans: no shortcut may take it while we have the focus.
  if (event->type() == QEvent::ShortcutOverride &&
      static_cast<QKeyEvent*>(event)->key() == Qt::Key_Space) {
    event->accept();
    return true;
  }
  return QWidget::event(event);
}

void ViewCanvas::wheelEvent(QWheelEvent* event) {
  // With Alt held, some platforms report the vertical wheel as a horizontal one.
  const QPoint angle = event->angleDelta();
  const double turned = angle.y() != 0 ? angle.y() : angle.x();
  const auto modifiers = event->modifiers();
  const bool is_for_tool = modifiers & Qt::ControlModifier && modifiers & Qt::ShiftModifier;
  if (picture_.isNull() || (is_for_tool && !tool_)) {
    event->ignore();
    return;
  }
  if (is_for_tool) {
    tool_->step(turned / kWheelNotch);
  } else if (modifiers & (Qt::AltModifier | Qt::ControlModifier)) {  // Alt may be the desktop's
    emit focusStepped(turned / kWheelNotch);
  } else {
    zoomAt(event->position(), wheel_zoom(turned));
    followCursor(event->position());
  }
  event->accept();
}

void ViewCanvas::mousePressEvent(QMouseEvent* event) {
  if (picture_.isNull() || gesture_ != Gesture::None) return;
  press_position_ = last_position_ = event->position();
  press_modifiers_ = event->modifiers();
  gesture_button_ = event->button();
  if (event->button() == Qt::MiddleButton || (event->button() == Qt::LeftButton && space_held_)) {
    gesture_ = Gesture::Pan;
    space_used_ = true;
    updateCursorShape();
  } else if (event->button() == Qt::LeftButton && isOnDivider(event->position())) {
    gesture_ = Gesture::Wipe;
    updateCursorShape();
  } else if (pressTool(event->position(), event->button(), event->modifiers(),
                       event->type() == QEvent::MouseButtonDblClick)) {
    event->accept();
  } else if (event->button() == Qt::LeftButton) {
    gesture_ = Gesture::Press;
    updateCursorShape();
  } else {
    event->ignore();
  }
}

void ViewCanvas::mouseMoveEvent(QMouseEvent* event) {
  const QPointF position = event->position();
  if (gesture_ == Gesture::Press && !(press_modifiers_ & Qt::ShiftModifier) &&
      (position - press_position_).manhattanLength() >=
          QGuiApplication::styleHints()->startDragDistance()) {
    beginDrag();
  }
  drag(position);
  followCursor(position);
  if (gesture_ == Gesture::None) updateCursorShape();
}

void ViewCanvas::beginDrag() {
  if (tool_) return;  // Ctrl+drag: a press on the cross-hair's new place
  gesture_ = parallax_enabled_ ? Gesture::Parallax : Gesture::Pan;
  updateCursorShape();
  if (gesture_ == Gesture::Parallax) emit parallaxStarted();
}

void ViewCanvas::drag(QPointF position) {
  if (gesture_ == Gesture::Pan) {
    changeTransform(transform_.panned(position - last_position_), false);
  } else if (gesture_ == Gesture::Parallax) {
    // A point of disparity d > 0 moves by −d per view: the other way than the views.
    emit parallaxDragged((press_position_ - position) / kParallaxStep);
  } else if (gesture_ == Gesture::Wipe) {
    emit wipeMoved(std::clamp(position.x() / std::max(1, width()), 0.0, 1.0));
  } else if (gesture_ == Gesture::Tool) {
    tool_->drag(transform_.to_image(position, size()));
  }
  last_position_ = position;
}

void ViewCanvas::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != gesture_button_) return;
  const Gesture ended = gesture_;
  gesture_ = Gesture::None;
  if (ended == Gesture::Tool) tool_->release();
  updateCursorShape();
  updateMark();
  if (ended != Gesture::Press) return;
  if (const auto pixel = pixelAt(press_position_)) {
    if (press_modifiers_ & Qt::ShiftModifier) {
      emit focusRequested(*pixel);
    } else {
      emit crossHairRequested(*pixel);
    }
  }
}

void ViewCanvas::mouseDoubleClickEvent(QMouseEvent* event) {
  if (tool_) {
    mousePressEvent(event);  // quick dabs
  } else if (event->button() == Qt::LeftButton && !picture_.isNull() && !space_held_) {
    emit centerRequested();
  }
}

// The key of menus asks for the pixel of the cross-hair.
void ViewCanvas::contextMenuEvent(QContextMenuEvent* event) {
  const bool is_key = event->reason() == QContextMenuEvent::Keyboard;
  const auto pixel = is_key ? cross_hair_ : pixelAt(event->pos());
  if (tool_ || picture_.isNull() || !pixel) return event->ignore();
  emit menuRequested(*pixel,
                     is_key ? mapToGlobal(positionOf(*pixel).toPoint()) : event->globalPos());
}

void ViewCanvas::followCursor(std::optional<QPointF> position) {
  cursor_ = position;
  if (tool_) updateMark();
  if (tool_ && position && gesture_ == Gesture::None) {
    tool_->hover(transform_.to_image(*position, size()));
  }
  const auto pixel = position ? pixelAt(*position) : std::nullopt;
  if (pixel == hovered_) return;
  hovered_ = pixel;
  emit cursorMoved(hovered_);
}

void ViewCanvas::keyPressEvent(QKeyEvent* event) {
  if (event->key() != Qt::Key_Space) {
    QWidget::keyPressEvent(event);
    return;
  }
  if (event->isAutoRepeat()) return;
  space_held_ = true;
  space_used_ = false;
  updateCursorShape();
}

void ViewCanvas::keyReleaseEvent(QKeyEvent* event) {
  if (event->key() != Qt::Key_Space) {
    QWidget::keyReleaseEvent(event);
    return;
  }
  if (event->isAutoRepeat() || !space_held_) return;
  space_held_ = false;
  updateCursorShape();
  if (!space_used_) emit spaceTapped();
}

void ViewCanvas::focusOutEvent(QFocusEvent* event) {
  space_held_ = false;
  endTool();
  updateCursorShape();
  QWidget::focusOutEvent(event);
}

void ViewCanvas::hideEvent(QHideEvent* event) {
  endTool();
  QWidget::hideEvent(event);
}

void ViewCanvas::endTool() {
  if (gesture_ != Gesture::Tool) return;
  gesture_ = Gesture::None;
  has_pen_ = false;
  tool_->end();
}

void ViewCanvas::updateCursorShape() {
  if (gesture_ == Gesture::Pan) {
    setCursor(Qt::ClosedHandCursor);
  } else if (gesture_ == Gesture::Parallax) {
    setCursor(Qt::SizeAllCursor);
  } else if (space_held_) {
    setCursor(Qt::OpenHandCursor);
  } else if (gesture_ == Gesture::Wipe || (cursor_ && isOnDivider(*cursor_))) {
    setCursor(Qt::SplitHCursor);
  } else if (tool_) {
    setCursor(tool_->cursor());
  } else {
    setCursor(Qt::CrossCursor);
  }
}

void ViewCanvas::setTool(CanvasTool* tool) {
  if (tool == tool_) return;
  if (tool_) {
    tool_->putAway();
    tool_->disconnect(this);
  }
  tool_ = tool;
  if (gesture_ == Gesture::Tool) gesture_ = Gesture::None;
  if (tool_) {
    connect(tool_, &CanvasTool::changed, this, [this] {
      updateCursorShape();
      updateMark();
    });
    connect(tool_, &CanvasTool::shapeChanged, this, qOverload<>(&ViewCanvas::update));
  }
  updateCursorShape();
  update();
}

void ViewCanvas::setScribbles(const QImage& scribbles) {
  scribbles_ = scribbles;
  update();
}

void ViewCanvas::patchScribbles(QPoint at, const QImage& patch) {
  if (patch.isNull() || scribbles_.isNull()) return;
  QPainter painter(&scribbles_);
  painter.setCompositionMode(QPainter::CompositionMode_Source);
  painter.drawImage(at, patch);
  painter.end();
  updatePixels(QRect(at, patch.size()));
}

void ViewCanvas::setScribbleOpacity(double opacity) {
  scribble_opacity_ = std::clamp(opacity, 0.0, 1.0);
  update();
}

void ViewCanvas::updatePixels(const QRect& pixels) {
  // Smoothing spreads a pixel to its neighbors.
  const QRectF spread = QRectF(pixels).adjusted(-1, -1, 1, 1);
  update(QRectF(transform_.to_widget(spread.topLeft(), size()),
                transform_.to_widget(spread.bottomRight(), size()))
             .toAlignedRect()
             .adjusted(-1, -1, 1, 1));
}

void ViewCanvas::updateMark() {
  update(mark_rect_);
  mark_rect_ = {};
  if (!tool_ || !cursor_ || picture_.isNull()) return;
  mark_rect_ = tool_->markRect(*cursor_, transform_.scale).toAlignedRect();
  update(mark_rect_);
}

bool ViewCanvas::pressTool(QPointF position, Qt::MouseButton button,
                           Qt::KeyboardModifiers modifiers, bool is_double) {
  const bool is_painting = tool_ && (button == Qt::LeftButton || button == Qt::RightButton) &&
                           !(modifiers & Qt::ControlModifier);
  if (!is_painting) return false;
  gesture_ = Gesture::Tool;
  gesture_button_ = button;
  tool_->press({transform_.to_image(position, size()), button, modifiers, is_double});
  updateCursorShape();
  return true;
}

// Finer than the mouse events that would be made of it; the other end of a pen erases.
void ViewCanvas::tabletEvent(QTabletEvent* event) {
  const bool is_eraser = event->pointerType() == QPointingDevice::PointerType::Eraser;
  const QPointF position = event->position();
  if (event->type() == QEvent::TabletPress) {
    const auto button = is_eraser ? Qt::RightButton : event->button();
    const bool is_free = gesture_ == Gesture::None && !picture_.isNull() && !space_held_;
    if (!is_free || !pressTool(position, button, event->modifiers())) {
      event->ignore();
      return;
    }
    has_pen_ = true;
  } else if (!has_pen_) {
    event->ignore();
    return;
  } else if (event->type() == QEvent::TabletMove) {
    drag(position);
  } else {
    has_pen_ = false;
    gesture_ = Gesture::None;
    if (tool_) tool_->release();
  }
  followCursor(position);
  event->accept();
}

}  // namespace episcope

#include "moc_view_canvas.cpp"
