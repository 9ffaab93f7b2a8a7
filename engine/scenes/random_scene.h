// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/scenes/plan.h"
#include "engine/scenes/stage.h"

namespace episcope::scenes {

/// A scene drawn at random, with the cameras that see it.
struct RandomScene {
  Stage stage;
  Model model;
};

/// Draws a scene: 3 to 40 objects of several forms and finishes before a wall, mostly on slanted
/// ground, and a sensor. All disparities of a 9×9 grid lie within ±3.5 px. The same seed and kind
/// give the same scene at every size of the views, but for what has a size in pixels: textures,
/// thin bars, disparities.
[[nodiscard]] RandomScene random_scene(int width, int height, unsigned seed, RandomKind kind);

}  // namespace episcope::scenes
