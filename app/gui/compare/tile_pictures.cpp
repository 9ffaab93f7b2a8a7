// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/compare/tile_pictures.h"

#include "app/session/picture/picture.h"
#include "engine/core/parallel/parallel.h"
#include "widgets/style/picture.h"

#include <memory>
#include <utility>

namespace episcope {

bool is_same(const TileRequest& a, const TileRequest& b) {
  return a.light_field == b.light_field && a.view == b.view && a.source == b.source &&
         render::is_same(a.shading, b.shading) && a.opacity == b.opacity && a.tone == b.tone;
}

std::vector<TilePicture> make_tile_pictures(const std::vector<TileRequest>& requests,
                                            const Progress& progress) {
  std::vector<TilePicture> pictures(requests.size());
  // All tiles are of one scene.
  const auto tone = requests.empty() ? nullptr : render::table_of(requests.front().tone);
  parallel_for(static_cast<int>(requests.size()), progress, [&](int i) {
    const TileRequest& request = requests[static_cast<std::size_t>(i)];
    TilePicture& picture = pictures[static_cast<std::size_t>(i)];
    if (request.source) picture.map = make_map(*request.source);
    RgbaImage drawn = render::shade_view(*request.light_field, request.view, tone.get());
    if (picture.map) {
      drawn = blended(drawn, overlay_picture(*picture.map, request.shading), request.opacity);
    }
    picture.picture = to_qimage(std::move(drawn)).convertToFormat(QImage::Format_RGB32);
  });
  return pictures;
}

}  // namespace episcope
