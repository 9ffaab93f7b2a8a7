// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/scenes/stage.h"

#include <optional>
#include <string>
#include <vector>

namespace episcope::scenes {

/// Kind of a random scene; most isolate one weakness of methods.
enum class RandomKind {
  Any,        ///< A mixture of those below, but for the last four.
  Occlusion,  ///< Bars before textured layers, steps up to 1.5 px, noise growing downwards.
  Dark,       ///< Little light, disparities of ±3.1 px.
  Thin,       ///< Bars, lattices and leaves.
  Plain,      ///< Surfaces with little texture.
  Periodic,   ///< Stripes, checks and rings.
  Shiny,      ///< Highlights that move with the view.
  Uneven,     ///< Views of different gain, vignetting, a defocused background.
  Noisy,      ///< Noise of 5 to 10/255.
  Room,       ///< Furniture, a lattice of thin bars, a patterned wall, a checkered floor.
  Smooth,     ///< Large folded, curved and slanted surfaces of weak texture, noise of 0 to 2/255.
  /// Detail finer than pixels, which see only a part of their square or a single point of it.
  Aliased,
  Faint  ///< Few things before a large dark wall of faint texture, noise of 1 to 2/255.
};

/// All kinds as they are written, in the order of the enumeration.
[[nodiscard]] const std::vector<std::string>& random_kind_names();
[[nodiscard]] const std::string& random_kind_name(RandomKind kind);
/// The kind of this name; nothing if there is none.
[[nodiscard]] std::optional<RandomKind> random_kind_of(const std::string& name);

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
