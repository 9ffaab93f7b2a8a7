// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"

#include <QObject>

namespace episcope {

class Autosave;

/// Names the window after the light field and the project that are open; a star says that scribbles
/// are not saved.
class WindowTitle : public QObject {
  Q_OBJECT

 public:
  WindowTitle(const Workbench& bench, const Autosave& autosave);

 private:
  void show();

  Workbench bench_;
  const Autosave& autosave_;
};

}  // namespace episcope
