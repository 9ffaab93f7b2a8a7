// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/scenes/stage.h"

#include <cstdint>
#include <span>

namespace episcope::scenes {

/// The built-in scenes, laid out for a stage. Disparities are of the center view.
[[nodiscard]] Model fronto_scene(const Stage& stage);       ///< d = 0.37.
[[nodiscard]] Model slant_scene(const Stage& stage);        ///< d from −1 (left) to 1 (right).
[[nodiscard]] Model edge_scene(const Stage& stage);         ///< d = −0.5 left, 0.8 right.
[[nodiscard]] Model bars_scene(const Stage& stage);         ///< Bars of 1, 2, 3 and 5 px.
[[nodiscard]] Model objects_scene(const Stage& stage);      ///< Sphere, box, ground.
[[nodiscard]] Model transparent_scene(const Stage& stage);  ///< A pane over a background.
[[nodiscard]] Model demo_scene(const Stage& stage);         ///< A still life.

struct Recipe {
  const char* id;
  const char* summary;
  Model (*lay_out)(const Stage& stage);
  bool has_scribbles;
};

[[nodiscard]] std::span<const Recipe> recipes();

/// Strokes such as a user would paint: for each label one along a row and one along a column of
/// its inside, clear of its outline. 0 = unpainted.
[[nodiscard]] Image<std::int32_t> scribble(ImageView<const std::int32_t> labels);

}  // namespace episcope::scenes
