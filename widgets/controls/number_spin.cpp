// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/number_spin.h"

#include "widgets/controls/text.h"

#include <QLocale>
#include <QToolTip>

#include <algorithm>
#include <cmath>

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
  QToolTip::showText(mapToGlobal(QPoint(0, height())),
                     (is_low ? tr("The minimum is %1") : tr("The maximum is %1")).arg(limit));
}

namespace {

constexpr int kSteps = 200;

int slider_steps(const ParameterDescription& description) {
  const bool is_integer = std::holds_alternative<int>(description.default_value);
  const double length = description.max - description.min;
  return is_integer && !description.logarithmic && length <= 1000 ? static_cast<int>(length)
                                                                  : kSteps;
}

}  // namespace

NumberScale::NumberScale(double min, double max, bool logarithmic, int steps)
    : min_(min), max_(max), logarithmic_(logarithmic && max > min), steps_(std::max(1, steps)) {
  constexpr double kDecades = 1e-4;  // Below this part of the domain, steps are even again.
  if (logarithmic_ && min <= 0) offset_ = (max - min) * kDecades - min;
}

NumberScale::NumberScale(const ParameterDescription& description)
    : NumberScale(description.min, description.max, description.logarithmic,
                  slider_steps(description)) {}

int NumberScale::position(double value) const {
  if (!(max_ > min_)) return 0;
  const double clamped = std::clamp(value, min_, max_);
  const double part = logarithmic_ ? std::log((clamped + offset_) / (min_ + offset_)) /
                                         std::log((max_ + offset_) / (min_ + offset_))
                                   : (clamped - min_) / (max_ - min_);
  return static_cast<int>(std::lround(part * steps_));
}

double NumberScale::value(int position) const {
  if (position <= 0) return min_;
  if (position >= steps_) return max_;
  const double part = 1.0 * position / steps_;
  if (!logarithmic_) return min_ + part * (max_ - min_);
  return (min_ + offset_) * std::pow((max_ + offset_) / (min_ + offset_), part) - offset_;
}

int NumberScale::decimals() const {
  const double smallest = logarithmic_ && min_ > 0 ? min_ : (max_ - min_) / 100;
  if (!(smallest > 0)) return 2;
  return std::clamp(1 - static_cast<int>(std::floor(std::log10(smallest))), 1, 7);
}

}  // namespace episcope

#include "moc_number_spin.cpp"
