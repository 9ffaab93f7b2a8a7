// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"

#include <QObject>

class QAction;

namespace episcope {

class InfoPanel;

/// Shows what is open: the facts of the light field, the conventions found and how they were
/// checked, which the user can override.
class InfoController : public QObject {
  Q_OBJECT

 public:
  explicit InfoController(const Workbench& bench);

 private:
  void show();
  void askForConventions();
  [[nodiscard]] bool canReverseSign() const;
  void reverseSign();

  Workbench bench_;
  InfoPanel* panel_;
  QAction* reverse_ = nullptr;
};

}  // namespace episcope
