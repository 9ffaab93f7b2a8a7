// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/open_scene.h"
#include "engine/core/parallel/progress.h"

#include <filesystem>
#include <functional>
#include <memory>

namespace episcope {

/// Gives a worker an open scene: what is in memory, else it is read. Throws what `load_scene`
/// throws.
using SceneSource = std::function<std::shared_ptr<const Scene>(const Progress&)>;

/// `cache` keeps built-in scenes. Without `needs_truth`, what is read may lack its ground truth.
[[nodiscard]] SceneSource scene_source(const OpenScene& scene, const std::filesystem::path& cache,
                                       bool needs_truth);

}  // namespace episcope
