// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"
#include "engine/core/schema.h"
#include "engine/scenes/stage.h"


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

[[nodiscard]] Names<RandomKind> names_of(RandomKind);

/// Largest disparity of a random scene, px per view step, of either sign.
inline constexpr double kMostDisparity = 3.5;

/// Material of an object.
enum class Finish { Textured, Plain, Periodic, Shiny };
inline constexpr std::size_t kFinishes = 4;

/// Shape of an object.
enum class Form { Ball, Box, Cylinder, Cone, Vase, Disc, Panel, Bar, Lattice, Leaf, Plant, Drape };
inline constexpr std::size_t kForms = 12;

/// Properties of all textures of a scene.
struct Detail {
  double contrast = 1;  ///< Factor.
  /// Factor of the size of grain and of the width of the edges of patterns; below 1 they are finer
  /// than pixels show, and do not fade.
  double size = 1;
};

/// Properties of a random scene, before anything is placed.
struct Plan {
  Interval range;  ///< All disparities lie in it, within the views of a 9×9 grid.
  int objects = 3;
  std::array<double, kFinishes> finishes{};  ///< Weights.
  std::array<double, kForms> forms{};        ///< Weights.
  bool has_ground = true;
  bool has_layers = false;    ///< Bars before flat layers instead of objects in a room.
  bool is_furnished = false;  ///< What stands in every room, instead of drawn ones.
  bool is_defocused = false;  ///< The background.
  bool is_faint = false;      ///< The background: dark, and of little contrast.
  Detail detail;
  bool is_lit = true;
  bool has_moving_highlights = false;
  Sensor sensor;
};

[[nodiscard]] Plan draw_plan(Draw draw, RandomKind kind);

/// Cameras that see `range` with a depth that looks natural: the far end 1.3 to 3 times as far away
/// as the near end.
[[nodiscard]] Stage draw_stage(int width, int height, const Interval& range, Draw draw);

/// A random texture of a surface where a pixel has size `pixel_units`: unless detail is smaller,
/// band-limited there, and fading where the surface slants away. Flat objects keep their pattern in
/// their plane.
[[nodiscard]] Texture draw_texture(Draw draw, Finish finish, double pixel_units,
                                   const Detail& detail);

/// A far background out of focus: large soft blobs.
[[nodiscard]] Texture draw_defocused_texture(Draw draw, double pixel_units, const Detail& detail);

/// A dark background of little contrast: a few grey levels.
[[nodiscard]] Texture draw_faint_texture(Draw draw, double pixel_units);

/// A checkered floor: tiles in the plane of what is flat, about 30 px wide.
[[nodiscard]] Texture draw_chequered_texture(Draw draw, double pixel_units, const Detail& detail);

}  // namespace episcope::scenes
