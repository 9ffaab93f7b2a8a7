// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"

#include <QObject>

class QComboBox;

namespace episcope {

/// The list of open light fields, from which another one is shown.
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

}  // namespace episcope
