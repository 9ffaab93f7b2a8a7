// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "engine/cuda/device/cuda_device.h"
#include "widgets/browse/info_panel.h"

#include <QString>
#include <QStringList>

#include <optional>
#include <vector>

namespace episcope {

/// What the info panel says about a scene.
struct SceneInfo {
  QString title;
  std::vector<InfoRow> rows;
  QStringList warnings;
};

/// `gpu`: what methods compute on; none while that is not known yet.
[[nodiscard]] SceneInfo describe(const Scene& scene, const std::optional<CudaDevice>& gpu);

}  // namespace episcope
