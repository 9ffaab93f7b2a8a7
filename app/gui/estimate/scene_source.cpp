// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/estimate/scene_source.h"

#include "app/session/scene/load_scene.h"

namespace episcope {

SceneSource scene_source(const OpenScene& scene, const std::filesystem::path& cache,
                         bool needs_truth) {
  if (scene.scene) return [loaded = scene.scene](const Progress&) { return loaded; };
  LoadOptions options;
  options.open = io::open_schema().parse(scene.reading);
  options.cache_folder = cache;
  options.needs_truth = needs_truth;
  return [input = scene.input, options](const Progress& progress) {
    return std::make_shared<const Scene>(load_scene(input, options, progress));
  };
}

}  // namespace episcope
