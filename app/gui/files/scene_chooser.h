// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"

#include <QObject>

class QComboBox;

namespace episcope {

class Autosave;
class ProjectController;

/// The list of open light fields, which switches between them.
class SceneChooser : public QObject {
  Q_OBJECT

 public:
  explicit SceneChooser(const Workbench& bench);

 private:
  void addCommands();
  void fill();

  Workbench bench_;
  QComboBox* list_;
};

/// Titles the window after light field and project; a star marks unsaved scribbles or project
/// changes.
class WindowTitle : public QObject {
  Q_OBJECT

 public:
  WindowTitle(const Workbench& bench, const Autosave& autosave, const ProjectController& project);

 private:
  void show();
  void mark();

  Workbench bench_;
  const Autosave& autosave_;
  const ProjectController& project_;
};

}  // namespace episcope
