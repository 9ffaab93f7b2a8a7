// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter.h"

#include <QDoubleSpinBox>

#include <optional>

namespace episcope {

/// A field for a number with a decimal point, whatever the language, and a true minus; a hyphen may
/// be typed for it, and a comma for the point where the language has one. Any number can be typed:
/// one beyond the range becomes the limit, which a tool tip says.
class NumberSpin : public QDoubleSpinBox {
  Q_OBJECT

 public:
  explicit NumberSpin(QWidget* parent = nullptr);

  /// Shows no zeros at the end beyond this many decimals; by default all are shown.
  void setLeastDecimals(int decimals);

 protected:
  [[nodiscard]] QString textFromValue(double value) const override;
  [[nodiscard]] double valueFromText(const QString& text) const override;
  QValidator::State validate(QString& text, int& position) const override;
  void fixup(QString& text) const override;

 private:
  [[nodiscard]] std::optional<double> typed(const QString& text) const;

  int least_decimals_ = 100;
};

/// How a slider of `steps` + 1 positions covers the domain of a number: evenly, or in powers where
/// the description says so (an interval that touches 0 is covered by powers of 1 + value/scale).
class NumberScale {
 public:
  NumberScale(double min, double max, bool logarithmic, int steps);
  explicit NumberScale(const ParameterDescription& description);

  [[nodiscard]] int steps() const { return steps_; }
  /// Position of a value clamped to the domain.
  [[nodiscard]] int position(double value) const;
  /// The ends of the slider give the ends of the domain exactly.
  [[nodiscard]] double value(int position) const;
  /// Decimals that show a tenth of the smallest step that matters.
  [[nodiscard]] int decimals() const;

 private:
  double min_;
  double max_;
  bool logarithmic_;
  int steps_;
  double offset_ = 0;  ///< Added before the logarithm is taken.
};

}  // namespace episcope
