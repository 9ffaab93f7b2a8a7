// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/tile_pictures.h"

#include "engine/core/parallel/parallel.h"

#include <cmath>

namespace episcope {
namespace {

// Alpha of `over` counts times `opacity`, as a canvas would draw it.
QImage blend(const Image<std::uint8_t>& under, const Image<std::uint8_t>& over, double opacity) {
  QImage picture(under.width(), under.height(), QImage::Format_RGB32);
  const int weight = static_cast<int>(std::lround(opacity * 256));
  for (int y = 0; y < under.height(); ++y) {
    const std::uint8_t* below = under.row(y);
    const std::uint8_t* above = over.empty() ? below : over.row(y);
    auto* target = reinterpret_cast<QRgb*>(picture.scanLine(y));
    for (int x = 0; x < under.width(); ++x, below += 4, above += 4) {
      const int part = above[3] == 0 ? 0 : weight;
      const auto mix = [&](int c) { return below[c] + (above[c] - below[c]) * part / 256; };
      target[x] = qRgb(mix(0), mix(1), mix(2));
    }
  }
  return picture;
}

}  // namespace

bool is_same(const TileRequest& a, const TileRequest& b) {
  return a.light_field == b.light_field && a.view == b.view && a.source == b.source &&
         render::is_same(a.shading, b.shading) && a.opacity == b.opacity;
}

std::vector<TilePicture> make_tile_pictures(const std::vector<TileRequest>& requests,
                                            const Progress& progress) {
  std::vector<TilePicture> pictures(requests.size());
  parallel_for(static_cast<int>(requests.size()), progress, [&](int i) {
    const TileRequest& request = requests[static_cast<std::size_t>(i)];
    TilePicture& picture = pictures[static_cast<std::size_t>(i)];
    if (request.source) picture.map = make_overlay_map(*request.source);
    picture.picture =
        blend(render::shade_view(*request.light_field, request.view),
              picture.map ? shade_overlay(*picture.map, request.shading) : Image<std::uint8_t>(),
              request.opacity);
  });
  return pictures;
}

}  // namespace episcope
