// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/depth/tile_bins.h"

#include "engine/core/parallel/parallel.h"

#include <algorithm>

namespace episcope::capture {
namespace {

constexpr std::size_t kChunkFaces = 1 << 16;

}  // namespace

void TileBins::bin_face(std::uint32_t face, const std::array<ScreenVertex, 3>& v,
                        Chunk& chunk) const {
  if (!(v[0].w > 0 && v[1].w > 0 && v[2].w > 0)) return;
  const auto [left, right] = std::minmax({v[0].x, v[1].x, v[2].x});
  const auto [top, bottom] = std::minmax({v[0].y, v[1].y, v[2].y});
  if (right < -0.5F || bottom < -0.5F || left > static_cast<float>(width_) - 0.5F ||
      top > static_cast<float>(height_) - 0.5F) {
    return;
  }
  const double turn = turn_of(v);
  if (turn == 0) return;
  const std::uint32_t side = turn < 0 || both_sides_ ? 0 : 1;
  const auto tile_of = [](float at, int most) {
    return std::clamp(static_cast<int>(std::clamp(at + 0.5F, 0.0F, 1e6F)), 0, most - 1) / kTile;
  };
  for (int ty = tile_of(top, height_); ty <= tile_of(bottom, height_); ++ty) {
    for (int tx = tile_of(left, width_); tx <= tile_of(right, width_); ++tx) {
      chunk.entries.push_back({face, static_cast<std::uint32_t>(ty * across_ + tx) * 2 + side});
    }
  }
}

void TileBins::sort(Chunk& chunk) const {
  chunk.starts.assign(static_cast<std::size_t>(tile_count()) * 2 + 1, 0);
  for (const Entry& entry : chunk.entries) ++chunk.starts[entry.bin + 1];
  for (std::size_t i = 1; i < chunk.starts.size(); ++i) chunk.starts[i] += chunk.starts[i - 1];
  chunk.sorted.resize(chunk.entries.size());
  std::vector<std::uint32_t> next(chunk.starts.begin(), chunk.starts.end() - 1);
  for (const Entry& entry : chunk.entries) chunk.sorted[next[entry.bin]++] = entry.face;
  chunk.entries.clear();
}

void TileBins::fill(std::span<const Face> faces, std::span<const ScreenVertex> vertices, int height,
                    int width, bool both_sides, const Progress& progress) {
  height_ = height;
  width_ = width;
  both_sides_ = both_sides;
  across_ = (width + kTile - 1) / kTile;
  down_ = (height + kTile - 1) / kTile;
  chunks_.resize((faces.size() + kChunkFaces - 1) / kChunkFaces);
  parallel_for(chunk_count(), progress, [&](int index) {
    Chunk& chunk = chunks_[index];
    chunk.entries.clear();
    const std::size_t first = index * kChunkFaces;
    const std::size_t end = std::min(first + kChunkFaces, faces.size());
    for (std::size_t i = first; i < end; ++i) {
      const Face& f = faces[i];
      bin_face(static_cast<std::uint32_t>(i), {vertices[f[0]], vertices[f[1]], vertices[f[2]]},
               chunk);
    }
    sort(chunk);
    // Entries of all chunks at once would take twice the memory of the mesh.
    std::vector<Entry>().swap(chunk.entries);
  });
}

std::span<const std::uint32_t> TileBins::faces(int chunk, int tile, bool is_front) const {
  const Chunk& of = chunks_[chunk];
  const std::size_t bin = static_cast<std::size_t>(tile) * 2 + (is_front ? 0 : 1);
  return {of.sorted.data() + of.starts[bin], of.starts[bin + 1] - of.starts[bin]};
}

}  // namespace episcope::capture
