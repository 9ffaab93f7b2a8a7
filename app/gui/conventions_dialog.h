// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/open/open.h"

#include <QDialog>

class QCheckBox;
class QComboBox;
class QFormLayout;
class QLineEdit;

namespace episcope {

/// Asks how a file is to be read where the automatic answer is wrong: the order of views, the
/// units of depth, the names of an image grid.
class ConventionsDialog : public QDialog {
  Q_OBJECT

 public:
  /// Which questions make sense for the input.
  struct Scope {
    bool has_units = true;
    bool has_names = true;
  };

  ConventionsDialog(const QString& path, const io::OpenOptions& current, Scope scope,
                    QWidget* parent);

  [[nodiscard]] io::OpenOptions conventions() const;

 private:
  void addOrder(QFormLayout& form);
  void addUnits(QFormLayout& form);
  void addNames(QFormLayout& form);
  void display(const io::OpenOptions& conventions);

  QComboBox* order_;
  QComboBox* units_;
  QLineEdit* pattern_;
  QCheckBox* snake_;
};

}  // namespace episcope
