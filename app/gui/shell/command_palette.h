// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/commands.h"

#include <QDialog>
#include <QString>

#include <vector>

class QKeySequenceEdit;
class QLabel;
class QLineEdit;
class QListWidget;
class QPushButton;
class QTreeWidget;

namespace episcope {

/// Finds commands, methods, open and recent light fields by words of their names, descriptions or
/// synonyms; Enter runs, chooses or opens what was found. Those whose name matches come first.
class CommandPalette : public QDialog {
  Q_OBJECT

 public:
  CommandPalette(const Commands& commands, QWidget* parent);

  /// Opens empty under the top edge of the parent.
  void popUp();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  struct Entry {
    PaletteTarget target;
    QString keys;
    bool can_run = true;
  };
  /// How well an entry matches; the best is 0.
  enum class Rank { Name, Description, CannotRun, None };

  [[nodiscard]] std::vector<Entry> entries() const;
  [[nodiscard]] static Rank rankOf(const Entry& entry, const QString& text);
  void filter(const QString& text);
  void add(const Entry& entry);
  void runCurrent();

  const Commands& commands_;
  std::vector<Entry> entries_;  // as of the opening
  QLineEdit* edit_;
  QListWidget* list_;
};

/// Every key and mouse gesture, from the table of commands. To change a key, choose a command,
/// press the new key and set it. A key of another command is named, and taken from it only on
/// request. Does not block.
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
  /// Shows only rows that contain the text.
  void filter(const QString& text);
  /// Id of the selected command; empty on gestures.
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
