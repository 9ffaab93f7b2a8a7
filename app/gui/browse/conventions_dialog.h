// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/parameter.h"

#include <QDialog>

namespace episcope {

class ParameterForm;
class PatternPanel;

/// Asks how to read a file where the automatic choice is wrong, with a row for each option that its
/// reader supports. Where names of files count it shows what a pattern makes of them.
class ConventionsDialog : public QDialog {
  Q_OBJECT

 public:
  /// `given` are the options set by now.
  ConventionsDialog(const QString& path, const std::vector<ParameterDescription>& options,
                    const ParameterSet& given, QWidget* parent);

  /// The options that are not automatic.
  [[nodiscard]] ParameterSet given() const;

 private:
  [[nodiscard]] PatternPanel* makePatternPanel(const QString& path);

  ParameterForm* form_;
};

}  // namespace episcope
