// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/depth/pixel_surface.h"
#include "engine/capture/depth/tile_bins.h"

#include <span>
#include <vector>

namespace episcope::capture {

/// What all tiles of a view share.
struct RasterInput {
  std::span<const Face> faces;
  std::span<const ScreenVertex> vertices;
  const TileBins* bins = nullptr;
  int height = 0;
  int width = 0;
  double jump = 0;
  bool both_sides = false;

  [[nodiscard]] std::array<ScreenVertex, 3> corners(std::uint32_t face) const {
    const Face& f = faces[face];
    return {vertices[f[0]], vertices[f[1]], vertices[f[2]]};
  }
};

/// Resolves the pixels of one tile after another.
class TileRaster {
 public:
  explicit TileRaster(const RasterInput& input);

  /// Calls `put(y, x, surface)` for every pixel of the tile that triangles reach.
  template <class Put>
  void run(int tile, const Put& put) {
    gather(tile);
    sort();
    for (int p = 0; p < kTile * kTile; ++p) {
      if (starts_[p] == starts_[p + 1]) continue;
      const int y = top_ + p / kTile;
      const int x = left_ + p % kTile;
      put(y, x,
          resolver_.resolve({sorted_.data() + starts_[p], starts_[p + 1] - starts_[p]},
                            [&](std::uint32_t id) { return triangle(id, x, y); }));
    }
  }

 private:
  [[nodiscard]] ScreenTriangle triangle(std::uint32_t face, int x, int y) const;
  void gather(int tile);
  void add_face(std::uint32_t face, bool is_front);
  void add_fragment(Fragment fragment);
  [[nodiscard]] bool is_hidden(int pixel, float near) const {
    return cover_[pixel] >= kWhole && near < far_[pixel];
  }
  void sort();

  static constexpr float kWhole = 1 - 1e-4F;

  const RasterInput& input_;
  PixelResolver resolver_;
  int left_ = 0;  ///< Of the tile,
  int top_ = 0;
  int right_ = 0;  ///< and its last pixels.
  int bottom_ = 0;
  std::vector<Fragment> fragments_;
  std::vector<Fragment> sorted_;
  std::vector<std::uint32_t> starts_;
  std::vector<float> cover_;  ///< Sum of the areas of triangles seen from outside,
  std::vector<float> far_;    ///< and their smallest 1/Z.
};

}  // namespace episcope::capture
