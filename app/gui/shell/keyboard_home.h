// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

#include <functional>

class QKeyEvent;
class QWidget;

namespace episcope {

/// Keeps the keyboard with the view, so that browsing keys and letters mean the same wherever the
/// mouse was: a click on a button, list, slider or tab leaves the focus where it is. Only a field
/// that is typed in takes it, and gives it back on Return, and on Esc, which drops what was typed.
/// Controls are still reached by Tab; then arrows are theirs.
class KeyboardHome : public QObject {
  Q_OBJECT

 public:
  /// `home` gives the widget that the keyboard belongs to. Both outlive this.
  KeyboardHome(QWidget& window, std::function<QWidget*()> home);

  /// The keyboard goes home unless it is in a field or in a tab bar.
  void goHomeFromControls();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  [[nodiscard]] bool isOfWindow(const QObject* watched) const;
  static void greet(QWidget& widget);
  void endTyping(const QWidget& clicked);
  bool hear(QWidget& widget, QKeyEvent& key);
  [[nodiscard]] static bool belongsTo(const QWidget& widget, const QKeyEvent& key);
  void leave(QWidget& field, int key);
  void goHome();

  QWidget& window_;
  std::function<QWidget*()> home_;
};

}  // namespace episcope
