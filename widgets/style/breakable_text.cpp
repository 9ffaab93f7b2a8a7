// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/style/breakable_text.h"

namespace episcope {
namespace {

constexpr int kLongWord = 12;
constexpr int kLongestRun = 24;
constexpr QChar kBreak(0x200b);  // zero-width space

}  // namespace

QString breakable(const QString& text) {
  QString result;
  for (qsizetype begin = 0; begin <= text.size();) {
    qsizetype end = text.indexOf(' ', begin);
    if (end < 0) end = text.size();
    int run = 0;
    for (qsizetype i = begin; i < end; ++i) {
      result += text[i];
      ++run;
      const bool is_mark = QStringView(u"_/\\-").contains(text[i]) || run == kLongestRun;
      // A pair of surrogates is one letter.
      if (end - begin < kLongWord || !is_mark || text[i].isHighSurrogate()) continue;
      result += kBreak;
      run = 0;
    }
    if (end < text.size()) result += ' ';
    begin = end + 1;
  }
  return result;
}

}  // namespace episcope
