// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"
#include "engine/core/light_field/label_info.h"

#include <QObject>

namespace episcope {

class LabelPalette;

/// The labels that can be painted with: shows them, and adds, renames, recolours, removes and
/// chooses them.
class LabelController : public QObject {
  Q_OBJECT

 public:
  LabelController(const Workbench& bench, LabelPalette* palette);

  void choose(int id);
  void add();
  void rename();
  /// Asks first if something is painted with it.
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
  [[nodiscard]] bool isPainted(int id) const;
  void removeNow(int id);

  Workbench bench_;
  DocumentController& document_;
  LabelChoice& labels_;
  LabelPalette* palette_;
};

}  // namespace episcope
