// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/indices.h"

namespace episcope {

/// A rectangle of views of the camera grid.
struct ViewRectangle {
  ViewIndex first;
  GridShape grid{1, 1};
};

}  // namespace episcope
