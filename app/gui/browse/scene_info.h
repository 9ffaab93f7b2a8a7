// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "widgets/browse/info_panel.h"

#include <QString>
#include <QStringList>

#include <vector>

namespace episcope {

/// What the info panel says about a scene.
struct SceneInfo {
  QString title;
  std::vector<InfoRow> rows;
  QStringList warnings;
};

[[nodiscard]] SceneInfo describe(const Scene& scene);

}  // namespace episcope
