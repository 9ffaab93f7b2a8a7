// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/frame/queued_post.h"

#include <QMetaObject>
#include <QObject>

namespace episcope {

JobRunner::Post queued_post(QObject* context) {
  return [context](std::function<void()> closure) {
    QMetaObject::invokeMethod(context, std::move(closure), Qt::QueuedConnection);
  };
}

}  // namespace episcope
