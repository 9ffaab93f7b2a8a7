// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter.h"

#include <QDoubleSpinBox>

#include <optional>

namespace episcope {

/// A field for a number with a decimal point in any language, and a true minus. Accepts a hyphen
/// for the minus, and a comma for the point if the language has one. Clamps numbers beyond the
/// range, as a tool tip says.
class NumberSpin : public QDoubleSpinBox {
  Q_OBJECT

 public:
  explicit NumberSpin(QWidget* parent = nullptr);

  /// Hides trailing zeros beyond this many decimals; by default shows all.
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

/// Maps a slider of `steps` + 1 positions to the domain of a number: evenly, or in powers if the
/// description says so (powers of 1 + value/scale if the domain touches 0).
class NumberScale {
 public:
  NumberScale(double min, double max, bool logarithmic, int steps);
  explicit NumberScale(const ParameterDescription& description);

  [[nodiscard]] int steps() const { return steps_; }
  /// Position of a value, clamped to the domain.
  [[nodiscard]] int position(double value) const;
  /// Value of a position; the slider's ends are exactly the domain's ends.
  [[nodiscard]] double value(int position) const;
  /// Decimals for a tenth of the smallest relevant step.
  [[nodiscard]] int decimals() const;

 private:
  double min_;
  double max_;
  bool logarithmic_;
  int steps_;
  double offset_ = 0;  ///< Added before the logarithm is taken.
};

}  // namespace episcope
