// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/label_review.h"
#include "app/session/session.h"
#include "engine/core/scene.h"

#include <QObject>

#include <vector>

namespace episcope {

class LabelPalette;

/// Lists the labels, and adds, renames, renumbers, moves, recolors, merges, removes and chooses
/// them.
class LabelController : public QObject {
  Q_OBJECT

 public:
  LabelController(const Workbench& bench, LabelPalette* palette);

  void choose(int place);
  void add();
  void rename();
  /// Asks for the label that takes over what is painted with the current one.
  void merge(int from);
  /// Asks first if the label has been painted.
  void remove(int id);
  void recolor(int id);

 private:
  void addChoiceCommands();
  void addEditCommands();
  void show();
  void showHint();
  [[nodiscard]] bool hasDocument() const;
  /// Null if there is no such label.
  [[nodiscard]] const LabelInfo* find(int id) const;
  [[nodiscard]] const LabelInfo* at(int place) const;
  [[nodiscard]] bool isPainted(int id) const;
  void removeNow(int id);
  /// Whether the label is locked; then tells so by `hint`, in which %1 is its name.
  [[nodiscard]] bool refuseLocked(const LabelInfo& label, const QString& hint);
  /// Refuses a name that another label has.
  void setName(int id, const QString& typed);
  /// Moves a label down the list by so many places.
  void move(int id, int by);
  void askForNumber(int id);
  /// Refuses a number that another label has.
  void renumber(int id, int to);

  Workbench bench_;
  DocumentController& document_;
  LabelChoice& labels_;
  LabelPalette* palette_;
};

}  // namespace episcope
