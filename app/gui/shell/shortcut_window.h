// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QDialog>
#include <QKeySequence>
#include <QString>

class QKeySequenceEdit;
class QLabel;
class QLineEdit;
class QPushButton;
class QTreeWidget;

namespace episcope {

class Commands;

/// Every key and mouse gesture, from the table of commands. Keys can be changed here: choose a
/// command, press the new key, set it; a key that another command has is named and taken from it
/// only when asked to. Blocks nothing.
class ShortcutWindow : public QDialog {
  Q_OBJECT

 public:
  ShortcutWindow(Commands& commands, QWidget* parent);

 private:
  void fillGestures();
  void addGestures(const QString& title, const QList<QStringList>& gestures);
  void fillCommands();
  QWidget* makeEditor();
  void showKeys();
  /// Leaves the rows that hold the text.
  void filter(const QString& text);
  /// Of the selected row; empty on gestures.
  [[nodiscard]] QString command() const;
  void updateEditor();
  void setKey();

  Commands& commands_;
  QLineEdit* find_;
  QTreeWidget* tree_;
  QKeySequenceEdit* edit_ = nullptr;
  QLabel* hint_ = nullptr;
  QPushButton* set_ = nullptr;
  QPushButton* reset_ = nullptr;
};

}  // namespace episcope
