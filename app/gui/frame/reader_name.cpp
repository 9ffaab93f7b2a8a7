// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/frame/reader_name.h"

#include <QAccessible>
#include <QWidget>

namespace episcope {

void name_for_readers(QWidget& control) {
  if (control.toolTip().isEmpty()) return;
  QAccessibleInterface* reader = QAccessible::queryAccessibleInterface(&control);
  if (!reader || !reader->text(QAccessible::Name).trimmed().isEmpty()) return;
  control.setAccessibleName(control.toolTip().section('\n', 0, 0));
}

}  // namespace episcope
