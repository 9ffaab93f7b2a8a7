// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"
#include "app/gui/frame/jobs.h"
#include "app/session/labels/label_statistics.h"
#include "app/session/session.h"

#include <QObject>

#include <vector>

namespace episcope {

class LabelPalette;
struct Edit;

/// Which labels are shown and locked, how they are drawn, and how much of each is painted on the
/// view.
class LabelLookController : public QObject {
  Q_OBJECT

 public:
  LabelLookController(const Workbench& bench, LabelPalette* palette);

 private:
  void addCommands();
  void update(Parts parts);
  void setHidden(int id, bool hides);
  void showOnly(int id);
  void setLocked(int id, bool locks);
  void setDrawing(render::LabelDrawing drawing);
  /// What undo or redo did to labels that are locked.
  void tellLocked(const Edit& edit, bool is_undo);
  /// Forgets the marks of labels that are gone.
  void followLabels();
  void count();
  /// `all`: pixels of the view.
  void showAmounts(const std::vector<LabelAmount>& amounts, double all);

  Workbench bench_;
  LabelPalette* palette_;
  LatestJob count_job_;
};

}  // namespace episcope
