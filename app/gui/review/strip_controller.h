// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"
#include "app/gui/frame/jobs.h"
#include "app/session/picture/label_strip.h"
#include "app/session/session.h"

#include <QObject>

class QComboBox;
class QDialog;

namespace episcope {

class CheckPanel;
class EpiStripView;

/// A window with the current label over the views: EPIs through it with the boundaries of labels.
class StripController : public QObject {
  Q_OBJECT

 public:
  /// The panel gets a button.
  StripController(const Workbench& bench, CheckPanel* panel);

 private:
  /// What a strip is made of.
  struct Subject {
    LabelingPtr labeling;
    LabelFinish finish;
    int label = 0;
    ViewIndex view;
    EpiDirection direction = EpiDirection::Horizontal;
    friend bool operator==(const Subject&, const Subject&) = default;
  };

  void addCommands(CheckPanel* panel);
  void open();
  void update();
  void begin(const Subject& subject);
  void show(const LabelStrip& strip, const Subject& subject);
  void hint(const QString& sentence);
  void goTo(int index, int view, int place);
  [[nodiscard]] EpiDirection direction() const;

  Workbench bench_;
  QDialog* dialog_;
  QComboBox* direction_;
  EpiStripView* strip_view_;
  std::optional<Subject> subject_;
  LabelStrip strip_;
  LatestJob job_;
};

}  // namespace episcope
