// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/tools/canvas_tool.h"
#include "widgets/canvas/view_canvas.h"

#include <QApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QStyleHints>
#include <QWheelEvent>

#include <algorithm>

namespace episcope {
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
  if (ended == Gesture::Parallax) emit parallaxFinished();
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

void ViewCanvas::leaveEvent(QEvent*) {
  followCursor(std::nullopt);
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

}  // namespace episcope
