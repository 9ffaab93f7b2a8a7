// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

#include <functional>

class QKeyEvent;
class QWidget;

namespace episcope {

/// Keeps the keyboard focus on the view, so that browsing keys always work: clicking a button,
/// list, slider or tab leaves the focus alone. A text field takes the focus, and returns it on
/// Return, or on Esc, which drops the input. Tab still reaches controls; arrows are theirs then.
class KeyboardHome : public QObject {
  Q_OBJECT

 public:
  /// `home` returns the widget that owns the keyboard. Both outlive this.
  KeyboardHome(QWidget& window, std::function<QWidget*()> home);

  /// Returns the focus to the view, unless it is in a field or a tab bar.
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
