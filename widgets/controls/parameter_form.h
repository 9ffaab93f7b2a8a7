// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter.h"
#include "widgets/controls/parameter_editor.h"

#include <QWidget>

#include <string>
#include <vector>

class QGridLayout;
class QLabel;
class QToolButton;

namespace episcope {

/// A form generated from parameter descriptions, one row each: label, editor and unit. A button
/// opens the help of a row, which the tool tip holds as well; labels of changed parameters are
/// bold, with a reset button. The main parameters come first, the others are folded under
/// "Advanced (18)". A choice with presets (Preset) changes the defaults of other rows: rows at
/// their default follow, changed rows stay.
class ParameterForm : public QWidget {
  Q_OBJECT

 public:
  explicit ParameterForm(QWidget* parent = nullptr);

  /// Rebuilds the form with the defaults. `main`: keys of the parameters that are never folded, in
  /// the order in which they are shown; empty = all, in the order of the schema. Whether the others
  /// are shown stays as it was.
  void setParameters(const std::vector<ParameterDescription>& parameters,
                     const std::vector<std::string>& main = {});
  /// Sets some values, after the presets that they choose. Ignores unknown keys and wrong types,
  /// and clamps numbers. Does not emit.
  void setValues(const ParameterSet& values);
  /// What is known of the ranges that intervals may be left to.
  void setRangeHints(const RangeHints& hints);
  /// Shows the folded parameters, or hides them.
  void setAdvancedShown(bool is_shown);

  /// All parameters with their values, in the order of the schema.
  [[nodiscard]] ParameterSet values() const;
  /// Values that differ from their default.
  [[nodiscard]] ParameterSet modifiedValues() const;

 public slots:
  void resetToDefaults();

 signals:
  void valuesChanged();
  /// Rows appeared or disappeared.
  void heightChanged();

 protected:
  bool event(QEvent* event) override;

 private:
  struct Row {
    ParameterDescription description;
    QLabel* label;
    ParameterEditor* editor;
    QWidget* reset;
    bool is_main;
  };

  QGridLayout* addGrid(QWidget* place);
  void layRows(const std::vector<std::size_t>& rows, QGridLayout* grid);
  [[nodiscard]] Row makeRow(const ParameterDescription& description, bool is_main);
  QToolButton* makeHelp(std::size_t index);
  void showModified(const Row& row) const;
  void showFold();
  void showHelp(std::size_t index, const QPoint& at);
  void edit(std::size_t index);
  /// Applies the defaults of the chosen presets to rows at their default.
  void followPresets();

  std::vector<ParameterDescription> descriptions_;  ///< As they were set.
  std::vector<Row> rows_;                           ///< In the same order.
  RangeHints hints_;
  bool is_advanced_shown_ = false;
  QWidget* sheet_ = nullptr;     ///< Holds all of the following;
  QToolButton* fold_ = nullptr;  ///< null if nothing is folded,
  QWidget* advanced_ = nullptr;  ///< as is this.
};

}  // namespace episcope
