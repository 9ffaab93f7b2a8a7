// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"
#include "app/gui/frame/jobs.h"
#include "app/session/parts.h"

#include <QObject>

class QDialog;

namespace episcope {

class TonePanel;

/// How views are brightened for display, by scene; offers it where they are dark.
class ToneController : public QObject {
  Q_OBJECT

 public:
  explicit ToneController(const Workbench& bench);

 private:
  void addCommands();
  void update(Parts parts);
  void brighten();
  void look();

  Workbench bench_;
  QDialog* dialog_;
  TonePanel* panel_;
  LatestJob job_;
};

}  // namespace episcope
