// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/picture/picture.h"
#include "engine/core/parallel/progress.h"
#include "engine/render/camera_path.h"

#include <filesystem>
#include <functional>
#include <vector>

namespace episcope {

/// Pictures of one size, made when they are asked for.
struct Movie {
  int count = 0;
  double rate = 10;  ///< Pictures per second.
  std::function<RgbaImage(int)> picture;
};

/// What each view looks like along a path; views without a picture, of which `has_picture` is
/// false, are passed over. `seconds`: once along the path. Throws InvalidInput if no view has one.
[[nodiscard]] Movie parallax_movie(GridShape grid, render::CameraPath path, double seconds,
                                   const std::function<bool(ViewIndex)>& has_picture,
                                   std::function<RgbaImage(ViewIndex)> picture);

/// The view refocused from one end of a range of disparities to the other and back.
[[nodiscard]] Movie refocus_movie(LightFieldPtr light_field, ViewIndex view, Interval range_px,
                                  double seconds);

/// Two pictures in turns.
[[nodiscard]] Movie flip_movie(RgbaImage a, RgbaImage b, double seconds);

/// Makes the pictures and writes them (MovieFile). `width_shown`: px, 0 = as they are. Throws what
/// MovieFile does, Cancelled.
void write_movie(const std::filesystem::path& path, const Movie& movie, int width_shown,
                 const Progress& progress);

}  // namespace episcope
