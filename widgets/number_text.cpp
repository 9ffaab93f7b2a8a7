// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/number_text.h"

#include <QRegularExpression>

#include <algorithm>

namespace episcope {

QString number_text(double value, int decimals) {
  QString text = QString::number(value, 'f', decimals);
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
