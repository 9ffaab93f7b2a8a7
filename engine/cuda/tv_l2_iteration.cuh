// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/tv_l2_steps.cuh"

namespace episcope::cuda {

/// One iteration on the level being solved, all steps in one kernel: corrects (unless it is the
/// first) and relaxes both colors, moves the dual, renews b, relaxes both colors, restricts the
/// residual to `coarse`. What it moves goes to the second planes.
void iterate_by_tiles(const DeviceStream& stream, const TvL2Level& level, const TvL2Level& coarse,
                      int views, const TvL2View* of_views, bool is_first);
/// Iterates by strips: quicker where the level has enough of them to keep the device busy.
void iterate_by_strips(const DeviceStream& stream, const TvL2Level& level, const TvL2Level& coarse,
                       int views, const TvL2View* of_views, bool is_first);
[[nodiscard]] bool has_enough_strips(const TvL2Level& level, int views);

/// A place of a tile, of which each thread has several: two pixels.
struct TvL2TilePlace {
  int y = 0, i = 0;                        ///< In the tile, what is read around it included.
  int row = 0, place = 0;                  ///< In the level.
  bool exists = false, is_inside = false;  ///< In the tile, and in the level too.
};

/// How a block's tile in shared memory is laid out: places and rows of it, those read around it,
/// and threads. A plane has rows of both halves.
template <int kTilePlaces, int kTileRows, int kHaloPlaces, int kHaloRows, int kThreadCount>
struct TvL2TileShape {
  static constexpr int kThreads = kThreadCount;
  static constexpr int kPlaces = kTilePlaces + 2 * kHaloPlaces;
  static constexpr int kRows = kTileRows + 2 * kHaloRows;
  static constexpr int kEach = (kPlaces * kRows + kThreads - 1) / kThreads;  ///< Of a thread.
  /// From a pixel of an even column to the odd one of its place: between the halves lies one float
  /// that stands for what is beside the tile.
  static constexpr int kOdd = kPlaces + 1;
  static constexpr int kRow = kOdd + kPlaces, kPlane = kRows * kRow;

  [[nodiscard]] static __device__ TvL2TilePlace place(const TvL2Level& level, int number) {
    const int index = static_cast<int>(threadIdx.x) + number * kThreads;
    TvL2TilePlace result;
    result.y = index / kPlaces;
    result.i = index % kPlaces;
    result.row = static_cast<int>(blockIdx.y) * kTileRows + result.y - kHaloRows;
    result.place = static_cast<int>(blockIdx.x) * kTilePlaces + result.i - kHaloPlaces;
    result.exists = index < kPlaces * kRows;
    result.is_inside = result.exists && result.row >= 0 && result.row < level.height &&
                       result.place >= 0 && result.place < level.half();
    return result;
  }
  /// Rows, or pixels, that a place lies beside the tile.
  [[nodiscard]] static __device__ int rows_beside(const TvL2TilePlace& place) {
    return max(0, max(kHaloRows - place.y, place.y - (kHaloRows + kTileRows - 1)));
  }
  [[nodiscard]] static __device__ int pixels_beside(const TvL2TilePlace& place) {
    return max(0, 2 * max(kHaloPlaces - place.i, place.i - (kHaloPlaces + kTilePlaces - 1)) - 1);
  }
  /// Blocks for all views of a level.
  [[nodiscard]] static dim3 blocks(const TvL2Level& level, int views) {
    return {static_cast<unsigned>((level.half() + kTilePlaces - 1) / kTilePlaces),
            static_cast<unsigned>((level.height + kTileRows - 1) / kTileRows),
            static_cast<unsigned>(views)};
  }
};

}  // namespace episcope::cuda
