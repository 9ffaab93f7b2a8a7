// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"

#include <QObject>

namespace episcope {

class InfoPanel;

/// Tells what is open: the facts of the light field, the conventions found and how they were
/// checked; lets the user overrule them.
class InfoController : public QObject {
  Q_OBJECT

 public:
  explicit InfoController(const Workbench& bench);

 private:
  void show();
  void askForConventions();

  Workbench bench_;
  InfoPanel* panel_;
};

}  // namespace episcope
