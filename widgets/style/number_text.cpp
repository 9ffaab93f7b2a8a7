// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/style/number_text.h"

#include <QRegularExpression>

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

constexpr double kLongest = 1e7;  // from here on digits before the point say nothing

}  // namespace

QString number_text(double value, int decimals) {
  const bool is_long = std::abs(value) >= kLongest;
  QString text = is_long ? QString::number(value, 'g', 4) : QString::number(value, 'f', decimals);
  if (!text.startsWith('-')) return text;
  text.remove(0, 1);
  const bool is_zero =
      std::all_of(text.begin(), text.end(), [](QChar each) { return each == '0' || each == '.'; });
  return is_zero ? text : kMinus + text;
}

QString with_minus(QString sentence) {
  static const QRegularExpression before_number(R"((?<![\w.)\]/-])-(?=\d))");
  return sentence.replace(before_number, kMinus);
}

}  // namespace episcope
