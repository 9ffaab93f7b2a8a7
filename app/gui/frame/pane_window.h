// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QWidget>

namespace episcope {

/// A window that holds one pane of another window.
class PaneWindow : public QWidget {
  Q_OBJECT

 public:
  /// Takes the widget, and stays above `owner`.
  PaneWindow(QWidget* widget, const QString& title, QWidget* owner);

 signals:
  /// The user closed it; it still holds the pane.
  void closed();

 protected:
  void closeEvent(QCloseEvent* event) override;
};

/// The main window of a widget: that of the owner where the widget is in a torn-off pane.
[[nodiscard]] const QWidget* main_window_of(const QWidget& widget);

}  // namespace episcope
