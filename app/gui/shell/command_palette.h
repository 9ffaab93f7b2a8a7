// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QDialog>

class QLineEdit;
class QListWidget;

namespace episcope {

class Commands;

/// Finds any command by typing parts of its name; Enter runs it.
class CommandPalette : public QDialog {
  Q_OBJECT

 public:
  CommandPalette(const Commands& commands, QWidget* parent);

  /// Opens empty under the top edge of the parent.
  void popUp();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void filter(const QString& text);
  void list(const QString& text, bool can_run);
  void runCurrent();

  const Commands& commands_;
  QLineEdit* edit_;
  QListWidget* list_;
};

}  // namespace episcope
