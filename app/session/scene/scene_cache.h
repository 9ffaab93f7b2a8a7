// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"
#include "engine/scenes/builtin.h"

#include <filesystem>
#include <optional>
#include <string>

namespace episcope {

/// Built-in scenes kept on disk in archive form, one folder for each scene, version and options.
class SceneCache {
 public:
  /// An empty folder keeps nothing.
  explicit SceneCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Where a scene is kept.
  [[nodiscard]] std::filesystem::path place(const std::string& id,
                                            const scenes::RenderOptions& options) const;
  /// Empty if the scene is not there. One that cannot be read is removed. Throws Cancelled.
  [[nodiscard]] std::optional<Scene> read(const std::string& id,
                                          const scenes::RenderOptions& options,
                                          const Progress& progress) const;
  /// Samples of a kept scene without its truth, which takes several times their memory. Empty if
  /// they are not there, damaged or of another shape. Throws Cancelled.
  [[nodiscard]] std::optional<ViewStack<std::uint8_t>> read_samples(
      const std::string& id, const scenes::RenderOptions& options, const Progress& progress) const;
  /// Returns whether the scene is kept now. What cannot be written is not kept. Throws Cancelled.
  bool write(const std::string& id, const scenes::RenderOptions& options, const Scene& scene,
             const Progress& progress) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace episcope
