// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/depth/screen_triangle.h"
#include "engine/capture/mesh/triangle_mesh.h"
#include "engine/core/parallel/progress.h"

#include <cstdint>
#include <span>
#include <vector>

namespace episcope::capture {

/// Side of a tile in px.
inline constexpr int kTile = 64;

/// Which triangles reach into which tile of a view, those seen from outside apart.
class TileBins {
 public:
  /// Keeps its memory from view to view. Throws Cancelled.
  void fill(std::span<const Face> faces, std::span<const ScreenVertex> vertices, int height,
            int width, bool both_sides, const Progress& progress);

  [[nodiscard]] int tiles_across() const { return across_; }
  [[nodiscard]] int tile_count() const { return across_ * down_; }
  [[nodiscard]] int chunk_count() const { return static_cast<int>(chunks_.size()); }
  /// Triangles of the tile, in the order of the mesh, chunk after chunk.
  [[nodiscard]] std::span<const std::uint32_t> faces(int chunk, int tile, bool is_front) const;

 private:
  struct Entry {
    std::uint32_t face;
    std::uint32_t bin;
  };
  struct Chunk {
    std::vector<Entry> entries;
    std::vector<std::uint32_t> starts;  ///< Of bin after bin, and the end.
    std::vector<std::uint32_t> sorted;
  };
  void bin_face(std::uint32_t face, const std::array<ScreenVertex, 3>& v, Chunk& chunk) const;
  void sort(Chunk& chunk) const;

  std::vector<Chunk> chunks_;
  int across_ = 0;
  int down_ = 0;
  int height_ = 0;
  int width_ = 0;
  bool both_sides_ = false;
};

}  // namespace episcope::capture
