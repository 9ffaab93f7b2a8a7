// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"
#include "engine/io/write.h"

#include <QObject>
#include <QString>
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

/// What was opened before, newest first, as the settings keep it.
[[nodiscard]] QStringList recent_inputs();

void remember_recent(const QString& input);
void forget_recent();

/// The menu from which the open light field is saved: an entry for each form (`io::writers`).
[[nodiscard]] QMenu* make_save_menu(const Workbench& bench);

/// Asks for a file or a new folder and writes the open light field, as below.
void ask_to_save_light_field(const Workbench& bench, const io::Writer& writer);

/// Writes the open light field with its truth, labels and what is painted, in the background. What
/// the form cannot hold is told. Nothing is written over the light field that is open.
void save_light_field(const Workbench& bench, const io::Writer& writer, const QString& path);

}  // namespace episcope
