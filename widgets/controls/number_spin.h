// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QDoubleSpinBox>

namespace episcope {

/// A field for a number with a decimal point, whatever the language, and a true minus; a hyphen may
/// be typed for it.
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

 private:
  int least_decimals_ = 100;
};

}  // namespace episcope
