// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter.h"

#include <QWidget>

#include <vector>

class QGridLayout;
class QLabel;

namespace episcope {

class ParameterEditor;

/// A form generated from parameter descriptions, one row each: label, editor and unit. Tool tips
/// tell help, domain and default; labels of changed parameters are bold, with a reset button. A
/// choice with presets (Preset) changes the defaults of other rows: rows at their default follow,
/// changed rows stay.
class ParameterForm : public QWidget {
  Q_OBJECT

 public:
  explicit ParameterForm(QWidget* parent = nullptr);

  /// Rebuilds the form with the defaults.
  void setParameters(const std::vector<ParameterDescription>& parameters);
  /// Sets some values, after the presets that they choose. Ignores unknown keys and wrong types,
  /// and clamps numbers. Does not emit.
  void setValues(const ParameterSet& values);

  /// All parameters with their values, in the order of the schema.
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
  /// Applies the defaults of the chosen presets to rows at their default.
  void followPresets();

  QGridLayout* layout_ = nullptr;
  std::vector<ParameterDescription> descriptions_;  ///< As they were set.
  std::vector<Row> rows_;
};

/// Edits one parameter. The editor follows the type of the default value: check box, slider with
/// spin box, combo box, interval or auto, text.
class ParameterEditor : public QWidget {
  Q_OBJECT

 public:
  [[nodiscard]] virtual ParameterValue value() const = 0;
  /// Sets a value, clamped to the domain; ignores other types. Does not emit.
  virtual void setValue(const ParameterValue& value) = 0;

 signals:
  /// The user changed the value.
  void edited();

 protected:
  using QWidget::QWidget;
};

/// Object names: "<key>" for the editor, "<key>.slider", "<key>.spin", "<key>.check",
/// "<key>.combo", "<key>.auto", "<key>.found", "<key>.min", "<key>.max", "<key>.text" for its
/// controls.
[[nodiscard]] ParameterEditor* make_parameter_editor(const ParameterDescription& description,
                                                     QWidget* parent);

}  // namespace episcope
