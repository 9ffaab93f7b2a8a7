// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/picture/map_choice.h"
#include "app/session/picture/picture.h"
#include "engine/core/parallel/progress.h"

#include <QImage>

#include <vector>

namespace episcope {

/// A tile to be made: a view, with a map over it if there is one.
struct TileRequest {
  LightFieldPtr light_field;
  ViewIndex view;
  std::optional<MapSource> source;
  render::Shading shading;
  double opacity = 1;  ///< Of the map.
  render::Tone tone{};
};
/// Whether two requests give the same picture.
[[nodiscard]] bool is_same(const TileRequest& a, const TileRequest& b);

struct TilePicture {
  QImage picture;      ///< View and map in one, RGB32: quickly drawn.
  QuantityMapPtr map;  ///< Null without a map.
};

/// For a worker. Throws Cancelled.
[[nodiscard]] std::vector<TilePicture> make_tile_pictures(const std::vector<TileRequest>& requests,
                                                          const Progress& progress);

}  // namespace episcope
