// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"

#include <string>
#include <vector>

namespace episcope::scenes {

struct BuiltinSceneInfo {
  std::string id;  ///< "fronto", "slant", "edge", "bars", "objects", "transparent", "demo", …
  std::string summary;  ///< One line.
};

struct RenderOptions {
  GridShape grid{9, 9};
  int height = 512;
  int width = 512;
  double noise_sigma = 0;  ///< Gaussian noise in units of 1/255.
  unsigned seed = 1;
  int channels = 3;
  /// Scales every disparity, to make scenes of wider or narrower range.
  double disparity_scale = 1;
  /// Where the cameras stand, in steps to the right of and below the centre view, view by view;
  /// empty = on the regular grid. They become LightFieldInfo::positions; the centre view must stand
  /// at (0, 0).
  std::vector<CameraPosition> positions{};
};

/// What LightFieldInfo::reading names as the reader of built-in scenes.
inline constexpr const char* kBuiltinReader = "builtin";

/// All built-in scenes, simple ones that each test one thing first, the demo last.
[[nodiscard]] std::vector<BuiltinSceneInfo> builtin_scenes();

/// Ray-casts a built-in scene analytically, each view by itself: exact disparity and labels at
/// pixel centres for every view, colour averaged over 4×4 samples, band-limited textures, seeded
/// noise. Deterministic: the same options give the same bytes on every machine and thread count.
/// Throws Unavailable for an unknown id (naming the nearest), InvalidInput, Cancelled.
[[nodiscard]] Scene render_builtin(const std::string& id, const RenderOptions& options,
                                   const Progress& progress);

}  // namespace episcope::scenes
