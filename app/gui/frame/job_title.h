// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/session.h"

#include <QString>

namespace episcope {

/// "EPI_S · still_life": several light fields may be open.
[[nodiscard]] inline QString job_title(const QString& what, const OpenScene& scene) {
  return QStringLiteral("%1 · %2").arg(what, QString::fromStdString(scene.name));
}

/// The same, of the light field that is shown.
[[nodiscard]] inline QString job_title(const QString& what, const Session& session) {
  const OpenScene* scene = session.find_scene(session.generation());
  return scene == nullptr ? what : job_title(what, *scene);
}

}  // namespace episcope
