// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"
#include "engine/io/write.h"

#include <QObject>
#include <QString>
#include <QStringList>

#include <functional>

class QMenu;

namespace episcope {

struct ResultOwner;

/// Opens light fields and results that the user chooses or drops, and lists the recent ones.
class FileController : public QObject {
  Q_OBJECT

 public:
  explicit FileController(const Workbench& bench);

  /// Opens light fields and projects one after the other, then results, each with its light field
  /// unless that is open. Reports what failed once all paths were tried.
  void open(const QStringList& paths) { openAll(paths, {}); }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void addOpenCommands();
  void addSaveCommand();
  void addLeaveCommands();
  void ask();
  void readAgain();
  void askForResult();
  void askForBuiltin();
  /// Adds a result to the light field in front. If it belongs to another one, asks, and opens that
  /// without a question while nothing is open; then opens the `rest`.
  void openResult(const QString& path, const QStringList& rest = {},
                  const QStringList& failures = {});
  void askWhereItBelongs(const QString& path, const ResultOwner& owner);
  void openOwner(const QString& path, const ResultOwner& owner, const QStringList& rest = {},
                 const QStringList& failures = {});
  void openAll(QStringList paths, const QStringList& failures);
  void openFirst(const QString& path, const QStringList& rest, const QStringList& failures,
                 const std::function<void()>& then = {});
  void remember(const QString& input);
  void fillRecentMenu();
  void showInvitation();

  Workbench bench_;
  QMenu* recent_menu_;
};

/// Inputs opened before, newest first, from the settings.
[[nodiscard]] QStringList recent_inputs();

void remember_recent(const QString& input);
void forget_recent();

/// Menu with one entry for each writable form (`io::writers`).
[[nodiscard]] QMenu* make_save_menu(const Workbench& bench);

/// Asks for a file or a new folder, then calls `save_light_field`.
void ask_to_save_light_field(const Workbench& bench, const io::Writer& writer);

/// Writes the open light field with truth, labels and scribbles, in the background. Warns of parts
/// that the form cannot hold. Never overwrites the open light field.
void save_light_field(const Workbench& bench, const io::Writer& writer, const QString& path);

}  // namespace episcope
