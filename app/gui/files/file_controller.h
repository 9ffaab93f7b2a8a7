// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"

#include <QObject>
#include <QStringList>

class QMenu;

namespace episcope {

/// Opens light fields and results that the user chooses or drops, and lists the recent ones.
class FileController : public QObject {
  Q_OBJECT

 public:
  explicit FileController(const Workbench& bench);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void addOpenCommands();
  void addSaveCommand();
  void addLeaveCommands();
  void askForFile();
  void askForFolder();
  void readAgain();
  void askForResult();
  void askForBuiltin();
  /// A result is added to the open light field; anything else is opened.
  void openAny(const QString& path);
  /// Tells of earlier failures once all of them were tried.
  void openAll(QStringList paths, const QStringList& failures);
  void remember(const QString& input);
  void fillRecentMenu();
  void showInvitation();

  Workbench bench_;
  QMenu* recent_menu_;
};

}  // namespace episcope
