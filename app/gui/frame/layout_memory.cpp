// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/frame/layout_memory.h"

#include <QSettings>

namespace episcope {
namespace {

QString key_of(const QSplitter& splitter) {
  return "layout/" + splitter.objectName();
}

}  // namespace

LayoutMemory::LayoutMemory(const QWidget& window) {
  for (auto* splitter : window.findChildren<QSplitter*>()) {
    if (splitter->objectName().startsWith("split.")) {
      kept_.push_back({splitter, splitter->saveState()});
    }
  }
}

void LayoutMemory::save() const {
  for (const Kept& each : kept_) {
    if (each.splitter) QSettings().setValue(key_of(*each.splitter), each.splitter->saveState());
  }
}

void LayoutMemory::restore() const {
  for (const Kept& each : kept_) {
    if (each.splitter) {
      each.splitter->restoreState(QSettings().value(key_of(*each.splitter)).toByteArray());
    }
  }
}

void LayoutMemory::reset() const {
  for (const Kept& each : kept_) {
    if (!each.splitter) continue;
    each.splitter->restoreState(each.first_state);
    QSettings().remove(key_of(*each.splitter));
  }
}

}  // namespace episcope
