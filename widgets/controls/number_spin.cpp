// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/number_spin.h"

#include "widgets/style/number_text.h"

#include <QLocale>
#include <QToolTip>

namespace episcope {
namespace {

// As QDoubleSpinBox reads it: a hyphen for the minus, and a point for the decimal comma that the
// keypads of some languages have.
QString readable(QString text) {
  if (QLocale().decimalPoint() == ",") text.replace(',', '.');
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
  return QDoubleSpinBox::valueFromText(readable(text));
}

QValidator::State NumberSpin::validate(QString& text, int& position) const {
  QString plain = readable(text);
  const QValidator::State state = QDoubleSpinBox::validate(plain, position);
  const auto number = typed(text);
  const bool is_beyond = number && (*number < minimum() || *number > maximum());
  return is_beyond ? QValidator::Intermediate : state;
}

std::optional<double> NumberSpin::typed(const QString& text) const {
  QString plain = readable(text);
  if (!suffix().isEmpty() && plain.endsWith(suffix())) plain.chop(suffix().size());
  bool is_number = false;
  const double number = plain.trimmed().toDouble(&is_number);
  return is_number ? std::optional(number) : std::nullopt;
}

void NumberSpin::fixup(QString& text) const {
  const auto number = typed(text);
  if (!number) return QDoubleSpinBox::fixup(text);
  const bool is_low = *number < minimum();
  const QString limit = textFromValue(is_low ? minimum() : maximum()) + suffix();
  text = limit;
  QToolTip::showText(
      mapToGlobal(QPoint(0, height())),
      (is_low ? tr("The least possible value is %1") : tr("The largest possible value is %1"))
          .arg(limit));
}

}  // namespace episcope

#include "moc_number_spin.cpp"
