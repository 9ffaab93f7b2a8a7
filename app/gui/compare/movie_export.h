// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"

#include <QObject>
#include <QString>

class QDialog;

namespace episcope {

class MoviePanel;

/// The dialog that writes movies: MP4, WebM, GIF.
class MovieExport : public QObject {
  Q_OBJECT

 public:
  explicit MovieExport(const Workbench& bench);

  /// Writes the movie set in the dialog, in the background.
  void save(const QString& path);

 private:
  void open();
  void ask();

  Workbench bench_;
  QDialog* dialog_;
  MoviePanel* panel_;
};

}  // namespace episcope
