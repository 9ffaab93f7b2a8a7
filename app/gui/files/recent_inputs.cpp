// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/files/recent_inputs.h"

#include <QSettings>

namespace episcope {
namespace {

constexpr const char* kKey = "recent";
constexpr int kMostRecent = 10;

}  // namespace

QStringList recent_inputs() {
  return QSettings().value(kKey).toStringList();
}

void remember_recent(const QString& input) {
  QStringList recent = recent_inputs();
  recent.removeAll(input);
  recent.prepend(input);
  QSettings().setValue(kKey, recent.mid(0, kMostRecent));
}

void forget_recent() {
  QSettings().remove(kKey);
}

}  // namespace episcope
