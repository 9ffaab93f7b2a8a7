// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/random/furniture.h"

namespace episcope::scenes {

std::span<const Furniture> room_furniture() {
  static constexpr Furniture all[] = {
      {Form::Box, Finish::Textured, true, 0.17},     {Form::Box, Finish::Plain, true, 0.14},
      {Form::Panel, Finish::Textured, false, 0.15},  {Form::Cylinder, Finish::Plain, true, 0.12},
      {Form::Cylinder, Finish::Periodic, true, 0.1}, {Form::Ball, Finish::Textured, true, 0.09},
      {Form::Ball, Finish::Plain, true, 0.08},       {Form::Ball, Finish::Shiny, true, 0.07},
      {Form::Lattice, Finish::Plain, false, 0.16},
  };
  return all;
}

double draw_bar_px(Draw draw) {
  return draw.between(0.8, 2);
}

}  // namespace episcope::scenes
