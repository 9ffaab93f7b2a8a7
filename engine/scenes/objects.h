// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/scenes/plan.h"

#include <vector>

namespace episcope::scenes {

/// Place of an object in the center view.
struct Spot {
  double x = 0;  ///< Its middle, px.
  double y = 0;
  double disparity_px = 0;
  double half_px = 0;  ///< About half its size.
};

/// The surfaces of a random object, without label and texture. Objects that reach nearer than
/// disparity `nearest_px` are moved away and enlarged, so that they look the same from the center
/// view. `stands`: its lower end points down.
[[nodiscard]] std::vector<Primitive> make_object(const Stage& stage, Form form, const Spot& spot,
                                                 double nearest_px, bool stands, Draw draw);

/// Whether an object of this form can stand on the ground.
[[nodiscard]] bool can_stand(Form form);

/// Moves a primitive away by `factor` and enlarges it as much: the same picture from the center
/// view.
void move_away(Primitive& primitive, double factor);

}  // namespace episcope::scenes
