// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QDialog>

namespace episcope {

class ActionTable;

/// Every key and mouse gesture, from the table of commands; blocks nothing.
class ShortcutWindow : public QDialog {
  Q_OBJECT

 public:
  ShortcutWindow(const ActionTable& table, QWidget* parent);
};

}  // namespace episcope
