// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"

#include <QObject>
#include <QString>

class QDialog;

namespace episcope {

class MoviePanel;

/// Adds the commands that write pictures.
void add_picture_export(const Workbench& bench);

/// Writes the view with its overlay at image resolution, in the background.
void save_picture(const Workbench& bench, const QString& path);

/// Writes the map of the overlay alone, as `episcope-cli show` does.
void save_map_picture(const Workbench& bench, const QString& path);

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
