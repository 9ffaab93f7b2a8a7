// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/frame/file_time.h"

#include <QDateTime>
#include <QLocale>

#include <chrono>

namespace episcope {

QString short_text(std::filesystem::file_time_type time) {
  const auto since_1970 = std::chrono::file_clock::to_sys(time).time_since_epoch();
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(since_1970);
  return QLocale().toString(QDateTime::fromMSecsSinceEpoch(ms.count()), QLocale::ShortFormat);
}

}  // namespace episcope
