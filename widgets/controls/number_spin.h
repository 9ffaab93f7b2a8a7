// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

}  // namespace episcope
