// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/parameter.h"

#include <QWidget>

#include <vector>

class QGridLayout;
class QLabel;

namespace episcope {

class ParameterEditor;

/// A form generated from parameter descriptions: one row each, with label, editor and unit; tool
/// tips tell help, domain and default; labels of changed parameters are bold, with a reset button.
/// A choice with presets (Preset) changes the defaults of other rows: those that were at their
/// default follow, those that were changed stay.
class ParameterForm : public QWidget {
  Q_OBJECT

 public:
  explicit ParameterForm(QWidget* parent = nullptr);

  /// Rebuilds the form with the defaults.
  void setParameters(const std::vector<ParameterDescription>& parameters);
  /// Overrides some values, after the presets that they choose; unknown keys and wrong types are
  /// ignored, numbers are clamped. Does not emit.
  void setValues(const ParameterSet& values);

  /// Every parameter with its value, in the order of the schema.
  [[nodiscard]] ParameterSet values() const;
  /// Values that differ from their default.
  [[nodiscard]] ParameterSet modifiedValues() const;

 public slots:
  void resetToDefaults();

 signals:
  void valuesChanged();

 private:
  struct Row {
    ParameterDescription description;
    QLabel* label;
    ParameterEditor* editor;
    QWidget* reset;
  };

  void addRow(const ParameterDescription& description);
  void showModified(const Row& row) const;
  void edit(std::size_t index);
  /// Takes the defaults that the present choices mean; rows at their default follow.
  void followPresets();

  QGridLayout* layout_ = nullptr;
  std::vector<ParameterDescription> descriptions_;  ///< As they were set.
  std::vector<Row> rows_;
};

}  // namespace episcope
