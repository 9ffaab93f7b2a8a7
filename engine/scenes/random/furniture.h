// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/scenes/random/plan.h"

#include <span>

namespace episcope::scenes {

/// A thing that stands in every furnished room.
struct Furniture {
  Form form = Form::Box;
  Finish finish = Finish::Textured;
  bool stands = true;
  double half_share = 0.1;  ///< About half its size, as a share of the smaller side of a view.
};

/// What a furnished room holds: two boxes, a tilted panel, two cylinders, three balls and a
/// lattice, some of them of one colour.
[[nodiscard]] std::span<const Furniture> room_furniture();

/// Half the width of the bars of the lattice, px of the centre view.
[[nodiscard]] double draw_bar_px(Draw draw);

}  // namespace episcope::scenes
