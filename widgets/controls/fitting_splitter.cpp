// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/fitting_splitter.h"

#include <QEvent>

#include <algorithm>

namespace episcope {

FittingSplitter::FittingSplitter(int least_rest, QWidget* parent)
    : QSplitter(Qt::Vertical, parent), least_rest_(least_rest) {
  setChildrenCollapsible(false);
  connect(this, &QSplitter::splitterMoved, this, [this] { is_dragged_ = true; });
}

bool FittingSplitter::event(QEvent* event) {
  const bool is_handled = QSplitter::event(event);
  if (event->type() == QEvent::LayoutRequest) fit();
  return is_handled;
}

void FittingSplitter::resizeEvent(QResizeEvent* event) {
  QSplitter::resizeEvent(event);
  fit();
}

void FittingSplitter::fit() {
  if (is_dragged_ || count() != 2) return;
  const int room = height() - handleWidth();
  const int wanted = std::min(widget(0)->sizeHint().height(), room - least_rest_);
  setSizes({wanted, room - wanted});
}

}  // namespace episcope

#include "moc_fitting_splitter.cpp"
