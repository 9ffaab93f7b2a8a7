// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/tools/canvas_tool.h"
#include "widgets/canvas/view_canvas.h"

#include <QPainter>
#include <QTabletEvent>

namespace episcope {

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
  // Smoothing spreads a pixel to its neighbours.
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

void ViewCanvas::paintMark(QPainter& painter) const {
  const bool is_in_use = gesture_ == Gesture::None || gesture_ == Gesture::Tool;
  if (tool_ && cursor_ && is_in_use && !space_held_) {
    tool_->paintMark(painter, *cursor_, transform_.scale);
  }
}

void ViewCanvas::paintShape(QPainter& painter) const {
  if (!tool_) return;
  const QPointF origin = transform_.to_widget(QPointF(0, 0), size());
  QTransform widget_from_image = QTransform::fromTranslate(origin.x(), origin.y());
  widget_from_image.scale(transform_.scale, transform_.scale);
  tool_->paintShape(painter, widget_from_image);
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
