// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/keyboard_home.h"

#include "app/gui/shell/panes.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QAccessible>
#include <QApplication>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QKeyEvent>
#include <QLineEdit>
#include <QSpinBox>
#include <QTabBar>
#include <QTextEdit>
#include <QWidget>

#include <utility>

class QWidget;

namespace episcope {
namespace {

// Names a control for screen readers by the first line of its tool tip, if it has neither text,
// label nor name.
void name_for_readers(QWidget& control) {
  if (control.toolTip().isEmpty()) return;
  QAccessibleInterface* reader = QAccessible::queryAccessibleInterface(&control);
  if (!reader || !reader->text(QAccessible::Name).trimmed().isEmpty()) return;
  control.setAccessibleName(control.toolTip().section('\n', 0, 0));
}

bool is_control(const QWidget& widget) {
  return qobject_cast<const QAbstractButton*>(&widget) ||
         qobject_cast<const QAbstractItemView*>(&widget) ||
         qobject_cast<const QAbstractSlider*>(&widget) || qobject_cast<const QTabBar*>(&widget) ||
         qobject_cast<const QComboBox*>(&widget);
}

bool is_field(const QWidget& widget) {
  const auto* combo = qobject_cast<const QComboBox*>(&widget);
  return qobject_cast<const QAbstractSpinBox*>(&widget) ||
         qobject_cast<const QLineEdit*>(&widget) || qobject_cast<const QTextEdit*>(&widget) ||
         (combo && combo->isEditable());
}

// A name that is edited in its list, which ends that itself on the same keys.
bool is_in_place(const QWidget& field) {
  for (const QWidget* each = field.parentWidget(); each; each = each->parentWidget()) {
    if (qobject_cast<const QAbstractItemView*>(each)) return true;
  }
  return false;
}

bool moves(const QKeyEvent& key) {
  switch (key.key()) {
    case Qt::Key_Left:
    case Qt::Key_Right:
    case Qt::Key_Up:
    case Qt::Key_Down:
    case Qt::Key_Home:
    case Qt::Key_End:
      return true;
    default:
      return false;
  }
}

bool presses(const QKeyEvent& key) {
  return key.key() == Qt::Key_Space || key.key() == Qt::Key_Return || key.key() == Qt::Key_Enter;
}

void drop_typed(QWidget& field) {
  if (auto* number = qobject_cast<QDoubleSpinBox*>(&field)) number->setValue(number->value());
  if (auto* number = qobject_cast<QSpinBox*>(&field)) number->setValue(number->value());
}

}  // namespace

KeyboardHome::KeyboardHome(QWidget& window, std::function<QWidget*()> home)
    : QObject(&window), window_(window), home_(std::move(home)) {
  QApplication::instance()->installEventFilter(this);
}

bool KeyboardHome::isOfWindow(const QObject* watched) const {
  return watched->isWidgetType() &&
         main_window_of(*static_cast<const QWidget*>(watched)) == &window_;
}

bool KeyboardHome::eventFilter(QObject* watched, QEvent* event) {
  switch (event->type()) {
    case QEvent::Polish:
    case QEvent::Show:  // some were polished before they came into the window
      if (isOfWindow(watched)) greet(*static_cast<QWidget*>(watched));
      return false;
    case QEvent::MouseButtonPress:
      if (isOfWindow(watched)) endTyping(*static_cast<QWidget*>(watched));
      return false;
    case QEvent::ShortcutOverride:
    case QEvent::KeyPress:
      return watched == QApplication::focusWidget() && isOfWindow(watched) &&
             hear(*static_cast<QWidget*>(watched), *static_cast<QKeyEvent*>(event));
    default:
      return false;
  }
}

void KeyboardHome::greet(QWidget& widget) {
  if (is_control(widget) || is_field(widget)) name_for_readers(widget);
  if (is_control(widget) && !is_field(widget) && widget.focusPolicy() != Qt::NoFocus) {
    widget.setFocusPolicy(Qt::TabFocus);
  }
}

// Applies typed input before any click.
void KeyboardHome::endTyping(const QWidget& clicked) {
  const QWidget* focus = QApplication::focusWidget();
  if (!focus || !is_field(*focus) || focus == &clicked || focus->isAncestorOf(&clicked)) return;
  if (isOfWindow(focus)) goHome();
}

bool KeyboardHome::hear(QWidget& widget, QKeyEvent& key) {
  if (key.type() == QEvent::ShortcutOverride) {
    if (!belongsTo(widget, key)) return false;
    key.accept();
    return true;
  }
  if (is_field(widget)) leave(widget, key.key());
  return false;
}

bool KeyboardHome::belongsTo(const QWidget& widget, const QKeyEvent& key) {
  if (key.modifiers() & (Qt::ControlModifier | Qt::AltModifier)) return false;
  if (is_field(widget)) return moves(key) || key.key() == Qt::Key_Escape;
  return is_control(widget) && (moves(key) || presses(key));
}

// Runs after the field has handled the key.
void KeyboardHome::leave(QWidget& field, int key) {
  const bool drops = key == Qt::Key_Escape;
  if (!drops && key != Qt::Key_Return && key != Qt::Key_Enter) return;
  if (qobject_cast<QTextEdit*>(&field) && !drops) return;
  if (is_in_place(field)) {
    connect(&field, &QObject::destroyed, this, &KeyboardHome::goHome, Qt::QueuedConnection);
    return;
  }
  if (drops) drop_typed(field);
  QMetaObject::invokeMethod(this, &KeyboardHome::goHome, Qt::QueuedConnection);
}

void KeyboardHome::goHome() {
  QWidget* home = home_();
  if (!home) return;
  // From a pane in a window of its own, the keyboard goes back to the main one.
  const QWidget* focus = QApplication::focusWidget();
  if (focus && focus->window() != &window_) window_.activateWindow();
  home->setFocus(Qt::OtherFocusReason);
}

void KeyboardHome::goHomeFromControls() {
  const QWidget* focus = QApplication::focusWidget();
  const bool stays = focus && (is_field(*focus) || qobject_cast<const QTabBar*>(focus));
  if (!stays) goHome();
}

}  // namespace episcope

#include "moc_keyboard_home.cpp"
