// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/frame/pane_window.h"

#include <QCloseEvent>
#include <QVBoxLayout>

namespace episcope {

// A tool window, so that the keys of its owner are heard in it.
PaneWindow::PaneWindow(QWidget* widget, const QString& title, QWidget* owner)
    : QWidget(owner, Qt::Tool | Qt::WindowMaximizeButtonHint | Qt::WindowCloseButtonHint) {
  setWindowTitle(title);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(widget);
  widget->show();
}

void PaneWindow::closeEvent(QCloseEvent* event) {
  event->accept();
  emit closed();
}

const QWidget* main_window_of(const QWidget& widget) {
  const QWidget* window = widget.window();
  const auto* pane = qobject_cast<const PaneWindow*>(window);
  return pane && pane->parentWidget() ? pane->parentWidget()->window() : window;
}

}  // namespace episcope

#include "moc_pane_window.cpp"
