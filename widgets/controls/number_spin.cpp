// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/number_spin.h"

#include "widgets/style/number_text.h"

namespace episcope {
namespace {

QString with_hyphen(QString text) {
  return text.replace(kMinus, '-');
}

}  // namespace

NumberSpin::NumberSpin(QWidget* parent) : QDoubleSpinBox(parent) {
  setLocale(QLocale::c());
  setKeyboardTracking(false);
}

void NumberSpin::setLeastDecimals(int decimals) {
  least_decimals_ = decimals;
  setValue(value());  // shows it anew
}

QString NumberSpin::textFromValue(double value) const {
  QString text = number_text(value, decimals());
  int surplus = decimals() - least_decimals_;
  while (surplus-- > 0 && text.endsWith('0')) text.chop(1);
  return text;
}

double NumberSpin::valueFromText(const QString& text) const {
  return QDoubleSpinBox::valueFromText(with_hyphen(text));
}

QValidator::State NumberSpin::validate(QString& text, int& position) const {
  QString plain = with_hyphen(text);
  return QDoubleSpinBox::validate(plain, position);
}

}  // namespace episcope

#include "moc_number_spin.cpp"
