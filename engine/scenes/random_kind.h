// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

}  // namespace episcope::scenes
